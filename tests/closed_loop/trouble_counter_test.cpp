#include "surefoot/closed_loop/trouble_counter.hpp"

#include <gtest/gtest.h>

namespace surefoot::closed_loop {
namespace {

TickRecord tick(SampleFault imu = SampleFault::none, CommandMode mode = CommandMode::optimal) {
  TickRecord record;
  record.health.imu = {.fault = imu, .age = 0.005};
  record.command.mode = mode;
  return record;
}

TEST(TroubleCounter, TellsHowOftenASensorWasMarkedAndWhenFirst) {
  TroubleCounter troubles;
  troubles.add(1.0, tick());
  for (const double time : {2.0, 2.1, 4.0}) troubles.add(time, tick(SampleFault::silent));
  troubles.add(5.0, tick());
  troubles.add(6.0, tick(SampleFault::silent));
  troubles.add(6.1, tick(SampleFault::jump));
  ASSERT_EQ(troubles.counts().size(), 2U);
  EXPECT_EQ(troubles.counts()[0].what, "IMU stopped");
  EXPECT_EQ(troubles.counts()[0].count, 2);
  EXPECT_EQ(troubles.counts()[0].first, 2.0);
  EXPECT_EQ(troubles.counts()[1].what, "IMU changed too fast");
  EXPECT_EQ(troubles.counts()[1].count, 1);
}

TEST(TroubleCounter, TellsOfTheModesThatEndAWalkOnceEach) {
  TroubleCounter troubles;
  for (const CommandMode mode : {CommandMode::hold, CommandMode::optimal, CommandMode::degraded,
                                 CommandMode::sit, CommandMode::sit, CommandMode::damping}) {
    troubles.add(static_cast<double>(mode), tick(SampleFault::none, mode));
  }
  ASSERT_EQ(troubles.counts().size(), 2U);
  EXPECT_EQ(troubles.counts()[0].what, "command mode: sit");
  EXPECT_EQ(troubles.counts()[0].count, 1);
  EXPECT_EQ(troubles.counts()[1].what, "command mode: damping");
}

TEST(TroubleCounter, ASensorThatNeverGaveAGoodSampleIsNone) {
  TroubleCounter troubles;
  TickRecord record = tick(SampleFault::silent);
  record.health.imu.age = kNaN;
  troubles.add(0.0, record);
  EXPECT_TRUE(troubles.counts().empty());
}

}  // namespace
}  // namespace surefoot::closed_loop
