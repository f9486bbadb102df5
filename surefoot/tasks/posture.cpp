#include "surefoot/tasks/posture.hpp"

#include <algorithm>

namespace surefoot::tasks {

void Posture::write(const TaskInput& input, solver::Level& level) const noexcept {
  const int num_joints = input.dynamics.num_joints();
  const int begin = options_.joints == Joints::arms ? kNumLegJoints : 0;
  const int end = options_.joints == Joints::legs ? kNumLegJoints : num_joints;
  if (begin == end) return;
  solver::Rows rows = level.add(end - begin, first_id() + begin);
  rows.A.middleCols(6 + begin, end - begin).setIdentity();
  for (int j = begin; j < end; ++j) {
    const double error = std::clamp(input.robot.q_nominal[j] - input.dynamics.q[j],
                                    -options_.max_error, options_.max_error);
    rows.lower[j - begin] = options_.kp * error - options_.kd * input.dynamics.u[6 + j];
  }
  rows.upper = rows.lower;
}

}  // namespace surefoot::tasks
