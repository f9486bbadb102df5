#include "python/bindings.hpp"
#include "python/named_command.hpp"
#include "python/numbers.hpp"
#include "python/own_parts.hpp"
#include "python/robot.hpp"
#include "surefoot/config/data_file.hpp"
#include "surefoot/config/scenario_file.hpp"

#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/vector.h>

#include <memory>
#include <string>
#include <vector>

namespace surefoot::python {
namespace {

std::vector<std::string> joint_names(const config::Scenario& scenario) {
  return scenario.robot.joint_names();
}

std::vector<std::string> arm_names(const config::Scenario& scenario) {
  std::vector<std::string> names;
  for (const model::ArmDescription& arm : scenario.robot.arms) names.push_back(arm.name);
  return names;
}

nb::typed<nb::dict, std::string, double> drawn(const config::Scenario& scenario) {
  nb::typed<nb::dict, std::string, double> values;
  for (const config::RandomDraw& draw : scenario.drawn) values[nb::cast(draw.path)] = draw.value;
  return values;
}

config::Scenario load(const std::string& name, const nb::int_& seed,
                      const std::vector<std::string>& assignments, const nb::list& own,
                      const nb::dict& gaits) {
  const auto robot = std::make_shared<std::shared_ptr<Robot>>();
  config::Scenario scenario =
      config::load_scenario({.name_or_path = name,
                             .seed = config::parse_seed(nb::str(seed).c_str()),
                             .assignments = assignments,
                             .own_tasks = own_tasks(own),
                             .own_gaits = own_gaits(gaits, robot)});
  if (gaits.size() > 0) *robot = std::make_shared<Robot>(scenario.robot);
  return scenario;
}

nb::typed<nb::dict, std::string, std::string> scenarios() {
  nb::typed<nb::dict, std::string, std::string> titles;
  for (const std::string& name : config::list_data("scenarios")) {
    titles[nb::cast(name)] = nb::cast(config::describe_data("scenarios", name));
  }
  return titles;
}

}  // namespace

void bind_scenario(nb::module_& module) {
  nb::class_<config::Scenario>(module, "Scenario",
                               "An experiment, complete: everything that a run is made from.",
                               nb::type_slots(kNoVectorcall), nb::is_weak_referenceable())
      .def("__repr__",
           [](const config::Scenario& self) {
             return "<scenario " + self.name + " of " + self.robot.name + ", seed " +
                    std::to_string(self.seed) + ">";
           })
      .def("__copy__", [](nb::handle_t<config::Scenario> self) { return self; })
      .def("__deepcopy__", [](nb::handle_t<config::Scenario> self, nb::handle) { return self; })
      .def_ro("name", &config::Scenario::name, "of its file")
      .def_ro("description", &config::Scenario::description, "what it shows")
      .def_ro("file", &config::Scenario::file, "that it was read from")
      .def_ro("seed", &config::Scenario::seed, "0: the nominal run")
      .def_ro("duration", &config::Scenario::duration, "longest [s]")
      .def_prop_ro(
          "period", [](const config::Scenario& self) { return self.controller.period; },
          "of the control loop [s]")
      .def_prop_ro(
          "robot", [](const config::Scenario& self) { return self.robot.name; }, "its name")
      .def_prop_ro(
          "robot_model",
          [](const config::Scenario& self) { return std::make_shared<Robot>(self.robot); },
          "its robot, with its dynamics")
      .def_prop_ro(
          "estimation", [](const config::Scenario& self) { return name(self.estimation); },
          "where the controller's state comes from")
      .def_prop_ro("joint_names", &joint_names,
                   "in the order of every array of joints: HAA, HFE, KFE of each leg, then further "
                   "ones, then arms")
      .def_prop_ro(
          "gaits",
          [](const config::Scenario& self) {
            std::vector<std::string> names;
            for (const gaits::NamedGait& gait : self.controller.gaits) names.push_back(gait.name);
            return names;
          },
          "names of those that a command may change to, for UserCommand.gait")
      .def_prop_ro("arms", &arm_names, "their names; ReachCommand.arm counts them from 0")
      .def_prop_ro(
          "torque_limit",
          [](nb::handle_t<config::Scenario> self) {
            const JointVector& limit = nb::inst_ptr<config::Scenario>(self)->robot.torque_limit;
            return nb::ndarray<nb::numpy, const double, nb::shape<-1>>(
                limit.data(), {static_cast<std::size_t>(limit.size())}, self);
          },
          "|torque| ≤ limit [N·m], shape (number of joints,)")
      .def_prop_ro("drawn", &drawn, "what the seed chose: path → value")
      .def_ro("options_json", &config::Scenario::options_json,
              "the whole scenario as it was read, assignments and draws included")
      .def(
          "user",
          [](const config::Scenario& self, double time) {
            check_finite(time, "time");
            return NamedCommand(self.user(time));
          },
          nb::arg("time"), "The operator's command at a time [s].");

  module.def(
      "read_scenario", &load, nb::arg("name"), nb::arg("seed") = 0,
      nb::arg("set") = std::vector<std::string>(), nb::arg("own") = nb::list(),
      nb::arg("gaits") = nb::dict(),
      nb::sig("def read_scenario(name: str, seed: int = 0, set: typing.Sequence[str] = (), own: "
              "list[typing.Any] = [], gaits: dict[str, typing.Callable[[], Gait]] = {}) -> "
              "Scenario"),
      "Reads a scenario, by its name or as a path that ends in .yaml.\n\n"
      "seed: 0 is the nominal run; any other draws what `randomise:` lists.\n"
      "set: \"path.to.key=value\", laid over the file.\n"
      "Raises Error, naming file, line and key, on everything that is unknown or out of range.");
  module.def("scenarios", &scenarios, "The scenarios that there are: name → what it shows.");
}

}  // namespace surefoot::python
