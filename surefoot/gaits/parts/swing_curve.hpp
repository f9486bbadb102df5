#pragma once

#include "surefoot/base/scale.hpp"
#include "surefoot/gaits/planner_options.hpp"
#include "surefoot/math/quintic.hpp"
#include "surefoot/signals/leg.hpp"

namespace surefoot::gaits {

/// Start, goal and shape of a swing.
struct SwingTarget {
  Vec3 start = Vec3::Zero();     ///< foot at lift-off, in W [m]
  Vec3 goal = Vec3::Zero();      ///< expected foothold, in W [m]
  Vec3 normal = Vec3::UnitZ();   ///< of the terrain: direction of lift and search
  double duration = 0.5;         ///< [s]
  double apex = 0.08;            ///< over the higher of start and goal [m]
  double back = 0.0;             ///< initial motion away from the goal [m]
  bool straight = false;         ///< directly to the goal: ignores apex and back
  Vec3 velocity = Vec3::Zero();  ///< initial velocity of a straight swing [m/s]
};

/// Trajectory of a swing foot: quintic splines along and across the terrain normal, or a single one
/// straight to the goal; then a search straight down from the goal at constant speed.
class SwingCurve {
 public:
  SwingCurve() = default;
  /// `scale` of the robot.
  SwingCurve(const SwingTarget& target, const SwingOptions& options, const Scale& scale = {});

  /// Position, velocity and acceleration t after lift-off, in W. Beyond the duration: the search.
  [[nodiscard]] Motion<Vec3> at(double t) const;
  /// Moves the goal from t on, along the plane until the horizontal motion ends and again in the
  /// search, and in height until the apex. Position, velocity and acceleration stay continuous.
  void aim(double t, const Vec3& goal);
  /// Greatest acceleration before the search [m/s²].
  [[nodiscard]] double peak_acceleration() const;
  [[nodiscard]] const SwingTarget& target() const { return target_; }

 private:
  [[nodiscard]] Motion<Vec3> straight_motion(double t) const;
  [[nodiscard]] Motion<double> normal_motion(double t) const;
  /// How far a search has overtaken the touchdown speed, a time after its begin.
  [[nodiscard]] Motion<double> haste(double t) const;
  [[nodiscard]] Motion<Vec3> unaimed(double t) const;
  /// x without its part along the normal.
  [[nodiscard]] Vec3 flat(const Vec3& x) const {
    return x - target_.normal.dot(x) * target_.normal;
  }
  [[nodiscard]] Motion<Vec3> aimed_motion(double t) const;
  [[nodiscard]] Motion<double> horizontal_share(double t) const;
  [[nodiscard]] Motion<double> retreat(double t) const;

  SwingTarget target_;
  Vec3 along_ = Vec3::Zero();  ///< start to goal within the plane [m]
  Vec3 back_ = Vec3::Zero();   ///< farthest retreat from the start [m]
  double rise_ = 0.0;          ///< start to goal along the normal [m]
  double top_ = 0.0;           ///< highest point over the start [m]
  double apex_share_ = 0.45;   ///< of the duration, when it is reached
  double horizontal_start_ = 0.15, horizontal_end_ = 0.85;
  double late_aim_time_ = 0.15;  ///< until a late foot is over its goal [s]
  double touchdown_speed_ = 0.1, search_speed_ = 0.1;
  double aimed_at_ = -1.0;    ///< when the goal was moved, after the horizontal start [s]
  double aimed_until_ = 0.0;  ///< when the foot is over that goal [s]
  Motion<Vec3> aimed_from_{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};  ///< at that time
};

}  // namespace surefoot::gaits
