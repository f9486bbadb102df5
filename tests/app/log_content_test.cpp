#include "app/log_content.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/logging/mcap_chunks.hpp"
#include "surefoot/logging/mcap_writer.hpp"
#include "surefoot/logging/message_codec.hpp"
#include "surefoot/logging/recorder.hpp"
#include "surefoot/view/frame_block.hpp"
#include "tests/logging/synthetic_run.hpp"
#include "tests/logging/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <thread>

namespace surefoot {
namespace {

using nlohmann::json;
using test::SyntheticRun;

constexpr int kTicks = 2000;  // five seconds, each a chunk or more

/// A log on which the tests do harm.
class DamagedLog : public testing::Test {
 protected:
  void SetUp() override { record(kTicks); }

  void record(int ticks, const std::string& stack = "", int first = 0) {
    Recorder recorder(path(), SyntheticRun::header());
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
    recorder.close();
  }

  [[nodiscard]] std::string path() const { return folder_ / "run.mcap"; }

  /// Turns a byte in the middle of a chunk.
  void damage(std::size_t chunk) { damage(chunk, McapChunks(path()).chunks().at(chunk).size / 2); }

  void damage(std::size_t chunk, std::uint64_t byte) {
    const McapChunk place = McapChunks(path()).chunks().at(chunk);
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
    McapReader source(path());
    std::vector<Message> all;
    for (McapMessage message; source.next(message);)
      all.push_back({message.channel->topic, std::string(message.data), message.log_time});
    return all;
  }

