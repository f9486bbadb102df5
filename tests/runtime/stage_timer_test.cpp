#include "surefoot/runtime/stage_timer.hpp"

#include "tests/support/malloc_counter.hpp"

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>

namespace surefoot::runtime {
namespace {

using Clock = std::chrono::steady_clock;

/// Works for at least this long.
void spin(double microseconds) {
  const Clock::time_point begin = Clock::now();
  while (std::chrono::duration<double, std::micro>(Clock::now() - begin).count() < microseconds) {
  }
}

TEST(StageTimer, MeasuresEveryStageAndTheWholeTick) {
  StageTimer timer;
  const Clock::time_point begin = Clock::now();
  timer.tick_begins();
  spin(100.0);
  timer.stage_ends(control::Stage::estimate);
  spin(200.0);
  timer.stage_ends(control::Stage::model);
  spin(300.0);
  timer.stage_ends(control::Stage::plan);
  spin(400.0);
  timer.stage_ends(control::Stage::stack);
  spin(500.0);
  timer.stage_ends(control::Stage::solve);
  spin(600.0);
  timer.stage_ends(control::Stage::command);
  const std::chrono::duration<double, std::micro> all = Clock::now() - begin;
  const TickTiming& timing = timer.timing();
  EXPECT_GE(timing.estimate, 100.0);
  EXPECT_GE(timing.model, 200.0);
  EXPECT_GE(timing.plan, 300.0);
  EXPECT_GE(timing.stack, 400.0);
  EXPECT_GE(timing.solve, 500.0);
  const double stages = timing.estimate + timing.model + timing.plan + timing.stack + timing.solve;
  EXPECT_GE(timing.total, stages + 600.0);
  EXPECT_LE(timing.total, all.count());
}

TEST(StageTimer, AStageThatWasLeftOutTookNoTime) {
  StageTimer timer;
  timer.tick_begins();
  for (const control::Stage stage :
       {control::Stage::estimate, control::Stage::model, control::Stage::plan,
        control::Stage::stack, control::Stage::solve, control::Stage::command}) {
    spin(10.0);
    timer.stage_ends(stage);
  }
  timer.tick_begins();
  timer.stage_ends(control::Stage::estimate);
  timer.stage_ends(control::Stage::command);
  EXPECT_EQ(timer.timing().model, 0.0);
  EXPECT_EQ(timer.timing().plan, 0.0);
  EXPECT_EQ(timer.timing().stack, 0.0);
  EXPECT_EQ(timer.timing().solve, 0.0);
  EXPECT_GT(timer.timing().total, 0.0);
}

TEST(StageTimer, LevelsThatTookNoTimeAreNotKnown) {
  std::array<double, kMaxLevels> seconds{};
  seconds[3] = 1.2344e-6;
  const LevelTimes times = in_microseconds(seconds);
  for (std::size_t k = 0; k < kMaxLevels; ++k) EXPECT_EQ(std::isnan(times[k]), k != 3);
  EXPECT_EQ(times[3], 1.234F) << "to a nanosecond";
}

TEST(StageTimer, AllocatesNothing) {
  StageTimer timer;
  const test::MallocCounter counter;
  timer.tick_begins();
  timer.stage_ends(control::Stage::estimate);
  timer.stage_ends(control::Stage::command);
  EXPECT_EQ(counter.count(), 0u);
}

}  // namespace
}  // namespace surefoot::runtime
