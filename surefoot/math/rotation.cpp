#include "surefoot/math/rotation.hpp"

#include <cmath>

namespace surefoot {

Quat exp_rotation(const Vec3& v) {
  const double angle = v.norm();
  // sin(a/2)/a; near zero by its series, where the quotient loses digits.
  const double scale = angle > 1e-4 ? std::sin(0.5 * angle) / angle : 0.5 - angle * angle / 48.0;
  Quat result(std::cos(0.5 * angle), scale * v.x(), scale * v.y(), scale * v.z());
  result.normalize();
  return result;
}

Vec3 log_rotation(const Quat& q) {
  const double sign = q.w() < 0.0 ? -1.0 : 1.0;  // q and −q are one rotation: take the shorter way
  const double w = sign * q.w();
  const Vec3 v = sign * q.vec();
  const double sine = v.norm();
  // 2 atan2(s, w)/s → (2/w)(1 − (s/w)²/3) for small s.
  const double scale = sine > 1e-4 ? 2.0 * std::atan2(sine, w) / sine
                                   : 2.0 / w * (1.0 - sine * sine / (3.0 * w * w));
  return scale * v;
}

double yaw(const Mat3& R) { return std::atan2(R(1, 0), R(0, 0)); }

Mat3 rotation_about_z(double angle) {
  return Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix();
}

Vec3 roll_pitch_yaw(const Mat3& R) {
  return {std::atan2(R(2, 1), R(2, 2)), std::atan2(-R(2, 0), std::hypot(R(2, 1), R(2, 2))), yaw(R)};
}

Quat from_roll_pitch_yaw(const Vec3& angles) {
  return Eigen::AngleAxisd(angles.z(), Vec3::UnitZ()) *
         Eigen::AngleAxisd(angles.y(), Vec3::UnitY()) *
         Eigen::AngleAxisd(angles.x(), Vec3::UnitX());
}

}  // namespace surefoot
