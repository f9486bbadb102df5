#include "surefoot/gaits/parts/leg_motion.hpp"
#include "tests/gaits/leg_bench.hpp"
#include "tests/support/random_motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace surefoot::gaits {
namespace {

using test::Bench;
using test::kDuration;
using test::kPeriod;
using test::kUp;
using test::Random;

/// Ticks on, and holds every plan against the one before.
struct RampWatch {
  explicit RampWatch(Bench& watched) : bench(watched), last(bench.leg.plan(bench.time)) {}

  void run(double duration) {
    const ForceOptions force;
    const double shortest = std::min(force.ramp_up, force.ramp_down);
    const double fastest = 1.5 * force.max * kPeriod / shortest + 1e-9;  // of the smoothstep
    for (const double end = bench.time + duration; bench.time < end - 0.5 * kPeriod;) {
      bench.time += kPeriod;
      const FootPlan now = bench.leg.plan(bench.time);
      ASSERT_LE(std::abs(now.force_max - last.force_max), fastest) << bench.time;
      ASSERT_LE(now.force_min, now.force_max);
      ASSERT_LE(now.force_min, force.min);
      ASSERT_GE(now.force_min, 0.0);
      ASSERT_LE(now.force_max, force.max);
      last = now;
    }
  }

  Bench& bench;
  FootPlan last;
};

TEST(LegMotion, ForceLimitsRiseFromZeroAtTouchdownAndFallToZeroAtLiftOff) {
  const ForceOptions force;
  Bench bench;
  bench.leg.plant(bench.time, bench.p);
  RampWatch watch(bench);
  EXPECT_EQ(watch.last.force_max, 0.0);
  watch.run(force.ramp_up);
  EXPECT_NEAR(watch.last.force_max, force.max, 1e-9);
  EXPECT_EQ(watch.last.force_min, force.min);
  watch.run(0.4);
  EXPECT_EQ(watch.last.force_max, force.max);
  bench.leg.unload(bench.time + force.ramp_down);
  EXPECT_EQ(bench.leg.phase(), LegPhase::unloading);
  watch.run(force.ramp_down);
  EXPECT_NEAR(watch.last.force_max, 0.0, 1e-9);
  EXPECT_NEAR(watch.last.force_min, 0.0, 1e-9);
  watch.run(0.3);
  EXPECT_EQ(watch.last.force_max, 0.0);
}

TEST(LegMotion, ForceLimitsAreContinuousWhereUnloadingFollowsATouchdownAtOnce) {
  Random random(1);
  for (int trial = 0; trial < 50; ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    Bench bench;
    bench.leg.plant(bench.time, bench.p);
    RampWatch watch(bench);
    watch.run(random.uniform(0.0, 0.1));
    bench.leg.unload(bench.time + ForceOptions{}.ramp_down);
    watch.run(0.3);
  }
}

TEST(LegMotion, ForceLimitsAreContinuousWhereAnUnloadingIsTakenBackAtAnyTime) {
  Random random(2);
  for (int trial = 0; trial < 50; ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    Bench bench;
    bench.leg.plant(bench.time, bench.p, true);
    RampWatch watch(bench);
    bench.leg.unload(bench.time + ForceOptions{}.ramp_down);
    watch.run(random.uniform(0.0, 0.4));
    bench.leg.reload(bench.time);
    EXPECT_EQ(bench.leg.phase(), LegPhase::stance);
    watch.run(0.3);
    EXPECT_EQ(watch.last.force_max, ForceOptions{}.max);
  }
}

TEST(LegMotion, AFootThatStoodFromLongBeforeHasNoRamp) {
  Bench bench;
  bench.leg.plant(bench.time, bench.p, true);
  EXPECT_EQ(bench.leg.plan(bench.time).force_max, ForceOptions{}.max);
}

TEST(LegMotion, WithoutRampsEveryFootThatIsDownMayCarryAll) {
  Bench bench(ForceOptions{.ramps = false});
  bench.leg.plant(bench.time, bench.p);
  EXPECT_EQ(bench.leg.plan(bench.time).force_max, ForceOptions{}.max);
  bench.leg.unload(bench.time + 0.1);
  EXPECT_EQ(bench.leg.plan(bench.time + 0.2).force_max, ForceOptions{}.max);
  bench.leg.lift(bench.time, {bench.p, bench.p, kUp, kDuration, 0.08});
  EXPECT_EQ(bench.leg.plan(bench.time + 0.1).force_max, 0.0);
}

TEST(LegMotion, RampsOfNoLengthAreSteps) {
  Bench bench(ForceOptions{.ramp_up = 0.0, .ramp_down = 0.0});
  bench.leg.plant(bench.time, bench.p);
  EXPECT_EQ(bench.leg.plan(bench.time).force_max, 0.0);
  EXPECT_EQ(bench.leg.plan(bench.time + kPeriod).force_max, ForceOptions{}.max);
  bench.leg.unload(bench.time + 0.1);
  EXPECT_EQ(bench.leg.plan(bench.time + 0.1 - kPeriod).force_max, ForceOptions{}.max);
  EXPECT_EQ(bench.leg.plan(bench.time + 0.1).force_max, 0.0);
}

}  // namespace
}  // namespace surefoot::gaits
