#pragma once

#include "surefoot/math/types.hpp"

#include <cmath>

namespace surefoot {

/// S(a) with S(a) b = a × b.
[[nodiscard]] inline Mat3 skew(const Vec3& a) {
  Mat3 result;
  result << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return result;
}

/// Is q of unit length, up to rounding and filters? False for NaN.
[[nodiscard]] inline bool is_rotation(const Quat& q) { return std::abs(q.norm() - 1.0) < 0.01; }

/// Rotation of |v| radians about v.
[[nodiscard]] Quat exp_rotation(const Vec3& v);

/// Rotation vector of q, |result| ≤ π; the inverse of exp_rotation, exact to rounding.
[[nodiscard]] Vec3 log_rotation(const Quat& q);

/// Orientation error q_a ⊟ q_b = log(q_a q_b⁻¹), in the target frame of q_a and q_b. For q_WB: the
/// rotation vector in W that takes b to a; its rate is w_a − w_b for small errors.
[[nodiscard]] inline Vec3 box_minus(const Quat& q_a, const Quat& q_b) {
  return log_rotation(q_a * q_b.conjugate());
}

/// Heading of a frame: the angle of its x axis in the horizontal plane [rad].
[[nodiscard]] double yaw(const Mat3& R);

/// Rotation about z by an angle [rad].
[[nodiscard]] Mat3 rotation_about_z(double angle);

/// Roll, pitch and yaw of R = R_z(yaw) R_y(pitch) R_x(roll) [rad].
[[nodiscard]] Vec3 roll_pitch_yaw(const Mat3& R);

/// R = R_z(yaw) R_y(pitch) R_x(roll) as a quaternion.
[[nodiscard]] Quat from_roll_pitch_yaw(const Vec3& angles);

/// Shortens v to at most `limit`, in the same direction.
template <int N>
[[nodiscard]] Eigen::Matrix<double, N, 1> clip_norm(const Eigen::Matrix<double, N, 1>& v,
                                                    double limit) {
  const double length = v.norm();
  return length > limit ? Eigen::Matrix<double, N, 1>(v * (limit / length)) : v;
}

}  // namespace surefoot
