#include "surefoot/logging/recorder.hpp"

#include "surefoot/logging/log_header_reader.hpp"
#include "surefoot/logging/log_reader.hpp"
#include "surefoot/logging/logged_timing.hpp"
#include "surefoot/logging/message_decoder.hpp"
#include "surefoot/signals/per_leg.hpp"
#include "tests/logging/recorded_run.hpp"
#include "tests/logging/synthetic_run.hpp"
#include "tests/logging/temporary_folder.hpp"
#include "tests/support/messages.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/resource.h>

#include <cmath>
#include <csignal>
#include <filesystem>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace surefoot::logging {
namespace {

using nlohmann::json;
using test::bits;
using test::contents;
using test::expect_same;
using test::holds;
using test::message_of;
using test::record;
using test::SyntheticRun;
using test::TemporaryFolder;
using test::ticks_in;

TEST(Recorder, WhatWasRecordedIsReadBackBitByBit) {
  const TemporaryFolder folder;
  const std::vector<TickRecord> recorded = record(folder / "run.mcap", 700);
  LogReader log(folder / "run.mcap");
  TickRecord tick;
  for (const TickRecord& expected : recorded) {
    ASSERT_TRUE(log.next(tick));
    expect_same(expected, tick);
    ASSERT_EQ(tick.state.q_WB.w(), expected.state.q_WB.w());  // independent of the encoder
    ASSERT_EQ(tick.plan.feet[2].phase, expected.plan.feet[2].phase);
    ASSERT_EQ(tick.command.torque, expected.command.torque);
  }
  EXPECT_FALSE(log.next(tick));
  EXPECT_TRUE(log.complete()) << log.problem();
  EXPECT_EQ(log.timings().size(), 700u);
  EXPECT_EQ(log.summary(), R"({"metrics":{}})");
}

TEST(Recorder, TheTimesOfLevelsAreReadBackAndThoseThatAreNotKnownStayUnknown) {
  const TemporaryFolder folder;
  record(folder / "run.mcap", 40);
  LogReader log(folder / "run.mcap");
  ASSERT_EQ(ticks_in(log), 40);
  SyntheticRun run(3, 0.5);
  for (const TickTiming& timing : log.timings()) {
    run.step();
    EXPECT_EQ(timing.solve, run.timing.solve);
    for (std::size_t k = 0; k < kMaxLevels; ++k) {
      if (std::isnan(run.timing.levels[k])) {
        EXPECT_TRUE(std::isnan(timing.levels[k])) << k;
      } else {
        EXPECT_EQ(timing.levels[k], run.timing.levels[k]) << k;
      }
    }
  }
}

TEST(Recorder, TheTimesOfLevelsStayWithTheirNamesWhereTheirOrderChanges) {
  const TemporaryFolder folder;
  LogHeader header = SyntheticRun::header();
  std::vector<std::string> names = header.level_names;
  std::swap(names[2], names[5]);
  Recorder recorder(folder / "run.mcap", header, {});
  SyntheticRun run(3, 0.5);
  for (const bool is_renamed : {false, true}) {
    if (is_renamed) recorder.rename({names, header.row_name});
    run.step();
    recorder.record(run.tick);
    run.timing.levels = kNoLevelTimes;
    run.timing.levels[2] = 1.5F;
    run.timing.levels[5] = 20.0F;
    recorder.record(run.timing);
  }
  recorder.close("{}");
  LogReader log(folder / "run.mcap");
  ASSERT_EQ(ticks_in(log), 2);
  EXPECT_EQ(log.timings()[0].levels[2], 1.5F);
  EXPECT_EQ(log.timings()[0].levels[5], 20.0F);
  EXPECT_EQ(log.timings()[1].levels[2], 20.0F);
  EXPECT_EQ(log.timings()[1].levels[5], 1.5F);
}

TEST(Recorder, ATimingOfAnOlderLogHasNoLevels) {
  logged::Timing timing;
  logged::Decoder::decode(
      R"({"time":1,"estimate":2,"plan":3,"model":4,"stack":5,"solve":6,"total":20})", timing);
  EXPECT_EQ(timing.stages.solve, 6.0);
  const TickTiming read = logged::timing_from(timing, SyntheticRun::header().level_names);
  EXPECT_EQ(read.total, 20.0);
  for (const float time : read.levels) EXPECT_TRUE(std::isnan(time));
}

TEST(Recorder, TheHeaderIsReadBack) {
  const TemporaryFolder folder;
  record(folder / "run.mcap", 1);
  const LogHeader expected = SyntheticRun::header();
  const LogHeader header = LogReader(folder / "run.mcap").header();
  EXPECT_EQ(header.version, expected.version);
  EXPECT_EQ(header.seed, expected.seed);
  EXPECT_EQ(header.level_names, expected.level_names);
  EXPECT_EQ(header.level_units, expected.level_units);
  EXPECT_EQ(header.visible(1), expected.level_visible[1]);
  EXPECT_EQ(header.robot.joint_names, expected.robot.joint_names);
  EXPECT_EQ(header.robot.torque_limit, expected.robot.torque_limit);
  EXPECT_EQ(header.limb.level, expected.limb.level);
  EXPECT_EQ(header.limb.max, expected.limb.max);
  EXPECT_EQ(header.commit, expected.commit);
  EXPECT_EQ(header.command, expected.command);
  EXPECT_EQ(header.description, expected.description);
  ASSERT_EQ(header.drawn.size(), 1u);
  EXPECT_EQ(header.drawn[0].path, expected.drawn[0].path);
  EXPECT_EQ(header.drawn[0].value, expected.drawn[0].value);
  ASSERT_EQ(header.terrain.size(), 2u);
  EXPECT_EQ(header.terrain[0].shape, "box");
  EXPECT_EQ(header.terrain[0].size, expected.terrain[0].size);
  EXPECT_EQ(header.terrain[1].position, expected.terrain[1].position);
  EXPECT_EQ(header.notes, expected.notes);
  EXPECT_EQ(json::parse(header.options), json::parse(expected.options));
  ASSERT_EQ(header.attachments.size(), 1u);
  EXPECT_EQ(header.attachments[0].data, expected.attachments[0].data);
}

/// The header and a tick of a robot with six legs.
std::pair<LogHeader, TickRecord> hexapod() {
  LogHeader header = SyntheticRun::header();
  header.robot.num_legs = kMaxLegs;
  header.robot.joint_names.resize(kMaxLegs * kJointsPerLeg, "joint");
  header.robot.torque_limit.setConstant(kMaxLegs * kJointsPerLeg, 40.0);
  SyntheticRun run;
  run.step();
  TickRecord tick = run.tick;
  size_joints(tick, kMaxLegs * kJointsPerLeg);
  tick.reading.foot_force = per_leg(90.0, kMaxLegs);
  tick.state.slips = per_leg(true, kMaxLegs);
  for (PerLeg<Vec3>* list : {&tick.state.foot_force, &tick.state.slip_velocity, &tick.model.p_WF,
                             &tick.model.p_WH, &tick.model.force})
    *list = per_leg(Vec3(1.0, 2.0, 3.0), kMaxLegs);
  tick.plan.feet.resize(kMaxLegs);
  tick.plan.feet[5].phase = LegPhase::swing;
  tick.plan.events = {};
  tick.plan.events.add({.kind = PlanEvent::lift_off, .leg = Leg{5}});
  return {header, tick};
}

TEST(Recorder, ALogOfSixLegsIsReadBack) {
  const TemporaryFolder folder;
  const auto [header, tick] = hexapod();
  Recorder recorder(folder / "run.mcap", header);
  recorder.record(tick);
  recorder.close("{}");
  LogReader log(folder / "run.mcap");
  EXPECT_EQ(log.header().robot.num_legs, kMaxLegs);
  TickRecord read;
  ASSERT_TRUE(log.next(read));
  EXPECT_EQ(bits(read.reading), bits(tick.reading));
  EXPECT_EQ(bits(read.state), bits(tick.state));
  EXPECT_EQ(bits(read.plan), bits(tick.plan));
  EXPECT_EQ(bits(read.model), bits(tick.model));
  EXPECT_EQ(read.plan.events.items[0].leg, Leg{5});
}

TEST(Recorder, TheHeaderNamesLegsOnlyOfARobotWithSix) {
  EXPECT_FALSE(json::parse(to_json(SyntheticRun::header())).at("robot").contains("legs"));
  json header = json::parse(to_json(hexapod().first));
  EXPECT_EQ(header.at("robot").at("legs"), json({"LF", "RF", "LM", "RM", "LH", "RH"}));
  header["robot"]["legs"] = {"LF", "RF", "LM", "RM", "LH"};
  EXPECT_THROW((void)read_log_header("run.mcap", header.dump()), FileError);
}

TEST(Recorder, RunsThatDifferInTheirTimingsAloneAreTheSameBytesUpToTheTimings) {
  const TemporaryFolder folder;
  record(folder / "a.mcap", 900, 0.0);
  record(folder / "b.mcap", 900, 123.0, {.queue_ticks = 1});
  const std::string a = contents(folder / "a.mcap"), b = contents(folder / "b.mcap");
  McapReader reader(folder / "a.mcap");
  McapMessage message;
  std::uint64_t timings_start = 0, ticks_start = 0;  // of the last chunk of each
  while (timings_start == 0 && reader.next(message)) {
    (message.channel->topic == "/timings" ? timings_start : ticks_start) = reader.chunk_offset();
  }
  ASSERT_LT(ticks_start, timings_start) << "the timings have chunks of their own";
  ASSERT_GT(timings_start, a.size() / 2);
  EXPECT_EQ(a.substr(0, timings_start), b.substr(0, timings_start));
  EXPECT_NE(a, b);
  do {
    ASSERT_EQ(message.channel->topic, "/timings") << "nothing else may follow";
  } while (reader.next(message));
}

TEST(Recorder, AFullQueueLosesNothing) {
  const TemporaryFolder folder;
  const std::vector<TickRecord> recorded =
      record(folder / "run.mcap", 300, 0.0, {.queue_ticks = 2});
  LogReader log(folder / "run.mcap");
  EXPECT_EQ(ticks_in(log), 300);
}

TEST(Recorder, LevelsSayHowTheyCameOutAndRowsTheirNamesAndByHowMuch) {
  const TemporaryFolder folder;
  record(folder / "run.mcap", 1000);
  McapReader reader(folder / "run.mcap");
  McapMessage message;
  std::set<std::string> active;
  bool has_missed = false;
  while (reader.next(message)) {
    if (message.channel->topic != "/hierarchy") continue;
    const json hierarchy = json::parse(message.data);
    ASSERT_EQ(hierarchy.at("levels").at(6).at("name"), "limb limits");
    for (const json& level : hierarchy.at("levels"))
      ASSERT_EQ(level.at("status"), level.at("residual") > 1e-6 ? "missed" : "met");
    for (const json& row : hierarchy.at("active")) {
      active.insert(row.at("level").get<std::string>() + ": " + row.at("row").get<std::string>());
      ASSERT_TRUE(row.at("by").is_number());
    }
    for (const json& row : hierarchy.at("missed")) {
      has_missed = true;
      ASSERT_EQ(row.at("level"), row.at("id") == 2 ? "roll and pitch" : "height");
      ASSERT_EQ(row.at("row"), row.at("id") == 2 ? "LH slip forward" : "LF slip forward");
      ASSERT_EQ(row.at("by") < 0.0, row.at("id") == 2);
    }
  }
  EXPECT_EQ(active, (std::set<std::string>{"friction: RF slip forward", "limb limits: LH extension",
                                           "limb limits: RF extension"}));
  EXPECT_TRUE(has_missed);
}

TEST(Recorder, AnotherChannelsMessagesStandInTheOrderTheyCame) {
  const TemporaryFolder folder;
  {
    Recorder recorder(folder / "run.mcap", SyntheticRun::header());
    const Recorder::Channel channel =
        recorder.add_channel("/other", "test.Other", R"({"type":"object"})");
    SyntheticRun run;
    for (int i = 0; i < 50; ++i) {
      run.step();
      recorder.record(channel, run.tick.reading.time,
                      [i](std::string& out) { out += std::to_string(i); });
      recorder.record(run.tick);
    }
    recorder.close();
  }
  int others = 0, ticks = 0;
  LogReader log(folder / "run.mcap", [&](const McapMessage& message) {
    EXPECT_EQ(message.data, std::to_string(others));
    EXPECT_EQ(others++, ticks);
  });
  TickRecord tick;
  while (log.next(tick)) ++ticks;
  EXPECT_EQ(others, 50);
  EXPECT_EQ(ticks, 50);
}

TEST(Recorder, OnlyAClosedLogHasItsName) {
  const TemporaryFolder folder;
  const std::string path = folder / "run.mcap";
  Recorder recorder(path, SyntheticRun::header());
  SyntheticRun run;
  run.step();
  recorder.record(run.tick);
  EXPECT_FALSE(std::filesystem::exists(path));
  EXPECT_TRUE(std::filesystem::exists(path + ".partial"));
  recorder.close();
  EXPECT_TRUE(std::filesystem::exists(path));
  EXPECT_FALSE(std::filesystem::exists(path + ".partial"));
}

TEST(Recorder, ALogThatIsBeingRecordedIsNotRecordedByAnother) {
  const TemporaryFolder folder;
  const std::string path = folder / "run.mcap";
  Recorder recorder(path, SyntheticRun::header());
  SyntheticRun run;
  run.step();
  recorder.record(run.tick);
  const std::string message = message_of([&] { Recorder(path, SyntheticRun::header()); });
  EXPECT_EQ(message.find(path + ": is being written by another run"), 0u) << message;
  recorder.close();
  LogReader log(path);
  EXPECT_EQ(ticks_in(log), 1);
  EXPECT_NO_THROW(Recorder(path, SyntheticRun::header()));
}

TEST(Recorder, AMissingFolderAFolderInPlaceOfAFileAndAnotherKindOfFileAreNamed) {
  const TemporaryFolder folder;
  const auto told = [](const std::string& path) {
    return message_of([&] { Recorder recorder(path, SyntheticRun::header()); });
  };
  EXPECT_TRUE(holds(told(folder / "none/run.mcap"), folder / "none"));
  EXPECT_EQ(told(folder.path()).find(folder.path() + " is a folder"), 0u);
  EXPECT_TRUE(holds(told(folder / "run.py"), "a name that ends with .mcap would be valid"));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

// While it lives no file may grow beyond some bytes: as if the disk were full.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) : signal_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    rlimit limit = before_;
    limit.rlim_cur = bytes;
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, signal_);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  rlimit before_{};
  void (*signal_)(int);
};

