#include "surefoot/tasks/torque_limits.hpp"

#include "surefoot/base/error.hpp"

#include <algorithm>

namespace surefoot::tasks {

TorqueLimits::TorqueLimits(const Options& options) : options_(options) {
  if (!(options.fraction > 0.0 && options.fraction <= 1.0)) {
    throw Error("torque_limits: fraction must be above 0 and at most 1");
  }
  if (!(options.corner_speed >= 0.0 && options.corner_speed < 1.0)) {
    throw Error("torque_limits: corner_speed must be at least 0 and below 1");
  }
}

void TorqueLimits::write(const TaskInput& input, solver::Level& level) const noexcept {
  solver::Rows rows = level.add(input.dynamics.num_joints(), first_id());
  rows.A.rightCols(input.dynamics.num_joints()).setIdentity();
  for (int j = 0; j < input.dynamics.num_joints(); ++j) {
    const double speed = input.dynamics.u[6 + j];
    const double speed_limit = input.robot.velocity_limit[j];
    const double torque_limit = input.robot.torque_limit[j];
    rows.lower[j] = -usable_fraction(-speed, speed_limit) * torque_limit;
    rows.upper[j] = usable_fraction(speed, speed_limit) * torque_limit;
  }
}

double TorqueLimits::usable_fraction(double speed, double speed_limit) const noexcept {
  if (options_.speed_line == SpeedLine::none) return options_.fraction;
  const double corner = options_.corner_speed * speed_limit;
  return options_.fraction * std::clamp((speed_limit - speed) / (speed_limit - corner), 0.0, 1.0);
}

}  // namespace surefoot::tasks
