#include "surefoot/explain/tick_explanation.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/evaluation/criteria.hpp"
#include "surefoot/logging/recorder.hpp"
#include "tests/logging/synthetic_run.hpp"
#include "tests/logging/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

namespace surefoot::explain {
namespace {

constexpr double kPeriod = test::SyntheticRun::kPeriod;

/// Of ticks that `change` makes other, by their number.
void record(const std::string& path, int ticks, const std::string& summary,
            const std::function<void(int, TickRecord&)>& change) {
  logging::Recorder recorder(path, test::SyntheticRun::header());
  test::SyntheticRun run;
  for (int i = 0; i < ticks; ++i) {
    run.step();
    run.tick.hierarchy.transition_share = 1.0;
    change(i, run.tick);
    recorder.record(run.tick);
  }
  recorder.close(summary);
}

std::string summary(const std::string& reason) {
  evaluation::Metrics metrics;
  metrics.reason = reason;
  return evaluation::summary_json(metrics, {});
}

/// "0.2500 s controller: …" of what the planner did not do.
std::vector<std::string> told(const TickExplanation& explanation) {
  std::vector<std::string> list;
  for (const NearbyEvent& event : explanation.events) {
    if (event.by != "planner")
      list.push_back(std::to_string(std::lround(1e4 * event.time)) + " " + event.by + ": " +
                     event.text);
  }
  return list;
}

TEST(TickExplanation, AStopAndTheEndOfTheRunAreAmongTheEventsAround) {
  const test::TemporaryFolder folder;
  const std::string path = folder / "run.mcap";
  record(path, 800, summary("the robot fell"), [](int tick, TickRecord& record) {
    if (tick < 700) return;
    record.command.mode = CommandMode::damping;
    record.command.cause = StopCause::tilt;
  });
  const std::string stop = "17500 controller: command mode: damping, as the torso tilted too far";
  const std::string end = "19975 run: the run ended: the robot fell";
  EXPECT_EQ(told(read_tick(path, 1.75)), (std::vector{stop, end}));
  EXPECT_EQ(told(read_tick(path, 1.9975)), (std::vector{stop, end}));
  EXPECT_EQ(told(read_tick(path, 0.8)), (std::vector{stop}));
  EXPECT_TRUE(told(read_tick(path, 0.7)).empty());
}

TEST(TickExplanation, OfALogThatDoesNotSayHowItsRunEndedNoEndIsTold) {
  const test::TemporaryFolder folder;
  record(folder / "run.mcap", 20, "{}", [](int, TickRecord&) {});
  EXPECT_TRUE(told(read_tick(folder / "run.mcap", 0.0)).empty());
}

TEST(TickExplanation, TheTickBeforeALongBlendIsFoundHoweverFarBackItBegan) {
  const test::TemporaryFolder folder;
  const std::string path = folder / "run.mcap";
  record(path, 2800, "{}", [](int tick, TickRecord& record) {
    if (tick >= 400 && tick < 2600) record.hierarchy.transition_share = (tick - 400.0) / 2200.0;
  });
  for (const double time : {1.5, 6.4}) {
    const TickExplanation found = read_tick(path, time);
    ASSERT_TRUE(found.blend && found.blend->before) << time;
    EXPECT_EQ(found.blend->before->tick.reading.time, 399 * kPeriod);
    EXPECT_NEAR(found.blend->until, 2600 * kPeriod, 1e-9);
    for (const NearbyEvent& event : found.events)
      EXPECT_LE(std::abs(event.time - time), kEventWindow);
  }
}

TEST(TickExplanation, ABlendThatTheLogBeginsWithHasNoTickBefore) {
  const test::TemporaryFolder folder;
  record(folder / "run.mcap", 900, "{}", [](int tick, TickRecord& record) {
    record.hierarchy.transition_share = (tick + 400.0) / 2200.0;
  });
  const TickExplanation found = read_tick(folder / "run.mcap", 2.0);
  ASSERT_TRUE(found.blend);
  EXPECT_FALSE(found.blend->before);
}

TEST(TickExplanation, BehindTheEndOfTheDurationThereIsNoTick) {
  const test::TemporaryFolder folder;
  const std::string path = folder / "run.mcap";
  record(path, 141, "{}", [](int, TickRecord&) {});  // to 0.35 s
  for (const double time : {0.3519, 0.3525}) EXPECT_EQ(read_tick(path, time).asked, time);
  EXPECT_TRUE(read_tick(path, 0.3525).is_behind_end);
  for (const double time : {0.3535, 0.356, 0.36}) {
    EXPECT_THROW((void)read_tick(path, time), Error) << time;
  }
}

TEST(TickExplanation, TheDurationAsItIsToldIsItsEnd) {
  const test::TemporaryFolder folder;
  const std::string path = folder / "run.mcap";
  record(path, 139, "{}", [](int, TickRecord&) {});  // 0.3475 s, told as 0.35 s
  EXPECT_TRUE(read_tick(path, 0.35).is_behind_end);
  EXPECT_THROW((void)read_tick(path, 0.349), Error);
}

}  // namespace
}  // namespace surefoot::explain
