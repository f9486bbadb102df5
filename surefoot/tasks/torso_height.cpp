#include "surefoot/tasks/torso_height.hpp"

#include <algorithm>

namespace surefoot::tasks {

void TorsoHeight::write(const TaskInput& input, solver::Level& level) const noexcept {
  const model::PointKinematics& base = input.dynamics.base;
  const TorsoPlan& reference = input.plan.torso;
  const double height_error =
      std::clamp(reference.height - base.p.z(), -options_.max_error, options_.max_error);
  const double rate_error = reference.height_rate - base.v.z();
  solver::Rows row = level.add(1, first_id());
  row.A.leftCols(input.dynamics.num_velocities()) = base.J.row(2);
  row.set_equal(0, reference.height_acceleration + options_.kd * rate_error +
                       options_.kp * height_error - base.Jdot_u.z());
}

std::string TorsoHeight::row_name(int) const { return "height"; }

}  // namespace surefoot::tasks
