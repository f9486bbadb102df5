#pragma once

#include "surefoot/math/quintic.hpp"
#include "surefoot/math/types.hpp"
#include "surefoot/signals/motion_plan.hpp"

namespace surefoot::gaits {

/// Takes the jump out of the references of COM and height where a gait follows another: the
/// difference of both fades.
class ReferenceBlend {
 public:
  /// With COM and torso of the old gait's last plan, and the first plan of the new one.
  void begin(double time, const ComPlan& com, const TorsoPlan& torso, const MotionPlan& next) {
    const auto whole = [](const ComPlan& c, const TorsoPlan& t) {
      return Motion<Vec3>{{c.p.x(), c.p.y(), t.height},
                          {c.v.x(), c.v.y(), t.height_rate},
                          {c.a.x(), c.a.y(), t.height_acceleration}};
    };
    const Motion<Vec3> from = whole(com, torso), to = whole(next.com, next.torso);
    left_ = {from.p - to.p, from.v - to.v, from.a - to.a};
    begin_ = time;
  }
  void apply(double time, double duration, MotionPlan& plan) const {
    const double t = time - begin_;
    if (t >= duration) return;
    const Motion<Vec3> left =
        hermite<Vec3>(left_, {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()}, t, duration);
    plan.com.p += left.p.head<2>();
    plan.com.v += left.v.head<2>();
    plan.com.a += left.a.head<2>();
    plan.torso.height += left.p.z();
    plan.torso.height_rate += left.v.z();
    plan.torso.height_acceleration += left.a.z();
  }

 private:
  Motion<Vec3> left_{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  double begin_ = -1e9;  // [s]
};

}  // namespace surefoot::gaits
