#include "python/controller.hpp"

#include "python/bindings.hpp"
#include "python/dynamics.hpp"
#include "python/interrupt.hpp"
#include "python/numbers.hpp"
#include "python/own_parts.hpp"
#include "python/plant.hpp"
#include "surefoot/base/formatted.hpp"
#include "surefoot/config/hierarchy_json.hpp"
#include "surefoot/config/loaded_gaits.hpp"
#include "surefoot/config/stack_file.hpp"
#include "surefoot/config/stack_text.hpp"
#include "surefoot/logging/hierarchy_status.hpp"
#include "surefoot/simulation/make_estimator.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace surefoot::python {

std::vector<std::string> BoundController::gaits_of(const config::Scenario& scenario) {
  return config::gait_names(scenario.controller.gaits);
}

UserCommand BoundController::checked(const NamedCommand& user) const {
  UserCommand command = user;
  for (int i = 0; i < 2; ++i) {
    check_finite(user.velocity[i], "velocity[" + std::to_string(i) + "]");
    check_finite(user.shift[i], "shift[" + std::to_string(i) + "]");
  }
  check_finite(user.yaw_rate, "yaw_rate");
  check_finite(user.height, "height");
  if (user.reach.arm >= 0 || user.reach.frame >= 0)
    for (int i = 0; i < 3; ++i)
      check_finite(user.reach.position[i], "reach.position[" + std::to_string(i) + "]");
  if (!user.gait_name.empty()) {
    command.gait = config::gait_place(user.gait_name, gaits_);
  } else if (user.gait < UserCommand::kKeepGait || user.gait >= static_cast<int>(gaits_.size())) {
    throw Error("gait is " + std::to_string(user.gait) + "; " + config::valid_gaits("", gaits_) +
                ", or -1 for the scenario's own");
  }
  return command;
}

void BoundController::check(const SensorReading& reading) const {
  const int num_joints = robot_.num_joints();
  for (const auto& [name, numbers] :
       {std::pair("q", &reading.q), std::pair("torque", &reading.torque)}) {
    if (numbers->size() != num_joints)
      throw Error("reading." + std::string(name) + " has " + std::to_string(numbers->size()) +
                  " numbers, and " + robot_.name + " has " + std::to_string(num_joints) +
                  " joints; that of SensorReading(" + std::to_string(num_joints) +
                  ") would be valid");
  }
  const int num_legs = robot_.num_legs();
  const bool has_forces =
      std::ranges::any_of(reading.foot_force, [](double force) { return std::isfinite(force); });
  if (has_forces && static_cast<int>(reading.foot_force.size()) != num_legs)
    throw Error("reading.foot_force has " + std::to_string(reading.foot_force.size()) +
                " numbers, and " + robot_.name + " has " + std::to_string(num_legs) +
                " legs; that of SensorReading(" + std::to_string(num_joints) + ", " +
                std::to_string(num_legs) + ") would be valid");
}

bool BoundController::set_stack(const control::StackOptions& stack, double duration) {
  StackNames now = names();
  return changed([&](control::Controller& controller) {
    if (!controller.set_stack(stack, duration)) return false;
    before_ = std::move(now);
    return true;
  });
}

void BoundController::step(const SensorReading& reading, const NamedCommand& user) {
  const UserCommand command = checked(user);
  check(reading);
  unlocked([&](control::Controller& controller) { controller.step(reading, command); });
  before_.reset();
  ++ticks_;
  changes.end_tick();
  raise_waiting_exit();
  if (const std::string fault = new_fault(); !fault.empty())
    if (PyErr_WarnEx(PyExc_RuntimeWarning, fault.c_str(), 2) != 0) throw nb::python_error();
}

