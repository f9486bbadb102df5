#include "surefoot/estimation/terrain_plane.hpp"

#include <Eigen/Eigenvalues>

#include <cmath>

namespace surefoot::estimation {
namespace {

constexpr double kMinSpread = 0.02;  // [m]

}  // namespace

TerrainPlane fit_terrain_plane(const PerLeg<Vec3>& footholds, double max_tilt, const Scale& scale) {
  const double min_spread = scale.length * kMinSpread;
  const auto count = static_cast<double>(footholds.size());
  TerrainPlane plane;
  for (const Vec3& p : footholds) plane.point += p / count;
  Mat2 moment = Mat2::Zero();
  Vec2 product = Vec2::Zero();
  for (const Vec3& p : footholds) {
    const Vec3 d = p - plane.point;
    moment += d.head<2>() * d.head<2>().transpose();
    product += d.head<2>() * d.z();
  }
  Eigen::SelfAdjointEigenSolver<Mat2> axes;
  axes.computeDirect(moment);
  Vec2 slope = Vec2::Zero();
  for (int i = 0; i < 2; ++i) {
    if (axes.eigenvalues()[i] < min_spread * min_spread) continue;
    const Vec2 axis = axes.eigenvectors().col(i);
    slope += axis * (axis.dot(product) / axes.eigenvalues()[i]);
  }
  const double steepest = std::tan(max_tilt);
  if (slope.norm() > steepest) slope *= steepest / slope.norm();
  plane.normal = Vec3(-slope.x(), -slope.y(), 1.0).normalized();
  return plane;
}

Mat3 control_frame(const Vec3& normal, double yaw) {
  const Vec3 heading(std::cos(yaw), std::sin(yaw), 0.0);
  Mat3 R;
  R.col(2) = normal;
  R.col(1) = normal.cross(heading).normalized();
  R.col(0) = R.col(1).cross(normal);
  return R;
}

}  // namespace surefoot::estimation
