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
  EXPECT_LT(metrics.velocity_nees, 2.0);
  EXPECT_LT(metrics.tilt_nees, 4.0);
}

/// From gait to gait, on the way.
const std::vector<std::string> kChanges{
    kUncalibrated, "gaits=[stand, crawl, trot, flying_trot, pace]",
    "user=[{time: 0.5, walk: true, velocity: [0.3, 0.0]},"
    " {time: 3, walk: true, velocity: [0.3, 0.0], gait: pace},"
    " {time: 5, walk: true, velocity: [0.3, 0.0], gait: flying_trot},"
    " {time: 7, walk: true, velocity: [0.15, 0.0], gait: crawl},"
    " {time: 10, walk: true, velocity: [0.3, 0.0], gait: trot},"
    " {time: 12, walk: true, gait: stand}]"};

TEST(Trot, ChangesToOtherGaitsAndBackWithoutAFallOrAnAllocation) {
  Loop loop(scenario("trot", kChanges, 1));
  loop.tick();
  const std::size_t first = loop.allocations();
  loop.run_until(14.0);
  EXPECT_EQ(loop.allocations(), first) << "the last at " << loop.last_allocation() << " s";
  EXPECT_EQ(loop.count(PlanEvent::gait_changed), 5);
  EXPECT_EQ(loop.record().command.mode, CommandMode::optimal);
  EXPECT_EQ(loop.record().plan.num_contacts(), 4);
}

TEST(Trot, AndTheOtherGaitsOfFourLegsGoFromSensorsAlone) {
  for (const std::string gait : {"crawl", "flying_trot", "pace", "pronk", "bound"}) {
    const evaluation::Metrics metrics =
        closed_loop::run_closed_loop(
            scenario("trot",
                     {kUncalibrated, "duration=6", "gait=" + gait,
                      "user=[{time: 0.5, walk: true, velocity: [0.2, 0]}]"},
                     1),
            {})
            .metrics;
    EXPECT_FALSE(metrics.fell) << gait;
    EXPECT_EQ(metrics.fallback_ticks, 0) << gait;
    EXPECT_GT(metrics.speed_mps, 0.1) << gait;
  }
}

TEST(Trot, BeginsAndEndsGaitsThatFlyOnTheWay) {
  for (const std::string gait : {"pronk", "bound"}) {
    Loop loop(scenario("trot",
                       {kUncalibrated, "gaits=[stand, crawl, trot, pronk, bound]",
                        "user=[{time: 0.5, walk: true, velocity: [0.2, 0.0], gait: crawl},"
                        " {time: 3, walk: true, velocity: [0.2, 0.0], gait: " +
                            gait +
                            "},"
                            " {time: 6, walk: true, velocity: [0.2, 0.0], gait: crawl}]"},
                       1));
    loop.run_until(9.0);
    EXPECT_EQ(loop.count(PlanEvent::gait_changed), 3) << gait;
    EXPECT_EQ(loop.record().command.mode, CommandMode::optimal) << gait;
  }
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
