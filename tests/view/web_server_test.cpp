#include "surefoot/view/web_server.hpp"

#include "surefoot/base/error.hpp"
#include "tests/config/messages.hpp"
#include "tests/support/damaged_bytes.hpp"
#include "tests/view/raw_client.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstring>
#include <memory>
#include <random>
#include <thread>
#include <vector>

namespace {

std::atomic<int> accepts{0};  // that the server has tried

}  // namespace

// In the place of the library's, to count.
extern "C" int accept(int listener, sockaddr* address, socklen_t* size) {
  ++accepts;
  return static_cast<int>(syscall(SYS_accept, listener, address, size));
}

namespace surefoot {
namespace {

using test::RawClient;
using Clock = std::chrono::steady_clock;

/// A live run that is none: its blocks are as large as they are asked to be.
class FakeContent final : public WebContent {
 public:
  WebAnswer get(std::string_view path, const Query& query) override {
    const auto bytes = query.find("bytes"), value = query.find("value");
    if (bytes != query.end()) return {.body = std::string(std::stoul(bytes->second), 'x')};
    return {200, "text/plain", std::string(path) + (value == query.end() ? "" : value->second)};
  }
  [[nodiscard]] bool is_live() const override { return true; }
  std::vector<SharedBlock> blocks() override {
    ++calls;
    std::vector<SharedBlock> blocks;
    const auto bytes = std::make_shared<std::string>(block_bytes.load(), 'x');
    if (!bytes->empty()) blocks.push_back({.frames = 1, .bytes = bytes});
    return blocks;
  }
  std::vector<std::string> messages(std::size_t clients) override {
    if (counts) return counted();
    if (!talks) return {};
    return {status(clients) + " late"};
  }
  std::string status(std::size_t clients) override {
    return R"({"type":"status","clients":)" + std::to_string(clients) + "}";
  }
  std::string command(const ViewCommand& command) override {
    ++commands;
    return command.type == ViewCommandType::undo ? "there is nothing to undo" : "";
  }

  std::atomic<std::size_t> block_bytes{0};
  std::atomic<int> calls{0}, commands{0};
  std::atomic<bool> talks{false};   // a status with every block
  std::atomic<bool> counts{false};  // … or one with a number, and with every third a change

 private:
  std::vector<std::string> counted() {
    const std::string number = std::to_string(++count_);
    std::vector<std::string> texts{R"({"type":"status","number":)" + number + "}"};
    if (count_ % 3 == 0) texts.push_back(R"({"type":"change","number":)" + number + "}");
    return texts;
  }

  int count_ = 0;
};

class WebServerTest : public ::testing::Test {
 protected:
  [[nodiscard]] std::string host() const { return "127.0.0.1:" + std::to_string(server_.port()); }
  [[nodiscard]] std::string origin() const { return "http://" + host(); }

  [[nodiscard]] std::string get(const std::string& target, const std::string& host) const {
    RawClient client(server_.port());
    client.send("GET " + target + " HTTP/1.1\r\nHost: " + host + "\r\n\r\n");
    return client.answer();
  }

  [[nodiscard]] std::string message(const std::string& members) const {
    return R"({"id":7,"token":")" + server_.token() + "\"," + members + "}";
  }

  /// Whether the server still does what it is for.
  [[nodiscard]] bool is_well() const { return test::status_of(get("/api/session", host())) == 200; }

