#pragma once

#include "surefoot/math/rotation.hpp"
#include "surefoot/signals/motion_plan.hpp"

namespace surefoot::gaits {

/// Reference of a COM that is not planned: it moves with the commanded velocity, turns with the
/// heading, and stays within `leash` of the estimated COM, so that it does not wind up. It sways
/// with the gait's cycle about this motion.
class DrivenCom {
 public:
  /// At rest, or in motion, at p with v in W.
  void start(const Vec2& p, const Vec2& v) { plan_ = {.p = p, .v = v, .zmp = p}; }

  /// One tick of `period` [s] toward a velocity in W [m/s] that turns with `yaw_rate` [rad/s].
  void update(const Vec2& velocity, double yaw_rate, double acceleration, double leash,
              const Vec2& p_WCom, double period) {
    const Vec2 turning = yaw_rate * Vec2(-plan_.v.y(), plan_.v.x());
    const Vec2 change = clip_norm<2>(velocity - plan_.v - period * turning, period * acceleration);
    plan_.a = turning + change / period;
    plan_.v += period * plan_.a;
    plan_.p = p_WCom + clip_norm<2>(plan_.p + period * plan_.v - p_WCom, leash);
    plan_.zmp = plan_.p;
  }

  [[nodiscard]] const ComPlan& plan() const { return plan_; }

 private:
  ComPlan plan_;
};

}  // namespace surefoot::gaits
