#pragma once

#include "surefoot/gaits/planner.hpp"
#include "surefoot/math/rotation.hpp"
#include "tests/gaits/puppet.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace surefoot::test {

inline constexpr double kPeriod = Puppet::kPeriod;

inline UserCommand walking(double forward = 0.06, double lateral = 0.0, double yaw_rate = 0.0) {
  return {.walk = true, .velocity = {forward, lateral}, .yaw_rate = yaw_rate};
}

inline gaits::PlannerOptions probing() {
  gaits::PlannerOptions options;
  options.probe.enabled = true;
  return options;
}

inline Puppet walker(const gaits::PlannerOptions& options = {}, Ground ground = level_ground()) {
  Puppet puppet(options, std::move(ground));
  puppet.user = walking();
  return puppet;
}

inline bool all_finite(const MotionPlan& plan) {
  bool finite = plan.com.p.allFinite() && plan.com.v.allFinite() && plan.com.a.allFinite() &&
                plan.torso.q_WB.coeffs().allFinite() && plan.torso.w_WB.allFinite() &&
                std::isfinite(plan.torso.height) && std::isfinite(plan.com_zmp_slack);
  for (const FootPlan& foot : plan.feet) {
    finite = finite && foot.p_WF.allFinite() && foot.v_WF.allFinite() && foot.a_WF.allFinite() &&
             std::isfinite(foot.force_min) && std::isfinite(foot.force_max);
  }
  return finite;
}

/// Holds a plan against the one of the tick before: what must hold whatever the ground is like.
class Watch {
 public:
  /// The steepest of a smoothstep, 3/2 of its mean, in a tick.
  static constexpr double kForceStep =
      1.51 * gaits::ForceOptions{}.max * kPeriod /
      std::min(gaits::ForceOptions{}.ramp_up, gaits::ForceOptions{}.ramp_down);

  explicit Watch(const Puppet& puppet) : puppet_(puppet), before_(puppet.plan()) {}

  void operator()() {
    const MotionPlan& now = puppet_.plan();
    ASSERT_TRUE(all_finite(now)) << puppet_.time();
    ASSERT_GE(now.num_contacts(), 3) << puppet_.time();
    ASSERT_LT((now.com.p - before_.com.p).norm(), 0.5 * kPeriod) << puppet_.time();
    ASSERT_LT((now.com.v - before_.com.v).norm(), 3.0 * kPeriod) << puppet_.time();
    ASSERT_LT((now.com.a - before_.com.a).norm(), 0.15) << puppet_.time();
    ASSERT_LT(box_minus(now.torso.q_WB, before_.torso.q_WB).norm(), 2.0 * kPeriod);
    for (std::size_t k = 0; k < kNumLegs; ++k) {
      const FootPlan &foot = now.feet[k], &last = before_.feet[k];
      ASSERT_LT((foot.p_WF - last.p_WF).norm(), 8e-3) << k << " at " << puppet_.time();
      ASSERT_LT(std::abs(foot.force_max - last.force_max), kForceStep)
          << k << " at " << puppet_.time();
      ASSERT_LE(foot.force_min, foot.force_max);
      ASSERT_EQ(in_contact(foot.phase) ? 0.0 : foot.force_max, 0.0);
    }
    before_ = now;
  }

 private:
  const Puppet& puppet_;
  MotionPlan before_;
};

/// Walks on under a watch.
inline void run_watched(Puppet& puppet, double duration) {
  Watch watch(puppet);
  const double end = puppet.time() + duration;
  while (puppet.time() < end && !testing::Test::HasFatalFailure()) {
    puppet.tick();
    watch();
  }
}

inline void stop(Puppet& puppet) {
  puppet.user.walk = false;
  run_watched(puppet, 4.0);
}

}  // namespace surefoot::test
