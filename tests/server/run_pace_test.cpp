#include "server/run_pace.hpp"

#include <gtest/gtest.h>

namespace surefoot::server {
namespace {

using Clock = RunPace::Clock;
using std::chrono::milliseconds;

const Clock::time_point kStart{std::chrono::seconds(10)};

TEST(RunPace, a_tick_is_due_when_its_time_has_passed_at_the_speed) {
  RunPace pace;
  for (const double speed : {0.03125, 0.5, 1.0, 8.0}) {
    pace.begin(2.0, speed, kStart);
    const std::chrono::duration<double> wait = pace.due(2.5, kStart) - kStart;
    EXPECT_NEAR(wait.count(), 0.5 / speed, 1e-6) << speed;
  }
}

TEST(RunPace, a_short_delay_is_made_up_for_and_a_long_one_is_not) {
  RunPace pace;
  pace.begin(0.0, 1.0, kStart);
  EXPECT_EQ(pace.due(0.01, kStart + milliseconds(60)), kStart + milliseconds(10));
  (void)pace.due(0.02, kStart + milliseconds(500));
  const std::chrono::duration<double> wait =
      pace.due(0.03, kStart + milliseconds(500)) - (kStart + milliseconds(500));
  EXPECT_NEAR(wait.count(), 0.01, 1e-6);
}

}  // namespace
}  // namespace surefoot::server
