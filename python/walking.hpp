#pragma once

#include "python/level_outcome.hpp"
#include "python/signals.hpp"
#include "surefoot/config/data_file.hpp"
#include "surefoot/config/scenario_file.hpp"
#include "surefoot/control/controller.hpp"
#include "surefoot/evaluation/alignment.hpp"
#include "surefoot/runtime/stage_timer.hpp"
#include "surefoot/simulation/make_estimator.hpp"
#include "surefoot/simulation/plant.hpp"

#include <nanobind/stl/vector.h>

#include <cstdint>
#include <string>
#include <vector>

namespace surefoot::python {

/// A scenario's controller with its estimator, and the time that its stages take.
class TimedController {
 public:
  TimedController(const config::Scenario& scenario, const simulation::Plant& plant)
      : controller(scenario.robot, scenario.controller,
                   simulation::make_estimator(
                       scenario.estimation,
                       {scenario.robot, scenario.controller.period, plant, scenario.estimator})) {
    controller.set_stage_observer(&timer);
  }

  runtime::StageTimer timer;
  control::Controller controller;
};

inline std::vector<std::string> joint_names(const config::Scenario& scenario) {
  return scenario.robot.joint_names();
}

inline std::vector<std::string> arm_names(const config::Scenario& scenario) {
  std::vector<std::string> names;
  for (const model::ArmDescription& arm : scenario.robot.arms) names.push_back(arm.name);
  return names;
}

inline nb::typed<nb::dict, std::string, double> drawn(const config::Scenario& scenario) {
  nb::typed<nb::dict, std::string, double> values;
  for (const config::RandomDraw& draw : scenario.drawn) values[nb::cast(draw.path)] = draw.value;
  return values;
}

inline config::Scenario load(const std::string& name, const nb::int_& seed,
                             const std::vector<std::string>& assignments) {
  return config::load_scenario({.name_or_path = name,
                                .seed = config::parse_seed(nb::str(seed).c_str()),
                                .assignments = assignments});
}

inline nb::typed<nb::dict, std::string, std::string> scenarios() {
  nb::typed<nb::dict, std::string, std::string> titles;
  for (const std::string& name : config::list_data("scenarios")) {
    titles[nb::cast(name)] = nb::cast(config::describe_data("scenarios", name));
  }
  return titles;
}

inline void bind_scenario(nb::module_& module) {
  nb::class_<config::Scenario>(module, "Scenario",
                               "An experiment, complete: everything that a run is made from.")
      .def("__repr__",
           [](const config::Scenario& self) {
             return "<scenario " + self.name + " of " + self.robot.name + ", seed " +
                    std::to_string(self.seed) + ">";
           })
      .def_ro("name", &config::Scenario::name)
      .def_ro("description", &config::Scenario::description, "what it shows")
      .def_ro("file", &config::Scenario::file, "that it was read from")
      .def_ro("seed", &config::Scenario::seed)
      .def_ro("duration", &config::Scenario::duration, "longest [s]")
      .def_prop_ro(
          "period", [](const config::Scenario& self) { return self.controller.period; },
          "of the control loop [s]")
      .def_prop_ro("robot", [](const config::Scenario& self) { return self.robot.name; })
      .def_prop_ro(
          "estimation", [](const config::Scenario& self) { return name(self.estimation); },
          "where the controller's state comes from")
      .def_prop_ro("joint_names", &joint_names,
                   "in the order of every array of joints: HAA, HFE, KFE of each leg, then arms")
      .def_prop_ro(
          "gaits",
          [](const config::Scenario& self) {
            std::vector<std::string> names;
            for (const gaits::NamedGait& gait : self.controller.gaits) names.push_back(gait.name);
            return names;
          },
          "names of those that a command may change to; UserCommand.gait counts them from 0")
      .def_prop_ro("arms", &arm_names, "their names; ReachCommand.arm counts them from 0")
      .def_prop_ro(
          "torque_limit",
          [](nb::handle_t<config::Scenario> self) {
            JointVector& limit = nb::inst_ptr<config::Scenario>(self)->robot.torque_limit;
            return View<-1>(limit.data(), {static_cast<std::size_t>(limit.size())}, self);
          },
          "|torque| ≤ limit [N·m], shape (number of joints,)")
      .def_prop_ro("drawn", &drawn, "what the seed chose: path → value")
      .def_ro("options_json", &config::Scenario::options_json,
              "the whole scenario as it was read, assignments and draws included")
      .def("user", &config::Scenario::user, nb::arg("time"), nb::rv_policy::copy,
           "The operator's command at a time [s].");

  module.def(
      "load_scenario", &load, nb::arg("name"), nb::arg("seed") = 0,
      nb::arg("set") = std::vector<std::string>(),
      "Reads a scenario, by its name or as a path that ends in .yaml.\n\n"
      "seed: 0 is the nominal run; any other draws what `randomise:` lists.\n"
      "set: \"path.to.key=value\", laid over the file.\n"
      "Raises Error, naming file, line and key, on everything that is unknown or out of range.");
  module.def("scenarios", &scenarios, "The scenarios that there are: name → what it shows.");
}

inline void bind_plant(nb::module_& module) {
  nb::class_<simulation::Plant>(
      module, "Plant",
      "The robot's stand-in: MuJoCo with actuators, sensors, terrain and disturbances.")
      .def(
          "__init__",
          [](simulation::Plant* self, const config::Scenario& scenario) {
            new (self) simulation::Plant(scenario.robot, scenario.plant);
          },
          nb::arg("scenario"), nb::call_guard<nb::gil_scoped_release>())
      .def("__repr__",
           [](const simulation::Plant& self) {
             return "<plant after " + std::to_string(self.time()) + " s>";
           })
      .def("read", &simulation::Plant::read, nb::rv_policy::copy,
           "Readings at the current time; the first is there before the first write().")
      .def("write", &simulation::Plant::write, nb::arg("command"),
           nb::call_guard<nb::gil_scoped_release>(),
           "Applies a command and advances the physics by one control period.")
      .def(
          "write",
          [](simulation::Plant& self, const JointNumbers& torque) {
            self.write(joint_command(torque));
          },
          nb::arg("torque"), nb::call_guard<nb::gil_scoped_release>(),
          "The same for a torque of each joint [N·m].")
      .def_prop_ro("time", &simulation::Plant::time, "since the start of the run [s]")
      .def_prop_ro("truth", &simulation::Plant::truth, nb::rv_policy::copy,
                   "What really happens, at the current time.")
      .def_prop_ro("notes", &simulation::Plant::notes, nb::rv_policy::copy, "Lines worth telling.")
      .def("terrain_height", &simulation::Plant::terrain_height, nb::arg("x"), nb::arg("y"),
           "Height of the terrain under a point [m]; NaN where there is none.")
      .def("model_xml", &simulation::Plant::model_xml,
           "The physics model as MJCF text, for MuJoCo's own tools.");
}

/// Call after bind_controller.
inline void bind_aligner(nb::module_& module) {
  nb::class_<evaluation::Aligner>(
      module, "Aligner",
      "Compares a plant's truth, in S, with its controller's plan and estimate, in W. The two\n"
      "worlds lie elsewhere and drift apart: never subtract their numbers.")
      .def(nb::init<>())
      .def(
          "update",
          [](evaluation::Aligner& self, const simulation::Plant& plant, const TimedController& of) {
            return self.update(plant.truth(), of.controller.record());
          },
          nb::arg("plant"), nb::arg("controller"),
          "The alignment and its errors after a tick: call it at every tick, from the first on,\n"
          "between controller.step() and plant.write().");
}

inline void bind_controller(nb::module_& module) {
  using Self = TimedController;
  nb::class_<Self>(
      module, "Controller",
      "The whole-body controller of a scenario: one step() a tick turns readings into torques.\n\n"
      "Its state comes from where the scenario's `estimation` says; the plant must be the one that "
      "the readings come from.")
      .def(nb::init<const config::Scenario&, const simulation::Plant&>(), nb::arg("scenario"),
           nb::arg("plant"), nb::keep_alive<1, 3>())
      .def(
          "step",
          [](Self& self, const SensorReading& reading, const UserCommand& user) {
            return self.controller.step(reading, user);
          },
          nb::arg("reading"), nb::arg("user"), nb::call_guard<nb::gil_scoped_release>(),
          "One tick. Always gives finite torques inside the limits, and never raises.")
      .def("__repr__",
           [](const Self& self) {
             return "<controller of " + std::to_string(self.controller.level_names().size()) +
                    " levels, after " + std::to_string(self.controller.steps_taken()) + " steps>";
           })
      .def(
          "levels", [](const Self& self) { return outcomes(self.controller); },
          "The hierarchy at the last tick, highest priority first.")
      .def_prop_ro(
          "state", [](const Self& self) { return self.controller.record().state; },
          "as believed at the last tick")
      .def_prop_ro(
          "health", [](const Self& self) { return self.controller.record().health; },
          "of the sensors at the last tick: what is wrong, and for how long")
      .def_prop_ro(
          "plan", [](const Self& self) { return self.controller.record().plan; },
          "of the last tick")
      .def_prop_ro(
          "model", [](const Self& self) { return self.controller.record().model; },
          "centre of mass, feet and contact forces at the last tick")
      .def_prop_ro(
          "timing", [](const Self& self) { return self.timer.timing(); }, "of the last tick")
      .def_prop_ro("level_names", [](const Self& self) { return self.controller.level_names(); })
      .def_prop_ro("steps_taken", [](const Self& self) { return self.controller.steps_taken(); })
      .def_prop_ro(
          "notes", [](const Self& self) { return self.controller.notes(); },
          "Lines worth telling.");
}

inline void bind_walking(nb::module_& module) {
  bind_scenario(module);
  bind_plant(module);
  bind_controller(module);
  bind_aligner(module);
}

}  // namespace surefoot::python
