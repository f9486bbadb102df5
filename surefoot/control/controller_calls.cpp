// The calls of the public class, but for its tick in controller.cpp.

#include "surefoot/base/error.hpp"
#include "surefoot/base/fields.hpp"
#include "surefoot/control/controller_implementation.hpp"

#include <memory>
#include <string>
#include <utility>

namespace surefoot::control {

Controller::Controller(const model::RobotDescription& robot, const ControllerOptions& options,
                       std::unique_ptr<estimation::StateEstimator> estimator,
                       std::unique_ptr<gaits::MotionPlanner> planner) {
  if (estimator == nullptr) throw Error("the controller was given no state estimator");
  implementation_ =
      std::make_unique<Implementation>(robot, options, std::move(estimator), std::move(planner));
  ControllerOptions given = options;
  check_fields("", fields(given));
  for (gaits::NamedGait& gait : given.gaits)
    check_fields("gaits." + gait.name, fields(gait.options));
}

Controller::~Controller() = default;

const JointCommand& Controller::step(const SensorReading& reading,
                                     const UserCommand& user) noexcept {
  return implementation_->step(reading, user);
}

bool Controller::switch_levels(const LevelSwitch& change) {
  return implementation_->stack.switch_levels(change);
}

bool Controller::set_stack(const StackOptions& stack, double duration) {
  if (!implementation_->stack.set_stack(stack, duration)) return false;
  implementation_->follow_frames();
  implementation_->safety.set_first_free_level(implementation_->stack.tasks().first_free_level());
  return true;
}

void Controller::set_friction(double friction) { implementation_->planner->set_friction(friction); }

const TickRecord& Controller::record() const { return implementation_->record; }

const std::array<double, kMaxLevels>& Controller::level_times() const {
  return implementation_->level_times;
}

const solver::Hierarchy& Controller::hierarchy() const {
  return implementation_->stack.hierarchy();
}

const model::Dynamics* Controller::dynamics() const {
  return implementation_->has_solved ? &implementation_->model.dynamics() : nullptr;
}

std::vector<std::string> Controller::level_names() const {
  const solver::Hierarchy& hierarchy = implementation_->stack.hierarchy();
  std::vector<std::string> names;
  for (std::size_t i = 0; i < hierarchy.num_levels(); ++i)
    names.push_back(hierarchy.level(i).name());
  return names;
}

std::vector<std::string> Controller::level_units() const {
  return implementation_->stack.tasks().units();
}

std::string Controller::row_name(int level, int id) const {
  return implementation_->stack.tasks().row_name(level, id);
}

std::vector<std::vector<std::string>> Controller::row_names() const {
  return implementation_->stack.tasks().row_names();
}

std::string Controller::fault() const { return implementation_->fault.text(); }

std::vector<std::string> Controller::own_parts() const { return implementation_->own_parts; }

std::vector<std::string> Controller::notes() const { return implementation_->notes; }

void Controller::explain_levels(bool wanted) { implementation_->explains_levels = wanted; }

void Controller::set_stage_observer(StageObserver* observer) {
  implementation_->observer = observer;
}

int Controller::steps_taken() const { return implementation_->planner->steps_taken(); }

}  // namespace surefoot::control
