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
                            const ComPlan& com, double height) {
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

  const Mat3 R_heading = rotation_about_z(yaw);
  const Mat3 R_pitch = Eigen::AngleAxisd(tilt_.y(), Vec3::UnitY()).toRotationMatrix();
  const auto angular = [&](const Vec2& roll_pitch) -> Vec3 {
    return R_heading * (R_pitch.col(0) * roll_pitch.x() + Vec3::UnitY() * roll_pitch.y());
  };
  plan_.q_WB = from_roll_pitch_yaw(Vec3(tilt_.x(), tilt_.y(), yaw));
  plan_.w_WB = angular(tilt_rate_) + yaw_rate * Vec3::UnitZ();
  // The axes of pitch and roll turn too: ẇ = axes · r̈ + their own rates.
  const Vec3 w_heading = yaw_rate * Vec3::UnitZ();
  const Vec3 w_pitch = tilt_rate_.y() * R_heading.col(1);
  const Vec3 w_roll = tilt_rate_.x() * (R_heading * R_pitch.col(0));
  plan_.wdot_WB =
      angular(tilt_acceleration) + w_heading.cross(w_pitch + w_roll) + w_pitch.cross(w_roll);
  plan_.height = height_;
  plan_.height_rate = height_rate_;
  plan_.height_acceleration = height_acceleration;
}

}  // namespace surefoot
