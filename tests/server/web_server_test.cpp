#include "server/web_server.hpp"

#include "tests/server/fake_server.hpp"
#include "tests/server/raw_client.hpp"
#include "tests/support/messages.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <vector>

namespace {

std::atomic<int> accepts{0};  // that the server has tried

}  // namespace

// In the place of the library's, to count.
extern "C" int accept(int listener, sockaddr* address, socklen_t* size) {
  ++accepts;
  return static_cast<int>(syscall(SYS_accept, listener, address, size));
}

namespace surefoot::server {
namespace {

using test::RawClient;
using test::WebServerTest;
using Clock = std::chrono::steady_clock;

TEST_F(WebServerTest, serves_the_page_and_what_it_asks_for_with_headers_that_keep_others_out) {
  const std::string page = get("/", host());
  EXPECT_EQ(test::status_of(page), 200);
  EXPECT_TRUE(test::holds(page, "<html"));
  for (const char* header :
       {"Content-Security-Policy: default-src 'none'; script-src 'self'; style-src 'self';",
        "frame-ancestors 'none'", "X-Content-Type-Options: nosniff", "Referrer-Policy: no-referrer",
        "Cross-Origin-Opener-Policy: same-origin", "Cross-Origin-Resource-Policy: same-origin",
        "Cache-Control: no-store"}) {
    EXPECT_TRUE(test::holds(page, header)) << header;
  }
  EXPECT_FALSE(test::holds(page, "Access-Control"));
  EXPECT_FALSE(test::holds(page, "unsafe"));
  EXPECT_TRUE(test::holds(get("/api/frames?value=3", host()), "\r\n\r\n/api/frames3"));
  EXPECT_EQ(test::status_of(get("/no_such_file", host())), 404);
  EXPECT_EQ(test::status_of(get("/../index.html", host())), 404);
  EXPECT_EQ(test::status_of(get("/%2e%2e/index.html", host())), 404);
  EXPECT_EQ(test::status_of(get("http://evil.example/", host())), 404);
}

TEST_F(WebServerTest, a_head_has_no_body_and_other_methods_are_refused) {
  RawClient client(server_.port());
  client.send("HEAD / HTTP/1.1\r\nHost: " + host() + "\r\nConnection: close\r\n\r\n");
  const std::string answer = client.receive_all();
  EXPECT_EQ(test::status_of(answer), 200);
  EXPECT_TRUE(answer.ends_with("\r\n\r\n"));
  EXPECT_FALSE(test::holds(answer, "Content-Length: 0"));
  for (const char* method : {"POST", "PUT", "DELETE", "OPTIONS"}) {
    RawClient other(server_.port());
    other.send(std::string(method) + " / HTTP/1.1\r\nHost: " + host() + "\r\n\r\n");
    EXPECT_EQ(test::status_of(other.answer()), 405) << method;
  }
}

TEST_F(WebServerTest, refuses_a_host_that_is_not_its_own) {
  for (const std::string& name :
       {std::string("evil.example"), "evil.example:" + std::to_string(server_.port()),
        std::string("127.0.0.1"), "127.0.0.1.evil.example:" + std::to_string(server_.port())}) {
    EXPECT_EQ(test::status_of(get("/api/session", name)), 421) << name;
    RawClient client(server_.port());
    EXPECT_EQ(client.upgrade(name, origin()), 421) << name;
  }
  RawClient twice(server_.port());
  twice.send("GET / HTTP/1.1\r\nHost: " + host() + "\r\nHost: evil.example\r\n\r\n");
  EXPECT_NE(test::status_of(twice.answer()), 200);
  RawClient none(server_.port());
  none.send("GET / HTTP/1.1\r\n\r\n");
  EXPECT_NE(test::status_of(none.answer()), 200);
}

TEST_F(WebServerTest, refuses_to_be_watched_by_a_page_of_another_origin) {
  for (const std::string& other :
       {std::string("http://evil.example"), std::string("null"), std::string(), "https://" + host(),
        std::string("http://127.0.0.1:1"), origin() + ".evil.example"}) {
    RawClient client(server_.port());
    EXPECT_EQ(client.upgrade(host(), other), 403) << other;
    RawClient reader(server_.port());
    reader.send("GET /api/session HTTP/1.1\r\nHost: " + host() + "\r\nOrigin: " + other +
                "\r\n\r\n");
    EXPECT_EQ(test::status_of(reader.answer()), 403) << other;
  }
  RawClient client(server_.port());
  EXPECT_EQ(client.upgrade(host(), origin()), 101);
}

TEST_F(WebServerTest, tells_nothing_to_pages_of_another_site_that_name_no_origin) {
  const auto asked = [&](const std::string& target, const std::string& site) {
    RawClient client(server_.port());
    client.send("GET " + target + " HTTP/1.1\r\nHost: " + host() + "\r\nSec-Fetch-Site: " + site +
                "\r\n\r\n");
    return test::status_of(client.answer());
  };
  for (const char* site : {"cross-site", "same-site", "Same-Origin", "x"}) {
    EXPECT_EQ(asked("/api/session", site), 403) << site;
  }
  EXPECT_EQ(asked("/", "cross-site"), 200) << "a link to the page is followed";
  EXPECT_EQ(asked("/api/session", "same-origin"), 200);
  EXPECT_EQ(asked("/api/session", "none"), 200) << "typed by the user";
}

TEST_F(WebServerTest, what_is_on_its_way_to_those_who_do_not_read_is_bounded) {
  std::vector<std::unique_ptr<RawClient>> clients;
  const auto ask = [&](const std::string& target) -> RawClient& {
    clients.push_back(std::make_unique<RawClient>(server_.port(), 4096));
    clients.back()->send("GET " + target + " HTTP/1.1\r\nHost: " + host() + "\r\n\r\n");
    return *clients.back();
  };
  for (int i = 0; i < 40; ++i) {
    ASSERT_TRUE(ask("/api/frames?bytes=8000000").receive(20).starts_with("HTTP/1.1 ")) << i;
  }
  EXPECT_EQ(test::status_of(get("/api/session", host())), 503);
  clients.clear();
  int status = 503;
  const Clock::time_point end = Clock::now() + std::chrono::seconds(60);
  while (status == 503 && Clock::now() < end) status = test::status_of(get("/api/session", host()));
  EXPECT_EQ(status, 200) << "once those have left";
}

TEST_F(WebServerTest, a_process_that_may_open_no_more_files_waits_for_one_and_does_not_spin) {
  const int next = dup(0);
  close(next);
  rlimit usual{};
  getrlimit(RLIMIT_NOFILE, &usual);
  rlimit none = usual;
  none.rlim_cur = static_cast<rlim_t>(next) + 1;
  setrlimit(RLIMIT_NOFILE, &none);
  const RawClient client(server_.port());  // has the last of them
  const int before = accepts;
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  const int tries = accepts - before;
  setrlimit(RLIMIT_NOFILE, &usual);
  EXPECT_GE(tries, 1);
  EXPECT_LE(tries, 20);
  EXPECT_TRUE(is_well());
}

TEST_F(WebServerTest, refuses_a_command_without_the_token) {
  RawClient client(server_.port());
  ASSERT_EQ(client.upgrade(host(), origin()), 101);
  EXPECT_TRUE(test::holds(client.hear_text(), "status"));
  for (const char* members : {R"("type":"pause")", R"("type":"pause","token":"wrong")",
                              R"("type":"pause","token":"")", R"("type":"pause","token":7)"}) {
    client.say(R"({"id":7,)" + std::string(members) + "}");
    const std::string reply = client.hear_text();
    EXPECT_TRUE(test::holds(reply, R"("ok":false)")) << reply;
    EXPECT_TRUE(test::holds(reply, "token")) << reply;
  }
  EXPECT_EQ(content_.commands, 0);
  client.say(message(R"("type":"pause")"));
  EXPECT_EQ(client.hear_text(), R"({"type":"reply","id":7,"ok":true})");
  EXPECT_EQ(content_.commands, 1);
}

TEST_F(WebServerTest, another_address_than_loopback_needs_a_token_of_the_users) {
  const std::string text = test::message_of([&] { WebServer({.listen = "0.0.0.0"}, content_); });
  EXPECT_TRUE(test::holds(text, "--token")) << text;
  EXPECT_NO_THROW(WebServer({.listen = "0.0.0.0", .token = "0123456789abcdef"}, content_));
  const std::string name = test::message_of(
      [&] { WebServer({.listen = "somewhere", .token = "0123456789abcdef"}, content_); });
  EXPECT_TRUE(test::holds(name, "not an address")) << name;
}

TEST_F(WebServerTest, a_port_in_use_is_told_with_what_to_do) {
  const std::string text = test::message_of([&] { WebServer({.port = server_.port()}, content_); });
  EXPECT_TRUE(test::holds(text, "is in use")) << text;
  EXPECT_TRUE(test::holds(text, "--port")) << text;
}

TEST_F(WebServerTest, says_what_is_wrong_with_a_message) {
  RawClient client(server_.port());
  ASSERT_EQ(client.upgrade(host(), origin()), 101);
  (void)client.hear_text();
  client.say(message(R"("type":"fly")"));
  const std::string unknown = client.hear_text();
  EXPECT_TRUE(test::holds(unknown, "unknown type")) << unknown;
  EXPECT_TRUE(test::holds(unknown, "resume")) << "valid ones are named: " << unknown;
  client.say(message(R"("type":"push","body":"base","impulse":[1,2],"duration":0.1)"));
  const std::string short_list = client.hear_text();
  EXPECT_TRUE(test::holds(short_list, "impulse")) << short_list;
  client.say(message(R"("type":"reset")"));
  EXPECT_TRUE(test::holds(client.hear_text(), "nothing to reset"));
  const std::string cut = message(R"("type":"reset")").substr(1);
  for (const std::string& text : {"{" + cut + "}", std::string("[]"), message(R"("value":NaN)")}) {
    client.say(text);
    const std::string reply = client.hear_text();
    EXPECT_TRUE(test::holds(reply, "one JSON object")) << reply;
    EXPECT_FALSE(test::holds(reply, "token")) << "there is nothing wrong with it: " << reply;
  }
  client.say(R"({"id":"x","token":")" + server_.token() + R"(","type":"hello"})");
  EXPECT_TRUE(test::holds(client.hear_text(), "`id` must be a whole number"));
}

TEST_F(WebServerTest, that_a_page_has_drawn_needs_no_token_and_gets_no_reply) {
  RawClient client(server_.port());
  ASSERT_EQ(client.upgrade(host(), origin()), 101);
  (void)client.hear_text();
  client.say(R"({"type":"drawn"})");
  client.say(message(R"("type":"hello")"));
  EXPECT_TRUE(test::holds(client.hear_text(), R"("id":7,"ok":true)"));
  EXPECT_EQ(content_.drawings, 1);
  EXPECT_EQ(content_.commands, 0);
}

TEST_F(WebServerTest, a_message_that_is_too_long_ends_the_connection) {
  RawClient client(server_.port());
  ASSERT_EQ(client.upgrade(host(), origin()), 101);
  (void)client.hear_text();
  client.say(std::string(5000, ' '));
  int opcode = 0;
  (void)client.hear(opcode);
  EXPECT_EQ(opcode, 8);
  EXPECT_TRUE(is_well());
}

TEST_F(WebServerTest, more_messages_than_the_rate_end_the_connection) {
  RawClient client(server_.port());
  ASSERT_EQ(client.upgrade(host(), origin()), 101);
  for (int i = 0; i < 100; ++i) client.say(message(R"("type":"pause")"));
  int opcode = 0, replies = 0;
  std::string content;
  while (opcode != 8) {
    content = client.hear(opcode);
    replies += test::holds(content, "reply") ? 1 : 0;
  }
  EXPECT_TRUE(test::holds(content, "60 messages a second")) << content;
  EXPECT_GE(replies, 50);
  EXPECT_LE(replies, 75);
}

TEST_F(WebServerTest, a_request_with_an_endless_header_is_refused) {
  RawClient client(server_.port());
  client.send("GET / HTTP/1.1\r\nHost: " + host() + "\r\n");
  for (int i = 0; i < 200; ++i) {
    if (!client.send("X-" + std::to_string(i) + ": " + std::string(100, 'a') + "\r\n")) break;
  }
  EXPECT_EQ(test::status_of(client.receive()), 431);
  EXPECT_TRUE(is_well());
}

TEST_F(WebServerTest, as_many_pages_may_watch_as_were_allowed) {
  WebServer server({.max_clients = 2}, content_);
  const std::string name = "127.0.0.1:" + std::to_string(server.port());
  RawClient first(server.port()), second(server.port()), third(server.port());
  EXPECT_EQ(first.upgrade(name, "http://" + name), 101);
  EXPECT_EQ(second.upgrade(name, "http://" + name), 101);
  ASSERT_EQ(third.upgrade(name, "http://" + name), 101);
  int opcode = 0;
  const std::string reason = third.hear(opcode);
  EXPECT_EQ(opcode, 8) << "which a page can read; of an answer 503 it hears nothing";
  EXPECT_TRUE(test::holds(reason, "2 pages watch already, the limit")) << reason;
  EXPECT_TRUE(test::holds(reason, "--view-clients")) << reason;
  EXPECT_TRUE(test::holds(first.hear_text(), R"("clients":)")) << "those that watch stay";
}

TEST_F(WebServerTest, a_place_that_gets_free_is_for_the_next_page) {
  WebServer server({.max_clients = 1}, content_);
  const std::string name = "127.0.0.1:" + std::to_string(server.port());
  auto first = std::make_unique<RawClient>(server.port());
  ASSERT_EQ(first->upgrade(name, "http://" + name), 101);
  ASSERT_TRUE(test::holds(first->hear_text(), R"("clients":1})"));
  first.reset();
  const auto is_taken = [&] {
    RawClient next(server.port());
    int opcode = 0;
    return next.upgrade(name, "http://" + name) == 101 && !next.hear(opcode).empty() && opcode == 1;
  };
  bool taken = false;
  for (int i = 0; i < 100 && !taken; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    taken = is_taken();
  }
  EXPECT_TRUE(taken);
}

TEST_F(WebServerTest, says_that_it_is_there_and_which_start_of_the_program_it_is) {
  EXPECT_TRUE(get("/api/alive", host()).ends_with("\r\n\r\nthis one\n"));
  EXPECT_EQ(test::status_of(get("/api/alive", "evil.example")), 421);
}

}  // namespace
}  // namespace surefoot::server
