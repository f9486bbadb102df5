#include "surefoot/closed_loop/closed_loop.hpp"
#include "tests/scenarios/loop.hpp"

#include <gtest/gtest.h>

namespace surefoot {
namespace {

using test::Loop;
using test::scenario;

constexpr const char* kUncalibrated = "planner.calibration.duration=0";

TEST(Trot, KeepsAMetreASecondThroughTheDrivesFromSensorsAlone) {
  const evaluation::Metrics metrics =
      closed_loop::run_closed_loop(scenario("trot", {kUncalibrated, "duration=12"}, 1), {}).metrics;
  EXPECT_FALSE(metrics.fell);
  EXPECT_EQ(metrics.fallback_ticks, 0);
  EXPECT_LT(metrics.command_error_rms_mps, 0.1);
  EXPECT_LT(metrics.velocity_error_rms_mps, 0.01);
}

TEST(Trot, AllocatesNothingAfterTheFirstTick) {
  Loop loop(scenario("trot", {kUncalibrated}));
  loop.tick();
  const std::size_t first = loop.allocations();
  loop.run_until(4.0);
  EXPECT_EQ(loop.allocations(), first) << "the last at " << loop.last_allocation() << " s";
  EXPECT_GE(loop.count(PlanEvent::touchdown), 20);
}

}  // namespace
}  // namespace surefoot