  /// Writes a log of these messages, of which the n-th on a topic is no signal.
  [[nodiscard]] std::string with_broken_message(const std::string& broken, int number,
                                                const std::vector<Message>& all) const {
    const std::string changed = folder_ / "changed.mcap";
    McapWriter writer(changed);
    std::map<std::string, std::uint16_t> channels;
    const McapReader source(path());
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

  static json session(LogContent& content) {
    return json::parse(content.get("/api/session", {}).body);
  }

  /// The session once all of the log is summarised.
  static json whole_session(LogContent& content) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (std::chrono::steady_clock::now() < end) {
      json now = session(content);
      if (now.at("summarised") == now.at("ticks")) return now;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    ADD_FAILURE() << "the log is not summarised in a minute";
    return session(content);
  }

  static std::vector<ViewFrame> frames(LogContent& content, std::uint32_t from, std::uint32_t count,
                                       std::uint32_t stride = 1, bool min_max = false) {
    const WebAnswer answer = content.get("/api/frames", {{"from", std::to_string(from)},
                                                         {"count", std::to_string(count)},
                                                         {"stride", std::to_string(stride)},
                                                         {"min_max", min_max ? "1" : "0"}});
    EXPECT_EQ(answer.status, 200) << answer.body;
    return read_block(answer.body, session(content).at("frame_floats")).frames;
  }

  static std::size_t marks_of_damage(LogContent& content) {
    const json events = json::parse(content.get("/api/events", {}).body);
    return static_cast<std::size_t>(std::ranges::count_if(events, [](const json& event) {
      return event.is_object() && event.at("kind") == "damage";
    }));
  }

  test::TemporaryFolder folder_;
};

TEST_F(DamagedLog, a_whole_one_has_no_damage_and_all_its_ticks) {
  LogContent content(path());
  const json session = whole_session(content);
  EXPECT_EQ(session.at("ticks"), kTicks);
  EXPECT_EQ(session.at("damage"), json::array());
  EXPECT_EQ(frames(content, 0, kTicks).size(), kTicks);
  EXPECT_EQ(marks_of_damage(content), 0u);
}

TEST_F(DamagedLog, a_damaged_chunk_costs_its_ticks_and_is_told) {
  damage(2);
  LogContent content(path());
  const json session = whole_session(content);
  EXPECT_EQ(session.at("ticks"), kTicks);
  ASSERT_EQ(session.at("damage").size(), 1u) << session.at("damage");
  EXPECT_NE(session.at("damage")[0].get<std::string>().find("can't be read"), std::string::npos);
  EXPECT_EQ(session.at("damage")[0].get<std::string>().find(path()), std::string::npos);
  EXPECT_EQ(marks_of_damage(content), 1u);
  const std::size_t left = frames(content, 0, kTicks).size();
  EXPECT_LT(left, kTicks);
  EXPECT_GT(left, kTicks / 2);
}

TEST_F(DamagedLog, also_where_it_is_the_first_that_describes_the_channels) {
  damage(0);
  LogContent content(path());
  EXPECT_EQ(whole_session(content).at("damage").size(), 1u);
  const auto read = frames(content, 0, kTicks);
  ASSERT_FALSE(read.empty());
  EXPECT_GT(read.size(), kTicks / 2);
  EXPECT_GT(read.front().tick, 0u);
}

TEST_F(DamagedLog, one_whose_clock_begins_late_begins_there) {
  constexpr int kFirst = 700;
  record(6000, "", kFirst);
  LogContent content(path());
  const json session = whole_session(content);
  EXPECT_EQ(session.at("first_tick"), kFirst);
  EXPECT_EQ(session.at("ticks"), 6000 - kFirst);
  EXPECT_EQ(session.at("damage"), json::array());
  const auto read = frames(content, kFirst, 4096);
  ASSERT_EQ(read.size(), 4096u);
  EXPECT_EQ(read.front().tick, kFirst);
  EXPECT_EQ(read.front().time, SyntheticRun::kPeriod * kFirst);
  const auto coarse = frames(content, kFirst, 512, 12);
  ASSERT_EQ(coarse.size(), (6000u - kFirst + 63) / 64);
  EXPECT_EQ(coarse.front().tick, kFirst);
  EXPECT_EQ(frames(content, kFirst, 512, 32, true).size(), 2u * ((6000 - kFirst + 31) / 32));
}

TEST_F(DamagedLog, damaged_timings_cost_no_tick) {
  damage(McapChunks(path()).chunks().size() - 1);
  LogContent content(path());
  const json session = whole_session(content);
  EXPECT_EQ(frames(content, 0, kTicks).size(), kTicks);
  ASSERT_GE(session.at("damage").size(), 1u);
  EXPECT_EQ(session.at("damage")[0].get<std::string>().find("timings of"), 0u);
}

TEST_F(DamagedLog, a_chunk_whose_times_are_wrong_does_not_take_the_others_with_it) {
  damage(2, 15);  // the last time's highest byte
  LogContent content(path());
  EXPECT_EQ(whole_session(content).at("damage").size(), 1u);
  const auto read = frames(content, 0, kTicks);
  EXPECT_GT(read.size(), kTicks / 2);
  EXPECT_EQ(read.back().tick, kTicks - 1);
}

TEST_F(DamagedLog, a_message_that_is_no_signal_costs_its_tick_and_no_more) {
  const std::string changed = with_broken_message("/state", 0, messages());
  LogContent content(changed);
  EXPECT_EQ(whole_session(content).at("damage").size(), 1u);
  const auto read = frames(content, 0, kTicks);
  EXPECT_EQ(read.size(), kTicks - 1);
  EXPECT_EQ(read.front().tick, 1u);
}

TEST_F(DamagedLog, timings_that_are_none_cost_no_tick_that_stands_in_their_chunk) {
  std::vector<Message> mixed = messages();
  std::ranges::stable_sort(mixed, {}, &Message::time);
  LogContent content(with_broken_message("/timings", kTicks / 2, mixed));
  const json session = whole_session(content);
  EXPECT_EQ(frames(content, 0, kTicks).size(), kTicks);
  ASSERT_EQ(session.at("damage").size(), 1u) << session.at("damage");
  EXPECT_EQ(session.at("damage")[0].get<std::string>().find("timings of"), 0u);
}

TEST_F(DamagedLog, a_tick_of_which_a_part_is_lost_is_lost) {
  LogContent whole(path());
  const auto all = frames(whole, 0, kTicks);
  ASSERT_EQ(all.size(), kTicks);
  const std::vector<McapChunk> chunks = McapChunks(path()).chunks();
  std::size_t end = 1;  // behind the ticks, where the timings begin
  while (chunks.at(end).first_time >= chunks[end - 1].first_time) ++end;
  ASSERT_GT(end, 5u);
  for (std::size_t chunk = 1; chunk < end; ++chunk) {
    damage(chunk);
    LogContent content(path());
    for (const ViewFrame& frame : frames(content, 0, kTicks)) {
      const std::vector<float>& floats = all.at(frame.tick).floats;
      ASSERT_EQ(frame.floats.size(), floats.size());
      const std::size_t size = floats.size() * sizeof(float);
      ASSERT_EQ(std::memcmp(frame.floats.data(), floats.data(), size), 0)
          << "tick " << frame.tick << " beside chunk " << chunk;
    }
    damage(chunk);  // as it was
  }
}

TEST_F(DamagedLog, a_change_whose_stack_is_no_yaml_is_told) {
  record(1200, "levels: [\n  {name: a");
  LogContent content(path());
  const json session = whole_session(content);
  ASSERT_EQ(session.at("damage").size(), 1u);
  EXPECT_NE(session.at("damage")[0].get<std::string>().find("order of the levels"),
            std::string::npos);
  EXPECT_EQ(session.at("orders").size(), 1u);
}

TEST_F(DamagedLog, nothing_that_can_be_read_is_refused_with_what_to_do) {
  const std::size_t all = McapChunks(path()).chunks().size();
  for (std::size_t i = 0; i < all; ++i) damage(i);
  try {
    const LogContent content(path());
    FAIL() << "it was taken";
  } catch (const FileError& error) {
    EXPECT_NE(std::string(error.what()).find("record the run anew"), std::string::npos);
  }
}

TEST_F(DamagedLog, long_strides_are_answered_from_the_summary_at_once) {
  record(6000);
  LogContent content(path());
  EXPECT_EQ(whole_session(content).at("ticks"), 6000);
  const auto coarse = frames(content, 0, 512, 12);
  ASSERT_EQ(coarse.size(), (6000u + 63) / 64);
  for (std::size_t i = 0; i < coarse.size(); ++i) {
    const auto fine = frames(content, coarse[i].tick, 1);
    ASSERT_EQ(fine.size(), 1u);
    EXPECT_EQ(fine[0].tick, 64 * i);
    EXPECT_EQ(fine[0].active.size(), coarse[i].active.size());
  }
  EXPECT_EQ(frames(content, 0, 4096).size(), 4096u);
  EXPECT_EQ(frames(content, 0, 512, 32, true).size(), 2u * ((6000 + 31) / 32));
}

}  // namespace
}  // namespace surefoot
