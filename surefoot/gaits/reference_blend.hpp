#pragma once

#include "surefoot/base/scale.hpp"
#include "surefoot/math/quintic.hpp"
#include "surefoot/math/types.hpp"
#include "surefoot/signals/motion_plan.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace surefoot::gaits {

/// What is left of a reference that another follows, until it has faded.
template <typename T>
class Fade {
 public:
  /// Takes at least `shortest` [s], and so long that p alone asks for about `gentle` and v alone
  /// for `fast`, accelerations.
  void begin(double time, const Motion<T>& left, double shortest, double gentle, double fast) {
    left_ = left;
    begin_ = time;
    duration_ = std::max({shortest, std::sqrt(kOfPosition * length(left.p) / gentle),
                          kOfVelocity * length(left.v) / fast});
  }
  [[nodiscard]] Motion<T> at(double time) const {
    const T none = zero();
    if (time - begin_ >= duration_) return {none, none, none};
    return hermite<T>(left_, {none, none, none}, time - begin_, duration_);
  }

 private:
  // Largest acceleration of a fade from p or v alone: 5.8 p/T², 4 v/T.
  static constexpr double kOfPosition = 5.8, kOfVelocity = 4.0;

  static double length(double x) { return std::abs(x); }
  static double length(const Vec2& x) { return x.norm(); }
  static T zero() {
    if constexpr (std::is_same_v<T, double>)
      return 0.0;
    else
      return T::Zero();
  }

  Motion<T> left_{zero(), zero(), zero()};
  double begin_ = -1e9, duration_ = 0.0;  // [s]
};

/// Takes the jump out of the references of COM, height and pitch where a gait follows another: the
/// difference fades, gently along the ground. A robot that lands must be caught sooner.
class ReferenceBlend {
 public:
  /// With COM and torso of the old gait's last plan, and the first plan of the new one. Takes
  /// at least `shortest` [s].
  void begin(double time, const ComPlan& com, const TorsoPlan& torso, const MotionPlan& next,
             double shortest) {
    const ComPlan& to = next.com;
    com_.begin(time, {com.p - to.p, com.v - to.v, com.a - to.a}, shortest, kGentle, kGentle);
    height_.begin(time,
                  {torso.height - next.torso.height, torso.height_rate - next.torso.height_rate,
                   torso.height_acceleration - next.torso.height_acceleration},
                  shortest, kGentle, kLanding);
  }
  void apply(double time, MotionPlan& plan) const {
    const Motion<Vec2> com = com_.at(time);
    plan.com.p += com.p;
    plan.com.v += com.v;
    plan.com.a += com.a;
    const Motion<double> height = height_.at(time);
    plan.torso.height += height.p;
    plan.torso.height_rate += height.v;
    plan.torso.height_acceleration += height.a;
  }
  void begin_pitch(double time, const Motion<double>& from, const Motion<double>& to,
                   double shortest, const Scale& scale) {
    const double turning = kTurning / scale.length;
    pitch_.begin(time, {from.p - to.p, from.v - to.v, from.a - to.a}, shortest, turning, turning);
  }
  [[nodiscard]] Motion<double> pitch(double time) const { return pitch_.at(time); }

 private:
  static constexpr double kGentle = 1.0, kLanding = 10.0;  // [m/s²]
  static constexpr double kTurning = 20.0;                 // at scale 1 [rad/s²]

  Fade<Vec2> com_;
  Fade<double> height_, pitch_;
};

}  // namespace surefoot::gaits
