#include "surefoot/gaits/parts/torso_reference.hpp"

#include "surefoot/math/rotation.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::gaits {
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
  posture_ = {Vec3(angles.x(), angles.y(), state.p_WB.z()),
              Vec3(w_heading.x(), w_heading.y(), state.v_WB.z()), Vec3::Zero()};
  plan_.q_WB = state.q_WB;
  plan_.height = state.p_WB.z();
}

void TorsoReference::update(const estimation::TerrainPlane& plane, double yaw, double yaw_rate,
                            const ComPlan& com, double height, const Motion<Vec3>& turn) {
  const Vec3 level = options_.follow_terrain ? plane.normal : Vec3::UnitZ();
  const Vec2 tilt = roll_pitch_of(rotation_about_z(-yaw) * level);
  const double climb = -(plane.normal.head<2>().dot(com.v)) / plane.normal.z();
  const Motion<Vec3> target{Vec3(tilt.x(), tilt.y(), plane.height(com.p) + height),
                            Vec3(0.0, 0.0, climb), Vec3::Zero()};
  const double w = options_.frequency;
  const Vec3 jerk = w * w * w * (target.p - posture_.p) + 3.0 * w * w * (target.v - posture_.v) -
                    3.0 * w * posture_.a;
  posture_.a += period_ * jerk;
  posture_.v += period_ * posture_.a;
  posture_.p += period_ * posture_.v;

  const auto with_yaw = [](const Vec3& posture, double value) {
    return Vec3(posture.x(), posture.y(), value);
  };
  write_orientation(with_yaw(posture_.p, yaw) + turn.p, with_yaw(posture_.v, yaw_rate) + turn.v,
                    with_yaw(posture_.a, 0.0) + turn.a);
  plan_.height = posture_.p.z();
  plan_.height_rate = posture_.v.z();
  plan_.height_acceleration = posture_.a.z();
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

}  // namespace surefoot::gaits
