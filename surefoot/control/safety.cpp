#include "surefoot/control/safety.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot {
namespace {

constexpr double kNearlyUnit = 0.01;
constexpr double kFullTurn = 2.0 * kPi;  // no joint is turned further [rad]

JointVector finite_or_zero(const JointVector& v) {
  JointVector result = v;
  for (double& value : result) value = std::isfinite(value) ? value : 0.0;
  return result;
}

}  // namespace

Safety::Safety(const SafetyOptions& options, const RobotDescription& robot, int first_free_level)
    : options_(options),
      torque_limit_(robot.torque_limit),
      hold_kp_(robot.hold_kp),
      hold_kd_(robot.hold_kd),
      damping_kd_(robot.damping_kd),
      first_free_level_(first_free_level) {}

const JointCommand& Safety::command(const RobotState& state, const Solution* solution) noexcept {
  command_.time = std::isfinite(state.time) ? state.time : command_.time;
  const bool solved = solution != nullptr && solution->status == SolveStatus::optimal;
  const bool usable =
      solved || (solution != nullptr && solution->status == SolveStatus::iteration_cap &&
                 solution->failed_level >= first_free_level_);
  const bool good = usable && solution->x.allFinite() && solution->x.size() == kNumUnknowns;
  failures_ = good ? 0 : failures_ + 1;
  const bool is_rotation = std::abs(state.q_WB.norm() - 1.0) < kNearlyUnit;  // not if it is NaN
  const double uprightness = is_rotation ? state.R_WB()(2, 2) : 1.0;
  damping_ = damping_ || failures_ > options_.damp_after_failures ||
             uprightness < std::cos(options_.max_tilt);
  if (damping_) {
    damp(state);
  } else if (good) {
    command_.mode = solved ? CommandMode::optimal : CommandMode::degraded;
    command_.torque = solution->x.tail<kNumJoints>();
    limit();
    good_q_ = state.q;
    good_torque_ = command_.torque;
  } else {
    hold(state);
  }
  limit();
  return command_;
}

void Safety::hold(const RobotState& state) {
  command_.mode = CommandMode::hold;
  const bool is_posture = (state.q.array().abs() <= kFullTurn).all();  // not if it is NaN
  if (!good_q_.allFinite() && is_posture) good_q_ = state.q;
  // Apart, for where the position is not known the damping still works, and the other way round.
  command_.torque = good_torque_ + finite_or_zero(hold_kp_ * (good_q_ - state.q)) -
                    finite_or_zero(hold_kd_ * state.qd);
}

void Safety::damp(const RobotState& state) {
  command_.mode = CommandMode::damping;
  command_.torque = -damping_kd_ * finite_or_zero(state.qd);
}

void Safety::limit() {
  command_.torque =
      finite_or_zero(command_.torque).cwiseMax(-torque_limit_).cwiseMin(torque_limit_);
}

}  // namespace surefoot
