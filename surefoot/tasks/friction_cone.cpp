#include "surefoot/tasks/friction_cone.hpp"

#include "surefoot/math/numbers.hpp"
#include "surefoot/math/rotation.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace surefoot::tasks {
namespace {

constexpr double kMaxLean = 0.8;  // of the normal from the vertical, share of the half angle

/// B of Eq. 31 for one foot, for forces in W: four faces, each ≤ 0, and the normal force.
Eigen::Matrix<double, FrictionCone::kRowsPerLeg, 3> pyramid_rows(const FrictionPyramid& pyramid) {
  const double mu = pyramid.mu;
  const Vec3 heading = pyramid.axes.col(0);
  const Vec3 lateral = pyramid.axes.col(1);
  const Vec3 normal = pyramid.axes.col(2);
  Eigen::Matrix<double, FrictionCone::kRowsPerLeg, 3> B;
  B.row(0) = heading - mu * normal;
  B.row(1) = -heading - mu * normal;
  B.row(2) = lateral - mu * normal;
  B.row(3) = -lateral - mu * normal;
  B.row(4) = normal;
  return B;
}

/// The axes, turned towards the vertical until the pyramid contains a vertical force.
Mat3 standing_axes(const Mat3& axes, double mu) {
  const Vec3 normal = axes.col(2);
  const Vec3 level(normal.y(), -normal.x(), 0.0);  // n̂ × e_z
  const double sine = level.norm();
  const double excess = std::atan2(sine, normal.z()) - kMaxLean * std::atan(mu);
  if (!(excess > 0.0 && sine > 0.0)) return axes;
  return Eigen::AngleAxisd(excess, level / sine) * axes;
}

using MomentRows = Eigen::Matrix<double, FrictionCone::kMomentRows, 6>;

/// Each row times (force, moment) in the foot's axes is at most 0.
MomentRows moment_rows(double mu, double X, double Y) {
  MomentRows rows = MomentRows::Zero();
  rows.row(0) << 0.0, 0.0, -Y, 1.0, 0.0, 0.0;
  rows.row(1) << 0.0, 0.0, -Y, -1.0, 0.0, 0.0;
  rows.row(2) << 0.0, 0.0, -X, 0.0, 1.0, 0.0;
  rows.row(3) << 0.0, 0.0, -X, 0.0, -1.0, 0.0;
  Eigen::Index row = 4;
  for (const double a : {1.0, -1.0}) {
    for (const double b : {1.0, -1.0}) {
      rows.row(row++) << a * Y, b * X, -mu * (X + Y), a * mu, b * mu, 1.0;
      rows.row(row++) << a * Y, b * X, -mu * (X + Y), -a * mu, -b * mu, -1.0;
    }
  }
  return rows;
}

}  // namespace

double FrictionPyramid::use(const Vec3& force) const {
  const Vec3 along = axes.transpose() * force;
  return along.head<2>().cwiseAbs().maxCoeff() / (mu * along.z());
}

FrictionPyramid FrictionCone::pyramid(const MotionPlan& plan, Leg leg) const {
  const double inner = options_.pyramid == Pyramid::inner ? 1.0 / std::numbers::sqrt2 : 1.0;
  const Mat3 axes = options_.axes == Axes::control ? plan.R_WC : rotation_about_z(yaw(plan.R_WC));
  const double mu = inner * plan.feet[index(leg)].friction;
  return {standing_axes(axes, mu), mu};
}

void FrictionCone::write(const TaskInput& input, solver::Level& level) const noexcept {
  for (const Leg leg : input.plan.feet.legs()) {
    if (!input.support.in_contact(leg)) continue;
    const FootPlan& foot = input.plan.feet[index(leg)];
    const int force = input.support.first_force(leg);
    FrictionPyramid pyramid_of_leg = pyramid(input.plan, leg);
    if (has_flat_feet()) pyramid_of_leg.axes = input.dynamics.shank[index(leg)].R;
    const auto B = pyramid_rows(pyramid_of_leg);
    solver::Rows rows = level.add(kRowsPerLeg, first_id() + rows_per_leg() * static_cast<int>(leg));
    rows.A.noalias() = B * input.support.Lambda().middleRows<3>(force);
    rows.lower << -kInfinity, -kInfinity, -kInfinity, -kInfinity,
        std::min(foot.force_min, foot.force_max);
    rows.upper << 0.0, 0.0, 0.0, 0.0, foot.force_max;
    const Eigen::Matrix<double, kRowsPerLeg, 1> offset =
        B * input.support.lambda_0().segment<3>(force);
    rows.lower -= offset;
    rows.upper -= offset;
    if (has_flat_feet()) write_moments(input, leg, pyramid_of_leg.mu, level);
  }
}

void FrictionCone::write_moments(const TaskInput& input, Leg leg, double mu,
                                 solver::Level& level) const {
  const Vec2 sole = options_.sole * input.dynamics.sole;
  const Mat3 to_foot = input.dynamics.shank[index(leg)].R.transpose();
  MomentRows B = moment_rows(mu, sole.x(), sole.y());
  B.leftCols<3>() *= to_foot;
  B.rightCols<3>() *= to_foot;
  const int force = input.support.first_force(leg);
  solver::Rows rows =
      level.add(kMomentRows, first_id() + rows_per_leg() * static_cast<int>(leg) + kRowsPerLeg);
  rows.A.noalias() = B * input.support.Lambda().middleRows<6>(force);
  rows.lower.setConstant(-kInfinity);
  rows.upper = -B * input.support.lambda_0().segment<6>(force);
}

std::string FrictionCone::row_name(int id) const {
  constexpr std::array<const char*, kRowsPerLeg + kMomentRows> kNames{
      " slip forward",  " slip backward", " slip left",     " slip right",   " normal force",
      " tips left",     " tips right",    " tips back",     " tips forward", " turns left 1",
      " turns right 1", " turns left 2",  " turns right 2", " turns left 3", " turns right 3",
      " turns left 4",  " turns right 4"};
  return leg_name(id / rows_per_leg()) + kNames[static_cast<std::size_t>(id % rows_per_leg())];
}

}  // namespace surefoot::tasks
