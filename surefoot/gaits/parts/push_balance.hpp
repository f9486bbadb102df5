#pragma once

#include "surefoot/gaits/parts/com_planner.hpp"
#include "surefoot/gaits/parts/leg_limits.hpp"
#include "surefoot/model/dynamics.hpp"
#include "surefoot/signals/robot_state.hpp"

#include <algorithm>

namespace surefoot::gaits {

/// The robot's balance under the external force that the state estimates: where it would come to
/// rest, and whether the force is one that a plan can rely on.
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
  /// Has the force stayed about what it is?
  [[nodiscard]] bool is_steady() const {
    const double share = options_.unsteady_share * settled_force_.norm();
    return (force_ - settled_force_).norm() < std::max(options_.unsteady, share);
  }
  /// How much slower than commanded a robot should walk that leans: its legs have less way.
  [[nodiscard]] double caution() const {
    return is_pushed() ? 1.0 + shift_.norm() / options_.slow_shift : 1.0;
  }
  /// Has the load moved so far from that of the plan that it needs a new one?
  [[nodiscard]] bool wants_plan(double time) const {
    const double step = height_ * options_.replan_step / weight_;
    return (shift_ - planned_shift_).norm() > step && time - planned_at_ > options_.replan_interval;
  }
  /// Is the plan old enough for a new one, with a robot that is pushed?
  [[nodiscard]] bool may_plan(double time) const {
    return is_pushed() && time - planned_at_ > options_.replan_interval;
  }
  /// A plan was made with this tick's load.
  void planned(double time) {
    planned_at_ = time;
    planned_shift_ = shift_;
  }

  /// Where the ZMP has to be for the COM to come to rest over it, c + √(h/g) ċ + d, with the shift
  /// d of the load, x and y in W [m].
  [[nodiscard]] const Vec2& capture_point() const { return capture_point_; }
  /// How far the capture point is out of the region, along the normal of the edge that it is
  /// farthest beyond [m]; zero inside.
  [[nodiscard]] Vec2 excess(const SupportRegion& region) const;
  /// Where the capture point is after a time, at best: with the ZMP at the edge of the region that
  /// it is out of; where it is, inside.
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
