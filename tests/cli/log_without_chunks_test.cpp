#include "server/log_frames.hpp"
#include "surefoot/logging/log_reader.hpp"
#include "tests/cli/damaged_log.hpp"
#include "tests/support/messages.hpp"

namespace surefoot::cli {
namespace {

using nlohmann::json;
using test::holds;
using test::kTicks;

constexpr std::uint32_t kNone = UINT32_MAX;
constexpr std::uint64_t kTickTime = 2'500'000;  // [ns]

/// The same log as another writer may write it anew.
class LogWithoutChunks : public test::DamagedLog {
 protected:
  void SetUp() override {
    DamagedLog::SetUp();
    write_without_chunks();
  }

  /// A message outside of chunks.
  struct Bare {
    std::string topic;
    std::uint64_t time, offset;  ///< of its record
  };

  /// Writes the log anew without chunks.
  void write_without_chunks() {
    std::string bytes(logging::mcap::kMagic);
    std::map<std::uint16_t, std::string> topics;
    bare_.clear();
    const auto take = [&](logging::mcap::Opcode opcode, std::string_view content) {
      if (opcode == logging::mcap::Opcode::channel) {
        const logging::mcap::ChannelRecord channel = logging::mcap::channel_record(content);
        topics[channel.id] = channel.topic;
      }
      if (opcode == logging::mcap::Opcode::message) {
        const logging::mcap::MessageRecord message = logging::mcap::message_record(content);
        bare_.push_back({topics.at(message.channel), message.log_time, bytes.size()});
      }
      bytes += record_of(opcode, content);
    };
    logging::mcap::RecordWalk walk(path());
    while (walk.next() && walk.opcode() != logging::mcap::Opcode::data_end) {
      const std::string content = walk.content();
      if (walk.opcode() == logging::mcap::Opcode::message_index) continue;
      if (walk.opcode() != logging::mcap::Opcode::chunk) {
        take(walk.opcode(), content);
        continue;
      }
      const std::string records = logging::mcap::chunk_records(content);
      for (logging::mcap::Cursor cursor(records); !cursor.rest().empty();) {
        const auto [opcode, length] = logging::mcap::take_head(cursor);
        take(opcode, cursor.bytes(length));
      }
    }
    bytes += record_of(logging::mcap::Opcode::data_end, std::string(4, '\0'));
    bytes += record_of(logging::mcap::Opcode::footer, std::string(20, '\0'));
    test::write_file(path(), bytes + std::string(logging::mcap::kMagic));
  }

  static std::string number(std::uint64_t value) {
    std::string bytes;
    for (unsigned shift = 0; shift < 64; shift += 8)
      bytes += static_cast<char>((value >> shift) & 0xFF);
    return bytes;
  }

  static std::string record_of(logging::mcap::Opcode opcode, std::string_view content) {
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
    bytes.replace(message.offset + logging::mcap::kRecordHead + 6, 8, number(time));
    test::write_file(path(), bytes);
  }

  /// All ticks but one can be read, and the damage is told once.
  void expect_only_lost(std::uint32_t tick, const std::string& told) {
    server::LogContent content(path());
    const json session = whole_session(content);
    EXPECT_EQ(session.at("ticks"), kTicks);
    ASSERT_EQ(session.at("damage").size(), 1u) << session.at("damage");
    EXPECT_TRUE(holds(session.at("damage")[0].get<std::string>(), told)) << session.at("damage");
    std::uint32_t next = 0;
    for (const server::ViewFrame& frame : frames(content, 0, kTicks)) {
      if (next == tick) ++next;
      ASSERT_EQ(frame.tick, next++);
    }
    EXPECT_EQ(next + (next == tick ? 1 : 0), kTicks);
  }

  std::vector<Bare> bare_;
};

TEST_F(LogWithoutChunks, a_wrong_time_of_one_message_costs_its_tick_and_is_told) {
  for (const std::uint64_t time :
       {60'000'000'000ULL, ((1ULL << 32) + 100) * kTickTime, 1ULL << 63, ~0ULL}) {
    for (const std::uint32_t tick : {0u, 701u, kTicks - 2u}) {
      for (const std::string topic : {"/readings", "/command"}) {
        SCOPED_TRACE(topic + " of tick " + std::to_string(tick) + " at " + std::to_string(time));
        const Bare message = bare(topic, tick);
        write_time(message, time);
        expect_only_lost(tick, "1 piece of the log can't be read");
        server::LogFrames frames(path(), logging::LogReader(path()).header());
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

TEST_F(LogWithoutChunks, a_clock_that_skips_is_no_damage_here_either) {
  constexpr std::uint32_t kFirstBehind = 1000, kSkip = 24'000;
  std::string bytes = test::contents(path());
  for (const Bare& message : bare_) {
    if (message.time < kFirstBehind * kTickTime) continue;
    bytes.replace(message.offset + logging::mcap::kRecordHead + 6, 8,
                  number(message.time + kSkip * kTickTime));
  }
  test::write_file(path(), bytes);
  server::LogContent content(path());
  const json session = whole_session(content);
  EXPECT_EQ(session.at("damage"), json::array());
  EXPECT_EQ(session.at("ticks"), kTicks + kSkip);
  EXPECT_EQ(frames(content, 0, kTicks).size(), kFirstBehind);
  EXPECT_EQ(frames(content, kFirstBehind + kSkip, kTicks).size(), kTicks - kFirstBehind);
}

TEST_F(LogWithoutChunks, a_message_whose_channel_is_unknown_costs_its_tick_and_is_told) {
  for (const std::uint32_t tick : {0u, 701u, kTicks - 2u}) {
    const Bare message = bare("/command", tick);
    const std::string whole = test::contents(path());
    std::string bytes = whole;
    bytes.at(message.offset + logging::mcap::kRecordHead + 1) = '\x7F';
    test::write_file(path(), bytes);
    expect_only_lost(tick, "some ticks of ");
    expect_only_lost(tick, "the channel of the message at byte " + std::to_string(message.offset) +
                               " is unknown");
    test::write_file(path(), whole);
  }
}

TEST_F(LogWithoutChunks, a_message_that_is_too_short_costs_nothing_else) {
  for (const std::size_t size : {0u, 7u, 21u}) {
    const std::string whole = test::contents(path());
    std::string bytes = whole;
    bytes.insert(bare("/plan", 701).offset,
                 record_of(logging::mcap::Opcode::message, std::string(size, '\x01')));
    test::write_file(path(), bytes);
    expect_only_lost(kNone, "1 piece of the log can't be read");
    test::write_file(path(), whole);
  }
}

}  // namespace
}  // namespace surefoot::cli
