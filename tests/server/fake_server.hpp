#pragma once

#include "server/web_server.hpp"
#include "tests/server/raw_client.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <memory>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace surefoot::test {

/// A live run that is none: its blocks are as large as they are asked to be.
class FakeContent final : public server::WebContent {
 public:
  server::WebAnswer get(std::string_view path, const Query& query) override {
    const auto bytes = query.find("bytes"), value = query.find("value");
    most_at_once = std::max(most_at_once.load(), ++answers_);
    std::this_thread::sleep_for(answer_time.load());
    if (bytes != query.end()) return {.body = std::string(std::stoul(bytes->second), 'x')};
    return {200, "text/plain", std::string(path) + (value == query.end() ? "" : value->second)};
  }
  [[nodiscard]] std::string start() const override { return "this one"; }
  [[nodiscard]] bool is_live() const override { return true; }
  std::vector<server::SharedBlock> blocks() override {
    ++calls;
    answers_ = 0;
    std::vector<server::SharedBlock> blocks;
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
  std::string command(const server::ViewCommand& command) override {
    ++commands;
    return command.type == server::ViewCommandType::reset ? "there is nothing to reset" : "";
  }

  void drawn() override { ++drawings; }

  std::atomic<std::size_t> block_bytes{0};
  std::atomic<int> calls{0}, commands{0}, drawings{0};
  std::atomic<int> most_at_once{0};  // answers without a block between them
  std::atomic<std::chrono::milliseconds> answer_time{};
  std::atomic<bool> talks{false};   // a status with every block
  std::atomic<bool> counts{false};  // … or one with a number, and with every third a change

 private:
  std::vector<std::string> counted() {
    const std::string number = std::to_string(++count_);
    std::vector<std::string> texts{R"({"type":"status","number":)" + number + "}"};
    if (count_ % 3 == 0) texts.push_back(R"({"type":"change","number":)" + number + "}");
    return texts;
  }

  int count_ = 0, answers_ = 0;
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
  [[nodiscard]] bool is_well() const { return status_of(get("/api/session", host())) == 200; }

  FakeContent content_;
  server::WebServer server_{{}, content_};
};

}  // namespace surefoot::test