namespace {

/// Without a plant the state comes from the readings alone.
std::unique_ptr<estimation::StateEstimator> estimator(const config::Scenario& scenario,
                                                      const BoundPlant* plant) {
  const double period = scenario.controller.period;
  if (plant != nullptr && !plant->is_own())
    throw Error("plant is that of a run, which has a controller; a Plant(scenario) would be valid");
  if (plant != nullptr) plant->check_controller_of(scenario.robot.name);
  if (plant != nullptr)
    return simulation::make_estimator(scenario.estimation,
                                      {scenario.robot, period, **plant, scenario.estimator});
  if (scenario.estimation == estimation::Estimation::truth) {
    throw Error("the scenario " + scenario.name +
                " has estimation: truth, which needs the plant that knows it; give the plant, or "
                "set=[\"estimation=sensors\"]");
  }
  return std::make_unique<estimation::LegInertialEstimator>(scenario.robot, scenario.estimator,
                                                            period);
}

bool set_stack(BoundController& self, const std::string& text, const std::string& name,
               double duration, const nb::list& own) {
  const control::StackOptions stack = stack_for(self.robot(), text, name, own_tasks(own));
  if (!self.set_stack(stack, duration)) return false;
  self.changes.add({.time = kNaN,
                    .kind = "stack",
                    .text = "stack " + name,
                    .stack = config::stack_yaml(config::with_defaults(stack)),
                    .duration = duration,
                    .body = {}},
                   self.ticks());
  return true;
}

std::string listed(const char* what, const std::vector<std::string>& levels) {
  std::string text;
  for (const std::string& level : levels) text += (text.empty() ? what : ", ") + level;
  return text;
}

bool switch_levels(BoundController& self, const std::vector<std::string>& add,
                   const std::vector<std::string>& remove, double duration) {
  if (!self->switch_levels({.time = 0.0, .add = add, .remove = remove, .duration = duration}))
    return false;
  const std::string come = listed("levels come: ", add), go = listed("levels go: ", remove);
  self.changes.add({.time = kNaN,
                    .kind = "levels",
                    .text = come + (come.empty() || go.empty() ? "" : ", ") + go,
                    .stack = {},
                    .duration = duration,
                    .body = {}},
                   self.ticks());
  return true;
}

std::optional<NamedDynamics> dynamics(const BoundController& self) {
  const model::Dynamics* const now = self->dynamics();
  if (now == nullptr) return std::nullopt;
  return NamedDynamics{self.shared_robot(), *now};
}

/// The levels of the last tick, as solve() takes them.
nb::list problem(const BoundController& self) {
  const bool was_solved =
      self->dynamics() != nullptr && logging::was_solved(self->record().hierarchy);
  if (!was_solved || self.has_other_stack())
    throw Error(
        "no hierarchy was solved at the last tick, or another stack has come since; after "
        "a step() one would be there");
  const solver::Hierarchy& hierarchy = self->hierarchy();
  const auto row_name = [&](std::size_t level, Eigen::Index row) {
    return self->row_name(static_cast<int>(level), hierarchy.level(level).id(row));
  };
  const std::string line = config::format_hierarchy(hierarchy, row_name, self->level_units());
  const nb::object levels =
      nb::module_::import_("json").attr("loads")(line)["levels"];  // None: no lower bound
  for (const nb::handle each : levels) {
    const auto level = nb::borrow<nb::dict>(each);
    if (!level.contains("lower")) continue;
    nb::list lower;
    for (const nb::handle bound : level["lower"])
      lower.append(bound.is_none() ? nb::object(nb::float_(-kInfinity)) : nb::borrow(bound));
    level["lower"] = lower;
  }
  return nb::list(levels);
}

void set_friction(BoundController& self, double friction) {
  self->set_friction(friction);
  self.changes.add({.time = kNaN,
                    .kind = "friction",
                    .text = formatted("friction %.3g", friction),
                    .stack = {},
                    .friction = friction,
                    .body = {}},
                   self.ticks());
}

void bind_changes(nb::class_<BoundController>& type) {
  using Self = BoundController;
  type.def(
          "set_stack",
          [](nb::handle_t<Self> self, const nb::object& stack, double duration) {
            const Self& controller = nb::cast<Self&>(self);
            return nb::cast<bool>(nb::module_::import_("surefoot.control")
                                      .attr("change_stack")(self, stack, duration,
                                                            controller.shared_robot(),
                                                            controller.options()));
          },
          nb::arg("stack").none(), nb::arg("duration") = 0.3,
          nb::sig("def set_stack(self, stack: typing.Any, duration: float = 0.3) -> bool"),
          "Between two ticks: another stack with the same levels, in any order and with any gains. "
          "The torques fade to\nthe new ones over `duration` [s]. False, and without effect, "
          "during "
          "another change. The scenario's `tasks:` hold\nfor it, but for what you give yourself.")
      .def("set_stack_text", &set_stack, nb::arg("text"), nb::arg("name"), nb::arg("duration"),
           nb::arg("own") = nb::list(),
           nb::sig("def set_stack_text(self, text: str, name: str, duration: float, own: "
                   "list[typing.Any] = []) -> bool"),
           "As set_stack(), for the text of a stack file.")
      .def("switch_levels", &switch_levels, nb::kw_only(),
           nb::arg("add") = std::vector<std::string>(),
           nb::arg("remove") = std::vector<std::string>(), nb::arg("duration") = 0.5,
           "Between two ticks: adds and removes levels of the stack; the torques fade over "
           "`duration` "
           "[s].\nFalse, and without effect, during another switch.")
      .def("set_friction", &set_friction, nb::arg("friction"),
           "Between two ticks: the friction coefficient that the controller counts on.")
      .def(
          "explain_levels", [](Self& self, bool wanted) { self->explain_levels(wanted); },
          nb::arg("wanted") = true,
          "From the next tick on, finds out which rows hold each level back, at a cost of some "
          "microseconds.");
}

}  // namespace

