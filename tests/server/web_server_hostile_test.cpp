// Pages that are slow, many, or make no sense.
#include "server/web_server.hpp"
#include "tests/server/fake_server.hpp"
#include "tests/server/raw_client.hpp"
#include "tests/support/damaged_bytes.hpp"
#include "tests/support/messages.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <memory>
#include <random>
#include <thread>
#include <vector>

namespace surefoot::server {
namespace {

using test::RawClient;
using test::WebServerTest;

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

TEST_F(WebServerTest, many_who_ask_at_once_for_much_keep_no_block_from_those_who_watch) {
  content_.answer_time = std::chrono::milliseconds(50);  // longer than between two blocks
  std::vector<std::unique_ptr<RawClient>> clients;
  for (int i = 0; i < 30; ++i) {
    clients.push_back(std::make_unique<RawClient>(server_.port()));
    clients.back()->send("GET /api/session HTTP/1.1\r\nHost: " + host() + "\r\n\r\n");
  }
  for (const auto& client : clients) ASSERT_EQ(test::status_of(client->answer()), 200);
  EXPECT_LE(content_.most_at_once, 1);
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
}  // namespace surefoot::server
