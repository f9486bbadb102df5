#include "surefoot/logging/log_reader.hpp"

#include "surefoot/logging/mcap_chunks.hpp"
#include "surefoot/logging/mcap_writer.hpp"
#include "tests/logging/recorded_run.hpp"
#include "tests/logging/synthetic_run.hpp"
#include "tests/logging/temporary_folder.hpp"
#include "tests/support/messages.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

namespace surefoot::logging {
namespace {

using test::contents;
using test::expect_same;
using test::holds;
using test::message_of;
using test::record;
using test::SyntheticRun;
using test::TemporaryFolder;
using test::ticks_in;
using test::write_file;

/// Reads the only tick of a log whose hierarchy of 11 levels ended in `failed_level`; its header
/// has a level more.
HierarchyReport read_cut_off(std::int32_t failed_level) {
  const TemporaryFolder folder;
  LogHeader header = SyntheticRun::header();
  header.level_names.emplace_back("posture");
  header.level_units.emplace_back("");
  {
    Recorder recorder(folder / "run.mcap", header);
    SyntheticRun run;
    run.step();
    run.tick.hierarchy.status = 1;
    run.tick.hierarchy.failed_level = failed_level;
    recorder.record(run.tick);
    recorder.close("{}");
  }
  LogReader log(folder / "run.mcap");
  TickRecord tick;
  EXPECT_TRUE(log.next(tick));
  return tick.hierarchy;
}

TEST(LogReader, OnlyLevelsThatWereSolvedHaveAResidual) {
  const HierarchyReport cut_off = read_cut_off(4), all = read_cut_off(11);
  EXPECT_EQ(cut_off.failed_level, 4);
  EXPECT_GE(all.failed_level, 12) << "a level of the header: none is the one that it ended in";
  for (std::size_t k = 0; k < 11; ++k) {
    EXPECT_EQ(std::isnan(cut_off.levels[k].residual), k >= 4) << k;
    EXPECT_FALSE(std::isnan(all.levels[k].residual)) << k;
  }
}

TEST(LogReader, ALogThatWasNotClosedIsReadableUnderItsPartialName) {
  const TemporaryFolder folder;
  const std::string path = folder / "run.mcap";
  {
    Recorder recorder(path, SyntheticRun::header());
    SyntheticRun run;
    for (int i = 0; i < 40; ++i) {
      run.step();
      recorder.record(run.tick);
    }
  }
  EXPECT_FALSE(std::filesystem::exists(path));
  LogReader log(path + ".partial");
  EXPECT_EQ(ticks_in(log), 40);
}

TEST(LogReader, ALogCutOffInTheMiddleGivesTheTicksOfItsWholeChunks) {
  const TemporaryFolder folder;
  record(folder / "run.mcap", 1200);
  const std::string whole = contents(folder / "run.mcap");
  int before = -1;
  std::set<int> counts;
  for (std::size_t tenth = 2; tenth <= 10; ++tenth) {
    write_file(folder / "cut.mcap", whole.substr(0, whole.size() * tenth / 10));
    LogReader log(folder / "cut.mcap");
    const int ticks = ticks_in(log);
    EXPECT_GE(ticks, before);
    before = ticks;
    counts.insert(ticks);
  }
  EXPECT_EQ(before, 1200);
  EXPECT_GT(counts.size(), 3u);
}

TEST(LogReader, OfADamagedLogAllTicksAreReadThatStandWholeInOtherChunks) {
  const TemporaryFolder folder;
  const std::vector<TickRecord> recorded = record(folder / "run.mcap", 1200);
  const std::string whole = contents(folder / "run.mcap");
  const auto chunks = McapChunks(folder / "run.mcap").chunks();
  ASSERT_GT(chunks.size(), 5u);
  for (const McapChunk& chunk : chunks) {
    std::string bytes = whole;
    bytes.at(chunk.offset + chunk.size / 2) ^= '\x40';
    write_file(folder / "damaged.mcap", bytes);
    LogReader log(folder / "damaged.mcap");
    TickRecord tick;
    std::size_t ticks = 0, gaps = 0, place = 0;
    for (; log.next(tick); ++ticks) {
      while (place < recorded.size() && recorded[place].reading.time < tick.reading.time) ++place;
      ASSERT_LT(place, recorded.size());
      expect_same(recorded[place], tick);
      gaps += log.follows() ? 0 : 1;
    }
    const bool has_ticks = &chunk < &chunks.back() && log.timings().size() == recorded.size();
    EXPECT_EQ(ticks < recorded.size(), has_ticks);
    EXPECT_EQ(gaps + (log.may_go_on() ? 1 : 0), has_ticks ? 1u : 0u);
    EXPECT_FALSE(log.complete());
    EXPECT_EQ(log.summary(), R"({"metrics":{}})");
  }
}

/// A run whose controller was first called late, and once not at all.
void record_with_skips(const std::string& path) {
  Recorder recorder(path, SyntheticRun::header());
  SyntheticRun run(3);
  for (int i = 0; i < 1500; ++i) {
    run.step();
    if (i < 200 || i == 700) continue;
    recorder.record(run.tick);
    recorder.record(run.timing);
  }
  recorder.close();
}

TEST(LogReader, NothingIsLostWhereTheClockOfAWholeLogSkips) {
  const TemporaryFolder folder;
  record_with_skips(folder / "run.mcap");
  LogReader log(folder / "run.mcap");
  TickRecord tick;
  int ticks = 0;
  for (; log.next(tick); ++ticks) ASSERT_TRUE(log.follows()) << tick.reading.time;
  EXPECT_EQ(ticks, 1299);
  EXPECT_FALSE(log.may_go_on());
  EXPECT_NEAR(log.clock_skips().begin, 0.5, 1e-9);
  EXPECT_EQ(log.clock_skips().count, 1u);
  EXPECT_NEAR(log.clock_skips().from, 699 * SyntheticRun::kPeriod, 1e-9);
  EXPECT_NEAR(log.clock_skips().to, 701 * SyntheticRun::kPeriod, 1e-9);
}

TEST(LogReader, WhatIsLostIsToldFromAClockThatSkips) {
  const TemporaryFolder folder;
  record_with_skips(folder / "run.mcap");
  const auto chunks = McapChunks(folder / "run.mcap").chunks();
  const auto holds_the_skip = [](const McapChunk& chunk) {
    return chunk.first_time < 1'750'000'000 && chunk.last_time > 1'750'000'000;
  };
  const auto lost = std::ranges::find_if_not(chunks.begin() + 1, chunks.end(), holds_the_skip);
  std::string bytes = contents(folder / "run.mcap");
  bytes.at(lost->offset + lost->size / 2) ^= '\x40';
  write_file(folder / "run.mcap", bytes);
  LogReader log(folder / "run.mcap");
  TickRecord tick;
  int gaps = 0;
  while (log.next(tick)) gaps += log.follows() ? 0 : 1;
  EXPECT_EQ(gaps, 1);
  EXPECT_EQ(log.clock_skips().count, 1u);
}

/// Changes a byte of an attachment, counted from where its record begins.
void damage_attachment(const std::string& path, const std::string& name, std::size_t byte) {
  constexpr std::size_t kBeforeName = 29;  // the record's head, dates, length of the name [bytes]
  std::string bytes = contents(path);
  bytes.at(bytes.find(name) - kBeforeName + byte) ^= '\x40';
  write_file(path, bytes);
}

TEST(LogReader, AnAttachmentThatIsLostHidesNoTicksOfAClockThatBeginsLate) {
  const TemporaryFolder folder;
  for (const std::size_t byte : {8u, 60u}) {  // in its head, and in what has a checksum
    record_with_skips(folder / "run.mcap");
    damage_attachment(folder / "run.mcap", "model.xml", byte);
    LogReader log(folder / "run.mcap");
    TickRecord tick;
    int ticks = 0;
    for (; log.next(tick); ++ticks) ASSERT_TRUE(log.follows()) << tick.reading.time;
    EXPECT_EQ(ticks, 1299);
    EXPECT_FALSE(log.complete());
    EXPECT_NEAR(log.clock_skips().begin, 0.5, 1e-9);
  }
}

TEST(LogReader, AnAttachmentThatIsLostIsNoEndOfARunWithoutTimings) {
  const TemporaryFolder folder;
  {
    Recorder recorder(folder / "run.mcap", SyntheticRun::header());
    SyntheticRun run(3);
    for (int i = 0; i < 100; ++i) {
      run.step();
      recorder.record(run.tick);
    }
    recorder.close();
  }
  damage_attachment(folder / "run.mcap", "model.xml", 60);
  LogReader log(folder / "run.mcap");
  EXPECT_EQ(ticks_in(log), 100);
  EXPECT_FALSE(log.complete());
  EXPECT_FALSE(log.may_go_on());
}

/// What is said of a log with this header.
void read_log_with(const std::string& header) {
  const TemporaryFolder folder;
  McapWriter writer(folder / "run.mcap");
  writer.attach("header.json", "application/json", header);
  writer.close();
  const LogReader log(folder / "run.mcap");
}

std::string refusal_of(const std::string& header) {
  return message_of([&] { read_log_with(header); });
}

TEST(LogReader, ADamagedHeaderIsToldInWordsWithWhatCanStillBeDone) {
  const std::string whole = to_json(SyntheticRun::header());
  EXPECT_NO_THROW(read_log_with(whole));
  const std::string cut = refusal_of(whole.substr(0, 300));
  EXPECT_TRUE(holds(cut,
                    "run.mcap: its header.json, which says what run it is, is damaged at its byte "
                    "301 of 300; the messages in it can be read by other readers"));
  for (const std::string name : {"seed", "joint_names", "level_names", "limb"}) {
    std::string other = whole;
    const std::size_t place = other.find("\"" + name + "\"");
    ASSERT_NE(place, std::string::npos);
    other[place + 1] = '#';
    const std::string told = refusal_of(other);
    EXPECT_TRUE(holds(told, "lacks " + name + ", or has something else"));
    EXPECT_FALSE(holds(told, "exception"));
  }
}

TEST(LogReader, AHeaderThatIsDeeperThanAStackIsRefused) {
  const std::string whole = to_json(SyntheticRun::header());
  const std::string options = "\"options\":";
  std::string deep = whole.substr(0, whole.find(options) + options.size());
  deep += std::string(300000, '[') + std::string(300000, ']') + "}";
  const std::string told = refusal_of(deep);
  EXPECT_TRUE(holds(told, "lacks an end of its brackets"));
}

TEST(LogReader, AnMcapFileOfSomebodyElseIsRefused) {
  const TemporaryFolder folder;
  {
    McapWriter writer(folder / "other.mcap");
    writer.close();
  }
  const std::string message = message_of([&] { LogReader log(folder / "other.mcap"); });
  EXPECT_TRUE(holds(message, "does not begin with a header of surefoot"));
}

TEST(LogReader, AnotherVersionIsRefusedWithBothNumbers) {
  const std::string message = refusal_of(R"({"log_version":"4.0"})");
  EXPECT_TRUE(holds(message, "log version 4.0; this program reads 2.x and 3.x"));
}

}  // namespace
}  // namespace surefoot::logging
