#include "surefoot/tasks/torso_orientation.hpp"

#include "surefoot/math/rotation.hpp"

namespace surefoot::tasks {

void TorsoOrientation::write(const TaskInput& input, solver::Level& level) const noexcept {
  const model::RotationKinematics& base = input.dynamics.base_rotation;
  const TorsoPlan& reference = input.plan.torso;
  const Vec3 orientation_error = box_minus(reference.q_WB, Quat(base.R));
  const Vec3 rate_error = reference.w_WB - base.w;

  // The axes of C in W, a column each.
  const auto axes = input.plan.R_WC.middleCols(first_axis_, num_axes_);
  using AxisVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 3, 1>;
  AxisVector error = axes.transpose() * orientation_error;
  const double size = error.norm();
  if (size > options_.max_error) error *= options_.max_error / size;

  solver::Rows rows = level.add(num_axes_, first_id());
  rows.A.leftCols(input.dynamics.num_velocities()).noalias() = axes.transpose() * base.J;
  rows.lower = axes.transpose() * (reference.wdot_WB + options_.kd * rate_error - base.Jdot_u);
  rows.lower += options_.kp * error;
  rows.upper = rows.lower;
}

std::string TorsoYaw::row_name(int) const { return "yaw"; }
std::string TorsoRollPitch::row_name(int id) const { return id == 0 ? "roll" : "pitch"; }

}  // namespace surefoot::tasks
