#pragma once

#include "surefoot/math/quintic.hpp"
#include "surefoot/math/types.hpp"
#include "surefoot/signals/motion_plan.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::gaits {

/// Takes the jump out of the references of COM and height where a gait follows another: the
/// difference of both fades, slowly enough for gentle accelerations.
class ReferenceBlend {
 public:
  /// With COM and torso of the old gait's last plan, and the first plan of the new one. Takes at
  /// least `shortest` [s].
  void begin(double time, const ComPlan& com, const TorsoPlan& torso, const MotionPlan& next,
             double shortest) {
    const auto whole = [](const ComPlan& c, const TorsoPlan& t) {
      return Motion<Vec3>{{c.p.x(), c.p.y(), t.height},
                          {c.v.x(), c.v.y(), t.height_rate},
                          {c.a.x(), c.a.y(), t.height_acceleration}};
    };
    const Motion<Vec3> from = whole(com, torso), to = whole(next.com, next.torso);
    left_ = {from.p - to.p, from.v - to.v, from.a - to.a};
    begin_ = time;
    duration_ = std::max({shortest, std::sqrt(kOfPosition * left_.p.norm() / kAcceleration),
                          kOfVelocity * left_.v.norm() / kAcceleration});
  }
  void apply(double time, MotionPlan& plan) const {
    const double t = time - begin_;
    if (t >= duration_) return;
    const Motion<Vec3> left =
        hermite<Vec3>(left_, {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()}, t, duration_);
    plan.com.p += left.p.head<2>();
    plan.com.v += left.v.head<2>();
    plan.com.a += left.a.head<2>();
    plan.torso.height += left.p.z();
    plan.torso.height_rate += left.v.z();
    plan.torso.height_acceleration += left.a.z();
  }

 private:
  static constexpr double kAcceleration = 1.0;  // about the largest [m/s²]
  // Largest acceleration of a fade from p or v alone: 5.8 p/T², 4 v/T.
  static constexpr double kOfPosition = 5.8, kOfVelocity = 4.0;

  Motion<Vec3> left_{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  double begin_ = -1e9, duration_ = 0.0;  // [s]
};

}  // namespace surefoot::gaits
