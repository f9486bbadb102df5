#include "surefoot/tasks/manipulability.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::tasks {

LegManipulability leg_manipulability(const model::Dynamics& dynamics, Leg leg) noexcept {
  constexpr double kSmallestDeterminant = 1e-4;  // [m³]
  const Mat3 J = dynamics.foot[index(leg)].J.middleCols<3>(6 + first_joint(leg));
  const Mat3 axes = dynamics.shank[index(leg)].J.middleCols<3>(6 + first_joint(leg));
  Mat3 cofactors;  // ∂(det J)/∂j_i, a column each
  for (int i = 0; i < 3; ++i) {
    cofactors.col(i) = Vec3(J.col((i + 1) % 3)).cross(Vec3(J.col((i + 2) % 3)));
  }
  const double determinant = J.col(0).dot(cofactors.col(0));
  const double sign = determinant < 0.0 ? -1.0 : 1.0;

  LegManipulability result;
  result.m = std::abs(determinant);
  for (int l = 0; l < 3; ++l) {
    for (int i = 0; i < 3; ++i) {
      const Vec3 axis = axes.col(std::min(i, l));
      const Vec3 column = J.col(std::max(i, l));
      result.gradient[l] += sign * cofactors.col(i).dot(axis.cross(column));
    }
  }
  const double length = dynamics.scale.length;
  const double smallest = length * length * length * kSmallestDeterminant;
  const double divisor = sign * std::max(result.m, smallest);
  result.height_gradient = -result.gradient.dot(cofactors.row(2)) / divisor;
  return result;
}

void Manipulability::write(const TaskInput& input, solver::Level& level) const noexcept {
  double drive = 0.0;
  const std::size_t more = options_.weights.size() - input.dynamics.foot.size();
  for (const Leg leg : input.dynamics.foot.legs()) {
    const LegManipulability measure = leg_manipulability(input.dynamics, leg);
    const double slope =
        options_.form == Form::paper ? measure.gradient[2] : measure.height_gradient;
    drive += options_.k0 * options_.weights[index(leg) + (is_front(leg) ? 0U : more)] * slope;
  }
  drive = std::clamp(drive, -options_.max_acceleration, options_.max_acceleration);
  const model::PointKinematics& base = input.dynamics.base;
  solver::Rows row = level.add(1, first_id());
  row.A.leftCols(input.dynamics.num_velocities()) = base.J.row(2);
  row.set_equal(0, drive - options_.kd * base.v.z() - base.Jdot_u.z());
}

std::string Manipulability::row_name(int) const { return "height"; }

}  // namespace surefoot::tasks
