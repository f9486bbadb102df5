#pragma once

#include "surefoot/gaits/parts/com_planner.hpp"
#include "surefoot/gaits/parts/leg_limits.hpp"
#include "surefoot/model/dynamics.hpp"
#include "surefoot/signals/robot_state.hpp"

#include <algorithm>

namespace surefoot::gaits {

/// The robot's balance under the estimated external force: its capture point, and whether the force
/// is steady enough to plan with.
class PushBalance {
 public:
  /// `period` of the control loop [s].
  PushBalance(const PushOptions& options, double period) : options_(options), period_(period) {}

  /// One tick. `height` is that of the COM over the ground [m].
  void update(const RobotState& state, const model::Dynamics& dynamics, double height);

  [[nodiscard]] const ComLoad& load() const { return load_; }
  /// d, how far the load moves the ZMP [m].
  [[nodiscard]] const Vec2& shift() const { return shift_; }
  [[nodiscard]] bool is_pushed() const { return force_.norm() > 0.0; }
  /// Is the force close to its filtered value?
  [[nodiscard]] bool is_steady() const {
    const double share = options_.unsteady_share * settled_force_.norm();
    return (force_ - settled_force_).norm() < std::max(options_.unsteady, share);
  }
  /// Factor ≥ 1 by which the walk should slow down: a leaning robot's legs have shorter strides.
  [[nodiscard]] double caution() const {
    return is_pushed() ? 1.0 + shift_.norm() / options_.slow_shift : 1.0;
  }
  /// Has the load changed so much since the last plan that a new one is needed?
  [[nodiscard]] bool wants_plan(double time) const {
    const double step = height_ * options_.replan_step / weight_;
    return (shift_ - planned_shift_).norm() > step && time - planned_at_ > options_.replan_interval;
  }
  /// Is the robot pushed, and the plan old enough to be replaced?
  [[nodiscard]] bool may_plan(double time) const {
    return is_pushed() && time - planned_at_ > options_.replan_interval;
  }
  /// A plan was made with this tick's load.
  void planned(double time) {
    planned_at_ = time;
    planned_shift_ = shift_;
  }

  /// Capture point c + √(h/g) ċ + d with the load's shift d, x and y in W [m]: a ZMP there brings
  /// the COM to rest.
  [[nodiscard]] const Vec2& capture_point() const { return capture_point_; }
  /// Distance of the capture point from the region, along the normal of its farthest edge [m]; 0
  /// inside.
  [[nodiscard]] Vec2 excess(const SupportRegion& region) const;
  /// Best possible capture point after a time, with the ZMP at the edge of the region that it
  /// exceeds; unchanged inside the region.
  [[nodiscard]] Vec2 capture_point_after(const SupportRegion& region, double duration) const {
    return capture_point_ + (growth(duration) - 1.0) * excess(region);
  }
  /// The factor by which an excess grows in a time, e^(√(g/h) t).
  [[nodiscard]] double growth(double duration) const {
    return std::exp(std::sqrt(kGravity / height_) * std::max(0.0, duration));
  }

 private:
  PushOptions options_;
  double period_;
  double weight_ = kNaN;  // of the robot [N]
  double height_ = 0.5;
  double planned_at_ = 0.0;
  ComLoad load_;
  Vec2 force_{0.0, 0.0}, settled_force_{0.0, 0.0};  // [N]
  Vec2 shift_{0.0, 0.0}, planned_shift_{0.0, 0.0};  // of the ZMP [m]
  Vec2 capture_point_{0.0, 0.0};
};

}  // namespace surefoot::gaits
