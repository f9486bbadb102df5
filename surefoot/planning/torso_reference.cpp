#include "surefoot/planning/torso_reference.hpp"

#include "surefoot/math/rotation.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot {
namespace {

/// Roll and pitch of a torso whose z axis is `normal` (in heading axes): R_y(pitch) R_x(roll) e_z =
/// normal.
Vec2 roll_pitch_of(const Vec3& normal) {
  return {-std::asin(std::clamp(normal.y(), -1.0, 1.0)), std::atan2(normal.x(), normal.z())};
}

}  // namespace

void TorsoReference::restart(const RobotState& state) {
  const Mat3 R_WB = state.R_WB();
  const Vec3 angles = roll_pitch_yaw(R_WB);
  const Vec3 w_heading = rotation_about_z(-angles.z()) * (R_WB * state.w_WB_B);
  tilt_ = angles.head<2>();
  tilt_rate_ = w_heading.head<2>();
  height_ = state.p_WB.z();
  height_rate_ = state.v_WB.z();
  plan_.q_WB = state.q_WB;
  plan_.height = height_;
}

bool TorsoReference::far_off(const RobotState& state) const {
  const Vec2 tilt = roll_pitch_yaw(state.R_WB()).head<2>();
  return std::abs(state.p_WB.z() - height_) > options_.restart_position ||
         (tilt - tilt_).norm() > options_.restart_angle;
}

void TorsoReference::update(const TerrainPlane& plane, double yaw, double yaw_rate,
                            const ComPlan& com, double height, const Motion<Vec3>& turn) {
  const double w = options_.frequency;
  const Vec3 level = options_.follow_terrain ? plane.normal : Vec3::UnitZ();
  const Vec2 target_tilt = roll_pitch_of(rotation_about_z(-yaw) * level);
  const Vec2 tilt_acceleration = w * w * (target_tilt - tilt_) - 2.0 * w * tilt_rate_;
  tilt_rate_ += period_ * tilt_acceleration;
  tilt_ += period_ * tilt_rate_;

  const double target_height = plane.height(com.p) + height;
  const double target_rate = -(plane.normal.head<2>().dot(com.v)) / plane.normal.z();
  const double height_acceleration =
      w * w * (target_height - height_) + 2.0 * w * (target_rate - height_rate_);
  height_rate_ += period_ * height_acceleration;
  height_ += period_ * height_rate_;

  const Vec3 angles = Vec3(tilt_.x(), tilt_.y(), yaw) + turn.p;
  const Vec3 rates = Vec3(tilt_rate_.x(), tilt_rate_.y(), yaw_rate) + turn.v;
  const Vec3 accelerations = Vec3(tilt_acceleration.x(), tilt_acceleration.y(), 0.0) + turn.a;
  write_orientation(angles, rates, accelerations);
  plan_.height = height_;
  plan_.height_rate = height_rate_;
  plan_.height_acceleration = height_acceleration;
}

// The axes of pitch and roll turn too: ω = axes · ṙ and ω̇ = axes · r̈ + their own rates.
void TorsoReference::write_orientation(const Vec3& angles, const Vec3& rates,
                                       const Vec3& accelerations) {
  Mat3 axes;  // of roll, pitch and yaw, in W
  const Mat3 R_heading = rotation_about_z(angles.z());
  const Mat3 R_pitch = Eigen::AngleAxisd(angles.y(), Vec3::UnitY()).toRotationMatrix();
  axes << R_heading * R_pitch.col(0), R_heading.col(1), Vec3::UnitZ();
  const Vec3 w_roll = rates.x() * axes.col(0);
  const Vec3 w_pitch = rates.y() * axes.col(1);
  const Vec3 w_yaw = rates.z() * axes.col(2);
  plan_.q_WB = from_roll_pitch_yaw(angles);
  plan_.w_WB = axes * rates;
  plan_.wdot_WB = axes * accelerations + w_yaw.cross(w_pitch + w_roll) + w_pitch.cross(w_roll);
}

}  // namespace surefoot
