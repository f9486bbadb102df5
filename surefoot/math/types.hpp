#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <numbers>

namespace surefoot {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using Mat2 = Eigen::Matrix2d;
using Mat3 = Eigen::Matrix3d;
using Quat = Eigen::Quaterniond;
using VecX = Eigen::VectorXd;
using MatX = Eigen::MatrixXd;

inline constexpr double kPi = std::numbers::pi;
/// Standard gravity [m/s²], along −z of the world frame W.
inline constexpr double kGravity = 9.81;
/// Gravity in W [m/s²].
inline const Vec3 kGravityVector(0.0, 0.0, -kGravity);

}  // namespace surefoot