  FakeContent content_;
  WebServer server_{{}, content_};
};

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
  EXPECT_TRUE(test::holds(short_list, "list of 3 numbers")) << short_list;
  client.say(message(R"("type":"undo")"));
  EXPECT_TRUE(test::holds(client.hear_text(), "nothing to undo"));
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

TEST_F(WebServerTest, says_that_it_is_there) {
  EXPECT_EQ(test::status_of(get("/api/alive", host())), 200);
  EXPECT_EQ(test::status_of(get("/api/alive", "evil.example")), 421);
}

TEST_F(WebServerTest, a_page_that_does_not_read_loses_blocks_and_nobody_waits_for_it) {
  RawClient slow(server_.port(), 4096), quick(server_.port());
  ASSERT_EQ(slow.upgrade(host(), origin()), 101);
  ASSERT_EQ(quick.upgrade(host(), origin()), 101);
  content_.block_bytes = 256 << 10;
  const int before = content_.calls;
  std::uint32_t blocks = 0, dropped = 1;
  for (int opcode = 0; blocks < 40;) {
    const std::string content = quick.hear(opcode);
    ASSERT_NE(opcode, 8);
    if (opcode != 2) continue;
    ++blocks;
    std::memcpy(&dropped, content.data() + 8, sizeof(dropped));
  }
  EXPECT_EQ(dropped, 0u) << "of the page that reads";
  EXPECT_GE(content_.calls - before, 38);
  std::uint32_t slow_dropped = 0;
  for (int opcode = 0, read = 0; read < 30 && opcode != 8;) {
    const std::string content = slow.hear(opcode);
    if (opcode != 2) continue;
    ++read;
    std::memcpy(&slow_dropped, content.data() + 8, sizeof(slow_dropped));
  }
  EXPECT_GT(slow_dropped, 5u);
}

TEST_F(WebServerTest, a_slow_page_hears_of_its_status_and_commands_before_the_frames_that_wait) {
  RawClient slow(server_.port(), 4096);
  ASSERT_EQ(slow.upgrade(host(), origin()), 101);
  content_.block_bytes = 256 << 10;
  std::this_thread::sleep_for(std::chrono::milliseconds(1500));
  content_.talks = true;
  ASSERT_TRUE(slow.say(message(R"("type":"pause")")));
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  // What is in the operating system's buffers already comes first.
  bool status = false, replied = false;
  int blocks = 0;
  for (int opcode = 0; blocks < 18 && !(status && replied);) {
    const std::string content = slow.hear(opcode);
    ASSERT_NE(opcode, 8);
    blocks += opcode == 2 ? 1 : 0;
    replied = replied || (opcode == 1 && content.find("reply") != std::string::npos);
    status = status || (opcode == 1 && content.find("late") != std::string::npos);
    std::this_thread::sleep_for(std::chrono::milliseconds(40));
  }
  EXPECT_TRUE(status);
  EXPECT_TRUE(replied);
}

TEST_F(WebServerTest, no_status_overtakes_what_was_said_before_it_however_slow_the_page_is) {
  RawClient slow(server_.port(), 4096);
  ASSERT_EQ(slow.upgrade(host(), origin()), 101);
  content_.block_bytes = 256 << 10;
  content_.counts = true;
  std::this_thread::sleep_for(std::chrono::milliseconds(1500));
  content_.block_bytes = 0;
  int changes = 0, last = 0, longest_step = 0;
  for (int opcode = 0; changes < 12;) {
    const std::string text = slow.hear(opcode);
    ASSERT_NE(opcode, 8);
    const std::size_t found = text.find(R"("number":)");
    if (opcode != 1 || found == std::string::npos) continue;
    const int number = std::stoi(text.substr(found + 9));
    ASSERT_GE(number, last) << text;
    longest_step = std::max(longest_step, number - last);
    last = number;
    changes += test::holds(text, "change") ? 1 : 0;
  }
  EXPECT_GT(longest_step, 1) << "of those that waited one after the other the last is told";
}

TEST_F(WebServerTest, a_thousand_pages_come_and_go) {
  for (int i = 0; i < 1000; ++i) {
    RawClient client(server_.port());
    const bool watches = i % 2 == 0;
    if (watches) {
      ASSERT_EQ(client.upgrade(host(), origin()), 101) << i;
    } else {
      client.send("GET /api/session HTTP/1.1\r\nHost: " + host() + "\r\n\r\n");
      ASSERT_EQ(test::status_of(client.answer()), 200) << i;
    }
  }
  EXPECT_TRUE(is_well());
}

TEST_F(WebServerTest, requests_that_make_no_sense_do_no_harm) {
  std::mt19937 random(11);
  const std::string good = "GET /api/frames?from=0&count=4 HTTP/1.1\r\nHost: " + host() +
                           "\r\nConnection: close\r\nOrigin: " + origin() +
                           "\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n\r\n";
  for (int trial = 0; trial < test::trials(400); ++trial) {
    const RawClient client(server_.port());
    client.send(test::damaged(good, random));
  }
  EXPECT_TRUE(is_well());
}

TEST_F(WebServerTest, frames_and_messages_that_make_no_sense_do_no_harm) {
  std::mt19937 random(12);
  const std::string push =
      message(R"("type":"push","body":"base","impulse":[0,20,0],"duration":0.2)");
  for (int trial = 0; trial < test::trials(400); ++trial) {
    RawClient client(server_.port());
    ASSERT_EQ(client.upgrade(host(), origin()), 101) << trial;
    if (trial % 2 == 0) {
      client.send(test::damaged(test::client_frame(static_cast<int>(random() % 16), push), random));
    } else {
      client.say(test::damaged(push, random));
    }
  }
  EXPECT_TRUE(is_well());
  RawClient client(server_.port());
  EXPECT_EQ(client.upgrade(host(), origin()), 101) << "those who left are not counted";
}

TEST_F(WebServerTest, conversations_that_make_no_sense_do_no_harm_while_blocks_are_on_their_way) {
  std::mt19937 random(17);
  content_.block_bytes = 64 << 10;
  content_.counts = true;
  const std::vector<std::string> good{
      message(R"("type":"pause")"),
      message(R"("type":"speed","factor":4)"),
      message(R"("type":"pull","body":"base","point":[0.1,0,0],"force":[0,100,20])"),
      message(R"("type":"order","levels":["equations_of_motion","torque_limits"])"),
      std::string(),
      std::string(4096, '['),
      std::string(125, '\xff')};
  for (int trial = 0; trial < test::trials(60); ++trial) {
    RawClient client(server_.port(), random() % 2 == 0 ? 0 : 4096);
    ASSERT_EQ(client.upgrade(host(), origin()), 101) << trial;
    for (auto count = random() % 12; count > 0; --count) {
      const std::string& text = good[random() % good.size()];
      std::string frame = test::client_frame(static_cast<int>(random() % 16), text);
      if (random() % 3 == 0) frame[0] = static_cast<char>(frame[0] & 0x7F);  // more is to follow
      if (random() % 3 == 0) frame = test::damaged(frame, random);
      if (!client.send(frame)) break;
      if (random() % 4 == 0) (void)client.receive(1 + random() % 100000);
    }
  }
  EXPECT_TRUE(is_well());
}

TEST_F(WebServerTest, deeply_nested_json_does_no_harm) {
  RawClient client(server_.port());
  ASSERT_EQ(client.upgrade(host(), origin()), 101);
  (void)client.hear_text();
  client.say(R"({"type":)" + std::string(4000, '['));
  EXPECT_TRUE(test::holds(client.hear_text(), R"("ok":false)"));
}

}  // namespace
}  // namespace surefoot