void bind_controller(nb::module_& module) {
  using Self = BoundController;
  nb::class_<Self> type(module, "ControllerBase",
                        "The whole-body controller: one step() a tick turns readings into torques.",
                        nb::type_slots(kNoVectorcall));
  type.def(
          "__init__",
          [](Self* self, const config::Scenario& scenario, const BoundPlant* plant,
             const nb::object& own_estimation, const nb::object& planner) {
            new (self)
                Self(scenario,
                     std::make_unique<control::Controller>(
                         scenario.robot, scenario.controller,
                         own_estimation.is_none()
                             ? estimator(scenario, plant)
                             : own_estimator(SharedObject(own_estimation), scenario.robot),
                         planner.is_none() ? nullptr
                                           : own_planner(SharedObject(planner), scenario.robot)));
          },
          nb::arg("scenario"), nb::arg("plant") = nb::none(), nb::arg("estimator") = nb::none(),
          nb::arg("planner") = nb::none(),
          nb::sig("def __init__(self, scenario: Scenario, plant: Plant | None = None, estimator: "
                  "Estimator | None = None, planner: Planner | None = None) -> None"),
          nb::keep_alive<1, 3>())
      .def(
          "step",
          [](Self& self, const SensorReading& reading, const NamedCommand& user) {
            self.step(reading, user);
            return self->record().command;
          },
          nb::arg("reading"), nb::arg("user"),
          "One tick. Always gives finite torques inside the limits; it raises only on arguments "
          "that "
          "make no sense,\nand on Ctrl-C, after the tick. What goes wrong in a task, planner or "
          "estimator of your own is a\nRuntimeWarning, once, and stays in `fault`.")
      .def("__repr__",
           [](const Self& self) {
             if (self.has_ended()) return std::string("<controller of a run that has ended>");
             return "<controller of " + self.robot().name + ", " +
                    std::to_string(self->level_names().size()) + " levels, after " +
                    std::to_string(self->steps_taken()) + " footsteps>";
           })
      .def(
          "levels", [](const Self& self) { return outcomes(*self, self.names()); },
          "The hierarchy at the last tick, highest priority first.")
      .def_prop_ro(
          "state", [](const Self& self) { return self->record().state; },
          "as believed at the last tick")
      .def_prop_ro(
          "health", [](const Self& self) { return self->record().health; },
          "of the sensors at the last tick: what is wrong, and for how long")
      .def_prop_ro(
          "plan", [](const Self& self) { return self->record().plan; }, "of the last tick")
      .def_prop_ro(
          "model", [](const Self& self) { return self->record().model; },
          "centre of mass, feet and contact forces at the last tick")
      .def_prop_ro("dynamics", &dynamics,
                   "of the robot as believed at the last tick; None: nothing was solved")
      .def_prop_ro("problem", &problem,
                   nb::for_getter(nb::sig("def problem(self) -> list[dict[str, typing.Any]]")),
                   "The hierarchy of the last tick that was solved: "
                   "`surefoot.solve(controller.problem, certify=True)`.")
      .def_prop_ro(
          "command", [](const Self& self) { return self->record().command; }, "of the last tick")
      .def_prop_ro("timing", &Self::timing, "of the last tick")
      .def_prop_ro(
          "level_names", [](const Self& self) { return self->level_names(); },
          "of its stack, highest priority first")
      .def_prop_ro(
          "steps_taken", [](const Self& self) { return self->steps_taken(); }, "so far")
      .def_prop_ro(
          "fault", [](const Self& self) { return self->fault(); },
          "what a part of your own did wrong last; empty if nothing")
      .def_prop_ro("notes", [](const Self& self) { return self->notes(); }, "Lines worth telling.");
  bind_changes(type);
}

}  // namespace surefoot::python
