#include "surefoot/control/active_stack.hpp"

#include "surefoot/control/hierarchy_summary.hpp"

#include <utility>

namespace surefoot::control {

ActiveStack::ActiveStack(const ControllerOptions& options, const model::RobotDescription& robot)
    : solver_options_(options.solver),
      robot_(robot),
      solved_(std::make_unique<SolvedStack>(options.stack, options.solver, robot)),
      switcher_(options.stack, options.level_switches) {}

const solver::Hierarchy& ActiveStack::update(double time, const model::Dynamics& dynamics,
                                             const MotionPlan& plan) noexcept {
  const LevelTransition& transition = switcher_.update(time);
  solved_->stack.set_present(transition.before | transition.after);
  return solved_->stack.update(dynamics, plan);
}

const solver::Solution& ActiveStack::solve(double time, const model::Dynamics& dynamics,
                                           const MotionPlan& plan) noexcept {
  auto& [stack, solver] = *solved_;
  const solver::Substitution* physics =
      solver.wants_substitution() ? stack.substitution(dynamics) : nullptr;
  const solver::Solution& solution =
      solver.solve(stack.hierarchy(), physics, switcher_.transition());
  return is_fading() ? fade_->between(dynamics, plan, time, stack.hierarchy(), solution) : solution;
}

void ActiveStack::describe(const solver::Solution& solution, bool explains,
                           HierarchyReport& report) noexcept {
  summarise(solution, hierarchy(), report);
  if (explains && !is_fading()) {
    summarise_blockers(solved_->solver.blockers(), hierarchy(), report);
  }
  report.transition_share = share();
  report.level_switch = switcher_.begun();
}

HierarchyOutcome ActiveStack::outcome(const solver::Solution& solution,
                                      const MotionPlan& plan) const {
  const bool is_optimum = share() >= 1.0;
  return {.tilt_shortfall = is_optimum ? tasks().tilt_shortfall(solution) : kNaN,
          .pyramid_normal = tasks().pyramid_normals(plan)};
}

double ActiveStack::share() const {
  return is_fading() ? fade_->share() : switcher_.transition().share;
}

const PartFault& ActiveStack::fault() const {
  return tasks().fault().is_set() || !is_fading() ? tasks().fault() : fade_->fault();
}

void ActiveStack::restart() noexcept {
  switcher_.restart();
  if (fade_) fade_->restart();
}

bool ActiveStack::switch_levels(const LevelSwitch& change) {
  check_level_switch(switcher_.stack(), change);
  return !is_fading() && switcher_.start(change);
}

bool ActiveStack::set_stack(const StackOptions& options, double duration) {
  check_physics(options);
  check_stack_change(switcher_.stack(), options, duration);
  if (is_fading() || !switcher_.is_idle()) return false;
  LevelSwitcher next_switcher = switcher_.for_stack(options);
  auto next = std::make_unique<SolvedStack>(options, solver_options_, robot_);
  fade_ = std::make_unique<StackFade>(std::exchange(solved_, std::move(next)),
                                      switcher_.transition().after, hierarchy(), duration);
  switcher_ = std::move(next_switcher);
  return true;
}

}  // namespace surefoot::control
