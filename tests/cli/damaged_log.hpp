#pragma once

#include "server/log_content.hpp"
#include "surefoot/logging/mcap_chunks.hpp"
#include "surefoot/logging/mcap_writer.hpp"
#include "surefoot/logging/message_codec.hpp"
#include "surefoot/logging/recorder.hpp"
#include "tests/logging/synthetic_run.hpp"
#include "tests/logging/temporary_folder.hpp"
#include "tests/server/read_block.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <thread>
#include <vector>

namespace surefoot::test {

inline constexpr int kTicks = 2000;  ///< five seconds, each a chunk or more

/// A log on which the tests do harm.
class DamagedLog : public testing::Test {
 protected:
  void SetUp() override { record(kTicks); }

  void record(int ticks, const std::string& stack = "", int first = 0,
              const std::string& summary = R"({"metrics":{},"criteria":[]})") {
    logging::Recorder recorder(path(), SyntheticRun::header());
    const auto changes = recorder.add_channel("/changes", "surefoot.Change",
                                              logged::schema<logged::Change>("surefoot.Change"));
    SyntheticRun run(3);
    for (int i = 0; i < ticks; ++i) {
      run.step();
      if (i < first) continue;
      if (i == 700 && !stack.empty()) {
        const logged::Change change{.time = run.tick.reading.time,
                                    .kind = "stack",
                                    .text = "x",
                                    .stack = stack,
                                    .body = {}};
        recorder.record(changes, change.time,
                        [change](std::string& out) { logged::encode(change, out); });
      }
      recorder.record(run.tick);
      recorder.record(run.timing);
    }
    if (!summary.empty()) recorder.close(summary);
  }

  [[nodiscard]] std::string path() const { return folder_ / "run.mcap"; }

  /// Turns a byte in the middle of a chunk.
  void damage(std::size_t chunk) {
    damage(chunk, logging::McapChunks(path()).chunks().at(chunk).size / 2);
  }

  void damage(std::size_t chunk, std::uint64_t byte) {
    const logging::McapChunk place = logging::McapChunks(path()).chunks().at(chunk);
    std::string bytes = test::contents(path());
    bytes.at(place.offset + byte) ^= '\xFF';
    test::write_file(path(), bytes);
  }

  struct Message {
    std::string topic, data;
    std::uint64_t time;
  };

  /// All of the log, in its order.
  [[nodiscard]] std::vector<Message> messages() const {
    logging::McapReader source(path());
    std::vector<Message> all;
    for (logging::McapMessage message; source.next(message);)
      all.push_back({message.channel->topic, std::string(message.data), message.log_time});
    return all;
  }

  /// Writes a log of these messages, of which the n-th on a topic is no signal.
  [[nodiscard]] std::string with_broken_message(const std::string& broken, int number,
                                                const std::vector<Message>& all) const {
    const std::string changed = folder_ / "changed.mcap";
    logging::McapWriter writer(changed);
    std::map<std::string, std::uint16_t> channels;
    const logging::McapReader source(path());
    for (const auto& [name, data] : source.attachments())
      writer.attach(name, "application/json", data);
    for (const auto& [topic, data, time] : all) {
      if (!channels.contains(topic)) {
        const std::uint16_t schema = writer.add_schema(topic, "jsonschema", "{}");
        channels[topic] = writer.add_channel(topic, schema, "json");
      }
      const bool is_broken = topic == broken && number-- == 0;
      writer.write(channels[topic], time, is_broken ? "{\"time\":\"no\"}" : data);
    }
    writer.close();
    return changed;
  }

  static nlohmann::json session(server::LogContent& content) {
    return nlohmann::json::parse(content.get("/api/session", {}).body);
  }

  /// The session once all of the log is summarised.
  static nlohmann::json whole_session(server::LogContent& content) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (std::chrono::steady_clock::now() < end) {
      nlohmann::json now = session(content);
      if (now.at("summarised") == now.at("ticks")) return now;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    ADD_FAILURE() << "the log is not summarised in a minute";
    return session(content);
  }

  static std::vector<server::ViewFrame> frames(server::LogContent& content, std::uint32_t from,
                                               std::uint32_t count, std::uint32_t stride = 1,
                                               bool min_max = false) {
    const server::WebAnswer answer = content.get("/api/frames", {{"from", std::to_string(from)},
                                                                 {"count", std::to_string(count)},
                                                                 {"stride", std::to_string(stride)},
                                                                 {"min_max", min_max ? "1" : "0"}});
    EXPECT_EQ(answer.status, 200) << answer.body;
    return server::read_block(answer.body, session(content).at("frame_floats")).frames;
  }

  static std::size_t marks_of_damage(server::LogContent& content) {
    const nlohmann::json events = nlohmann::json::parse(content.get("/api/events", {}).body);
    return static_cast<std::size_t>(std::ranges::count_if(events, [](const nlohmann::json& event) {
      return event.is_object() && event.at("kind") == "damage";
    }));
  }

  test::TemporaryFolder folder_;
};

}  // namespace surefoot::test
