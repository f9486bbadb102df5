#include "surefoot/simulation/plant.hpp"

#include "python/bindings.hpp"
#include "python/joint_command.hpp"
#include "surefoot/base/fields.hpp"
#include "surefoot/base/nearest_name.hpp"
#include "surefoot/config/scenario.hpp"

#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace surefoot::python {
namespace {

/// Sets a choice of an option by its name.
void choose(const std::string& key, const std::string& word, Group group) {
  for (Field& field : group.fields) {
    if (field.key != key) continue;
    Choice& choice = std::get<Choice>(field.value);
    const auto found = std::ranges::find(choice.names, word);
    if (found == choice.names.end()) {
      throw UnknownNameError(key + " is \"" + word + "\"; " + valid_names(word, choice.names));
    }
    choice.set(static_cast<std::size_t>(found - choice.names.begin()));
  }
}

void fail(simulation::Plant& plant, const std::string& sensor, const std::string& kind,
          double duration, double size, const std::string& element) {
  simulation::SensorFault fault;
  fault.num_legs = static_cast<int>(plant.truth().feet.size());
  choose("sensor", sensor, fields(fault));
  choose("kind", kind, fields(fault));
  fault.duration = duration;
  fault.size = size;
  const bool is_of_feet = fault.sensor == simulation::FaultySensor::foot_force;
  if (!element.empty()) choose(is_of_feet ? "leg" : "joint", element, fields(fault));
  plant.fail(fault);
}

void push(simulation::Plant& plant, const std::array<double, 3>& force, const std::string& body,
          double duration, std::optional<double> time) {
  for (const double component : force) check_finite(component, "force");
  if (!(duration > 0.0))
    throw Error("duration is " + std::to_string(duration) +
                "; a number of seconds above 0 is valid");
  plant.push({.body = body,
              .time = time.value_or(plant.time()),
              .duration = duration,
              .force = Vec3(force.data())});
}

}  // namespace

void bind_plant(nb::module_& module) {
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
      .def("push", &push, nb::arg("force"), nb::arg("body") = "", nb::arg("duration") = 0.1,
           nb::arg("time") = nb::none(),
           "Pushes a link of the URDF, by default the base, with a force [N] along the axes of the "
           "ground, from a time on [s]; without it from now on.")
      .def_prop_ro("bodies", &simulation::Plant::bodies, "links that can be pushed")
      .def("fail", &fail, nb::arg("sensor"), nb::arg("kind") = "stops",
           nb::arg("duration") = kInfinity, nb::arg("size") = 0.0, nb::arg("element") = "",
           nb::sig(
               "def fail(self, sensor: str, kind: str = 'stops', duration: float = float('inf'), "
               "size: float = 0.0, element: str = '') -> None"),
           "Lets a sensor fail from now on.\n\n"
           "sensor: imu, gyro, accelerometer, encoders, joint_torques or foot_force.\n"
           "kind: stops, repeats, nan, jump, late, spike or scaled; jump and spike are off by "
           "`size`, "
           "late samples come\n`size` ticks later, scaled ones are multiplied by `size`.\n"
           "element: a joint, as LF_KFE, or the leg of a foot sensor; without it all.")
      .def("terrain_height", &simulation::Plant::terrain_height, nb::arg("x"), nb::arg("y"),
           "Height of the terrain under a point [m]; NaN where there is none.")
      .def("model_xml", &simulation::Plant::model_xml,
           "The physics model as MJCF text, for MuJoCo's own tools.");
}

}  // namespace surefoot::python
