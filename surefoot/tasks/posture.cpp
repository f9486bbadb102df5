#include "surefoot/tasks/posture.hpp"

#include <algorithm>

namespace surefoot::tasks {

void Posture::write(const TaskInput& input, solver::Level& level) const noexcept {
  using enum Joints;
  const Joints joints = options_.joints;
  if (joints == legs || joints == all) write(input, 0, input.robot.num_leg_joints(), level);
  if (joints == legs) return;
  int first = input.robot.num_leg_joints();
  for (int arm = 0; arm < static_cast<int>(input.robot.arms.size()); ++arm) {
    const auto count =
        static_cast<int>(input.robot.arms[static_cast<std::size_t>(arm)].joints.size());
    const bool reaches = input.plan.arm.arm == arm;
    const bool is_meant = joints == idle_arms ? !reaches : joints != reaching_arm || reaches;
    if (is_meant) write(input, first, count, level);
    first += count;
  }
}

void Posture::write(const TaskInput& input, int first, int count, solver::Level& level) const {
  solver::Rows rows = level.add(count, first_id() + first);
  rows.A.middleCols(6 + first, count).setIdentity();
  for (int i = 0; i < count; ++i) {
    const int j = first + i;
    const double error = std::clamp(input.robot.q_nominal[j] - input.dynamics.q[j],
                                    -options_.max_error, options_.max_error);
    rows.lower[i] = options_.kp * error - options_.kd * input.dynamics.u[6 + j];
  }
  rows.upper = rows.lower;
}

}  // namespace surefoot::tasks
