#include "surefoot/control/asked_stack.hpp"

#include "surefoot/control/hierarchy_summary.hpp"

namespace surefoot::control {

// Lying posture and period are not used: without sensor faults Safety never sits down, each state
// has its time, and the robot of a log has begun.
AskedStack::AskedStack(const StackOptions& stack, const SolverOptions& solver,
                       const SafetyOptions& safety, const model::RobotDescription& robot)
    : solved_(stack, solver, robot),
      ladder_at_start_(safety, robot, solved_.stack.first_free_level(),
                       JointVector::Zero(robot.num_joints()), 0.0),
      ladder_(ladder_at_start_) {
  for (Safety* ladder : {&ladder_at_start_, &ladder_}) ladder->assume_begun();
  at_rest_.before.set();
  at_rest_.after.set();
}

const StackAnswer& AskedStack::ask(const RobotState& state, const model::Dynamics& dynamics,
                                   const MotionPlan& plan) noexcept {
  const solver::Hierarchy& hierarchy = solved_.stack.update(dynamics, plan);
  const solver::Substitution* physics =
      solved_.solver.wants_substitution() ? solved_.stack.substitution(dynamics) : nullptr;
  const solver::Solution& solution = solved_.solver.solve(hierarchy, physics, at_rest_);
  summarise(solution, hierarchy, answer_.hierarchy);
  command(state, solution, plan.standing());
  return answer_;
}

// A stop is latched, but the robot of the next tick stands, as in the log: restarts the ladder.
void AskedStack::command(const RobotState& state, const solver::Solution& solution,
                         const PerLeg<bool>& stands) noexcept {
  ladder_.set_standing(stands);
  answer_.command = ladder_.command(state, &solution);
  if (answer_.command.cause == StopCause::none) return;
  Safety restarted = ladder_at_start_;
  restarted.set_standing(stands);
  const JointCommand first = restarted.command(state, &solution);
  if (first.cause != StopCause::none || first.mode == CommandMode::hold) return;
  answer_.command = first;
  ladder_ = restarted;
}

std::vector<std::string> AskedStack::level_names() const {
  const solver::Hierarchy& hierarchy = solved_.stack.hierarchy();
  std::vector<std::string> names;
  for (std::size_t k = 0; k < hierarchy.num_levels(); ++k)
    names.push_back(hierarchy.level(k).name());
  return names;
}

}  // namespace surefoot::control