TEST(Recorder, AFullDiskIsReportedAndLeavesNothingThatLooksWhole) {
  const TemporaryFolder folder;
  const std::string path = folder / "run.mcap";
  std::string message;
  {
    const FullDisk full(1 << 20);
    message = message_of([&] { record(path, 4000); });
  }
  EXPECT_EQ(message.find(path), 0u) << message;
  EXPECT_FALSE(std::filesystem::exists(path));
  LogReader log(path + ".partial");
  EXPECT_GT(ticks_in(log), 100) << "what stood on the disk is readable";
}

TEST(Recorder, ALogWithAHoleIsNeverClosedAsWhole) {
  const TemporaryFolder folder;
  const std::string path = folder / "run.mcap";
  Recorder recorder(path, SyntheticRun::header());
  SyntheticRun run;
  {
    const FullDisk full(1 << 18);
    const std::string message = message_of([&] {
      for (int i = 0; i < 4000; ++i) {
        run.step();
        recorder.record(run.tick);
      }
    });
    ASSERT_EQ(message.find(path), 0u) << message;
  }
  // There is room again, but ticks are lost.
  EXPECT_EQ(message_of([&] { recorder.close(); }).find(path), 0u);
  EXPECT_FALSE(std::filesystem::exists(path));
}

}  // namespace
}  // namespace surefoot::logging
