#include "app/log_content.hpp"

#include "app/log_frames.hpp"
#include "surefoot/base/error.hpp"
#include "surefoot/logging/log_reader.hpp"
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

constexpr std::uint32_t kNone = UINT32_MAX;
constexpr std::uint64_t kTickTime = 2'500'000;  // [ns]
constexpr int kTicks = 2000;                    // five seconds, each a chunk or more

/// A log on which the tests do harm.
class DamagedLog : public testing::Test {
 protected:
  void SetUp() override { record(kTicks); }

  void record(int ticks, const std::string& stack = "", int first = 0,
              const std::string& summary = R"({"metrics":{},"criteria":[]})") {
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
    if (!summary.empty()) recorder.close(summary);
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

  /// A message outside of chunks.
  struct Bare {
    std::string topic;
    std::uint64_t time, offset;  ///< of its record
  };

  /// Writes the log anew without chunks.
  void write_without_chunks() {
    std::string bytes(mcap::kMagic);
    std::map<std::uint16_t, std::string> topics;
    bare_.clear();
    const auto take = [&](mcap::Opcode opcode, std::string_view content) {
      if (opcode == mcap::Opcode::channel) {
        const mcap::ChannelRecord channel = mcap::channel_record(content);
        topics[channel.id] = channel.topic;
      }
      if (opcode == mcap::Opcode::message) {
        const mcap::MessageRecord message = mcap::message_record(content);
        bare_.push_back({topics.at(message.channel), message.log_time, bytes.size()});
      }
      bytes += record_of(opcode, content);
    };
    mcap::RecordWalk walk(path());
    while (walk.next() && walk.opcode() != mcap::Opcode::data_end) {
      const std::string content = walk.content();
      if (walk.opcode() == mcap::Opcode::message_index) continue;
      if (walk.opcode() != mcap::Opcode::chunk) {
        take(walk.opcode(), content);
        continue;
      }
      const std::string records = mcap::chunk_records(content);
      for (mcap::Cursor cursor(records); !cursor.rest().empty();) {
        const auto [opcode, length] = mcap::take_head(cursor);
        take(opcode, cursor.bytes(length));
      }
    }
    bytes += record_of(mcap::Opcode::data_end, std::string(4, '\0'));
    bytes += record_of(mcap::Opcode::footer, std::string(20, '\0'));
    test::write_file(path(), bytes + std::string(mcap::kMagic));
  }

  static std::string number(std::uint64_t value) {
    std::string bytes;
    for (unsigned shift = 0; shift < 64; shift += 8)
      bytes += static_cast<char>((value >> shift) & 0xFF);
    return bytes;
  }

  static std::string record_of(mcap::Opcode opcode, std::string_view content) {
    return static_cast<char>(opcode) + number(content.size()) + std::string(content);
  }

  /// The message on a topic at a tick, of a log without chunks.
  [[nodiscard]] Bare bare(const std::string& topic, std::uint64_t tick) const {
    const auto found = std::ranges::find_if(
        bare_, [&](const Bare& one) { return one.topic == topic && one.time == tick * kTickTime; });
    if (found == bare_.end()) throw FileError("no such message");
    return *found;
  }

  void write_time(const Bare& message, std::uint64_t time) {
    std::string bytes = test::contents(path());
    bytes.replace(message.offset + mcap::kRecordHead + 6, 8, number(time));
    test::write_file(path(), bytes);
  }

  /// All ticks but one can be read, and the damage is told once.
  void expect_only_lost(std::uint32_t tick, const std::string& told) {
    LogContent content(path());
    const json session = whole_session(content);
    EXPECT_EQ(session.at("ticks"), kTicks);
    ASSERT_EQ(session.at("damage").size(), 1u) << session.at("damage");
    EXPECT_NE(session.at("damage")[0].get<std::string>().find(told), std::string::npos)
        << session.at("damage");
    std::uint32_t next = 0;
    for (const ViewFrame& frame : frames(content, 0, kTicks)) {
      if (next == tick) ++next;
      ASSERT_EQ(frame.tick, next++);
    }
    EXPECT_EQ(next + (next == tick ? 1 : 0), kTicks);
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
  std::vector<Bare> bare_;  // of the log without chunks
};

TEST_F(DamagedLog, a_whole_one_has_no_damage_and_all_its_ticks) {
  LogContent content(path());
  const json session = whole_session(content);
  EXPECT_EQ(session.at("ticks"), kTicks);
  EXPECT_EQ(session.at("damage"), json::array());
  EXPECT_EQ(frames(content, 0, kTicks).size(), kTicks);
  EXPECT_EQ(marks_of_damage(content), 0u);
}

TEST_F(DamagedLog, why_a_run_does_not_end_where_it_should_is_told) {
  const std::string unknown =
      "how the run ended is not known: the log's file is whole, but has no summary";
  const auto end = [](const std::string& reason) {
    return R"({"metrics":{"reason":)" + reason + R"(},"criteria":[]})";
  };
  const std::string whole = ": the log's file is whole, and ends there";
  const std::vector<std::array<std::string, 3>> cases{
      {end(R"("fell")"), "", "fell"},
      {end(R"("interrupted")"), "the run was interrupted" + whole, "interrupted"},
      {end(R"("begun again")"), "the run was begun again" + whole, "begun again"},
      {end("null"), unknown, ""},
      {R"({"metrics":{},"criteria":{"fell":true}})", unknown, ""},
      {"{}", unknown, ""},
      {"", unknown, ""}};  // the program ended in an exception
  for (const auto& [summary, cut, ended] : cases) {
    SCOPED_TRACE(summary);
    record(400, "", 0, summary);
    LogContent content(summary.empty() ? path() + ".partial" : path());
    const json session = whole_session(content);
    EXPECT_EQ(session.at("cut"), cut);
    EXPECT_EQ(session.at("ended"), ended);
    EXPECT_EQ(std::ranges::count(content.notes(), cut), cut.empty() ? 0 : 1);
    EXPECT_EQ(marks_of_damage(content), 0u);
  }
}

TEST_F(DamagedLog, a_log_that_was_not_closed_says_so_and_has_a_mark_at_its_end) {
  const std::string bytes = test::contents(path());
  test::write_file(path(), bytes.substr(0, bytes.size() / 2));
  LogContent content(path());
  const json session = whole_session(content);
  LogReader reader(path());
  TickRecord tick;
  while (reader.next(tick)) {
  }
  EXPECT_TRUE(reader.problem().starts_with("cut off at byte ")) << reader.problem();
  const std::string byte = std::to_string(std::stoul(reader.problem().substr(16)));
  EXPECT_EQ(session.at("cut"), "the log was never closed, or is cut off (at byte " + byte +
                                   "): what is left of it is shown");
  const json events = json::parse(content.get("/api/events", {}).body);
  ASSERT_FALSE(events.empty());
  EXPECT_EQ(events.back().at("kind"), "damage");
  const double last = 0.0025 * (session.at("ticks").get<int>() - 1);
  EXPECT_NEAR(events.back().at("time").get<double>(), last, 1e-9);
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

TEST_F(DamagedLog, a_wrong_time_of_one_message_without_chunks_costs_its_tick_and_is_told) {
  write_without_chunks();
  for (const std::uint64_t time :
       {60'000'000'000ULL, ((1ULL << 32) + 100) * kTickTime, 1ULL << 63, ~0ULL}) {
    for (const std::uint32_t tick : {0u, 701u, kTicks - 2u}) {
      for (const std::string topic : {"/readings", "/command"}) {
        SCOPED_TRACE(topic + " of tick " + std::to_string(tick) + " at " + std::to_string(time));
        const Bare message = bare(topic, tick);
        write_time(message, time);
        expect_only_lost(tick, "1 piece of the log can't be read");
        LogFrames frames(path(), LogReader(path()).header());
        for (std::size_t i = 0; i < frames.num_chunks(); ++i)
          EXPECT_LE(frames.chunk(i)->frames.size(), 401u) << "not all is in memory at once";
        write_time(message, message.time);
      }
    }
    const Bare timing = bare("/timings", 701);
    write_time(timing, time);
    expect_only_lost(kNone, "1 piece of the log can't be read");
    write_time(timing, timing.time);
  }
}

TEST_F(DamagedLog, a_clock_that_skips_is_no_damage_without_chunks_either) {
  constexpr std::uint32_t kFirstBehind = 1000, kSkip = 24'000;
  write_without_chunks();
  std::string bytes = test::contents(path());
  for (const Bare& message : bare_) {
    if (message.time < kFirstBehind * kTickTime) continue;
    bytes.replace(message.offset + mcap::kRecordHead + 6, 8,
                  number(message.time + kSkip * kTickTime));
  }
  test::write_file(path(), bytes);
  LogContent content(path());
  const json session = whole_session(content);
  EXPECT_EQ(session.at("damage"), json::array());
  EXPECT_EQ(session.at("ticks"), kTicks + kSkip);
  EXPECT_EQ(frames(content, 0, kTicks).size(), kFirstBehind);
  EXPECT_EQ(frames(content, kFirstBehind + kSkip, kTicks).size(), kTicks - kFirstBehind);
}

TEST_F(DamagedLog, a_message_without_chunks_whose_channel_is_unknown_costs_its_tick_and_is_told) {
  write_without_chunks();
  for (const std::uint32_t tick : {0u, 701u, kTicks - 2u}) {
    const Bare message = bare("/command", tick);
    const std::string whole = test::contents(path());
    std::string bytes = whole;
    bytes.at(message.offset + mcap::kRecordHead + 1) = '\x7F';
    test::write_file(path(), bytes);
    expect_only_lost(tick, "some ticks of ");
    expect_only_lost(tick, "the channel of the message at byte " + std::to_string(message.offset) +
                               " is unknown");
    test::write_file(path(), whole);
  }
}

TEST_F(DamagedLog, a_message_without_chunks_that_is_too_short_costs_nothing_else) {
  write_without_chunks();
  for (const std::size_t size : {0u, 7u, 21u}) {
    const std::string whole = test::contents(path());
    std::string bytes = whole;
    bytes.insert(bare("/plan", 701).offset,
                 record_of(mcap::Opcode::message, std::string(size, '\x01')));
    test::write_file(path(), bytes);
    expect_only_lost(kNone, "1 piece of the log can't be read");
    test::write_file(path(), whole);
  }
}

}  // namespace
}  // namespace surefoot
