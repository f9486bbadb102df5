#pragma once

#include "surefoot/estimation/terrain_plane.hpp"
#include "surefoot/math/quintic.hpp"
#include "surefoot/planning/planner_options.hpp"
#include "surefoot/signals/motion_plan.hpp"
#include "surefoot/signals/robot_state.hpp"

namespace surefoot {

/// Desired torso pose: yaw along the heading, roll and pitch along the terrain plane, height over
/// it; plane and height pass through a critically damped filter  r̈ = ω² (target − r) + 2 ω (ṫarget
/// − ṙ).
class TorsoReference {
 public:
  TorsoReference(const TorsoOptions& options, double period) : options_(options), period_(period) {}

  /// Begins at the true pose: at the start, and after a touchdown that found it far off.
  void restart(const RobotState& state);
  /// Is the torso further from the reference than the options allow?
  [[nodiscard]] bool far_off(const RobotState& state) const;
  /// One period on. `com` gives where over the plane the torso is and how fast it goes; `turn` is
  /// added to roll, pitch and yaw.
  void update(const TerrainPlane& plane, double yaw, double yaw_rate, const ComPlan& com,
              double height, const Motion<Vec3>& turn = no_turn());

  [[nodiscard]] const TorsoPlan& plan() const { return plan_; }

 private:
  void write_orientation(const Vec3& angles, const Vec3& rates, const Vec3& accelerations);
  static Motion<Vec3> no_turn() { return {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()}; }

  TorsoOptions options_;
  double period_;
  Vec2 tilt_{0.0, 0.0}, tilt_rate_{0.0, 0.0};  // roll and pitch [rad], [rad/s]
  double height_ = 0.0, height_rate_ = 0.0;
  TorsoPlan plan_;
};

}  // namespace surefoot
