#pragma once

#include "surefoot/estimation/terrain_plane.hpp"
#include "surefoot/gaits/planner_options.hpp"
#include "surefoot/math/quintic.hpp"
#include "surefoot/signals/motion_plan.hpp"
#include "surefoot/signals/robot_state.hpp"

namespace surefoot::gaits {

/// Desired torso pose: yaw along the heading, roll and pitch along the terrain plane, height over
/// it; plane and height pass through a critically damped filter
///
///     r⃛ = ω³ (target − r) + 3 ω² (ṫarget − ṙ) − 3 ω r̈,
///
/// so that r, ṙ and r̈ stay continuous when the target jumps. It does not depend on the measured
/// torso, which may deviate from its reference, for example when a leg reaches down.
class TorsoReference {
 public:
  TorsoReference(const TorsoOptions& options, double period) : options_(options), period_(period) {}

  /// Starts at the estimated pose and velocity of the torso.
  void restart(const RobotState& state);
  /// One control period. Height and climb over the plane are taken at `com`; `height` is that over
  /// the plane [m]; `turn` is added to roll, pitch and yaw [rad].
  void update(const estimation::TerrainPlane& plane, double yaw, double yaw_rate,
              const ComPlan& com, double height,
              const Motion<Vec3>& turn = {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()});

  [[nodiscard]] const TorsoPlan& plan() const { return plan_; }

 private:
  void write_orientation(const Vec3& angles, const Vec3& rates, const Vec3& accelerations);

  TorsoOptions options_;
  double period_;
  Motion<Vec3> posture_{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};  // roll, pitch [rad], height [m]
  TorsoPlan plan_;
};

}  // namespace surefoot::gaits
