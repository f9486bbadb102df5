#include "python/plant.hpp"

#include "python/bindings.hpp"
#include "python/interpreter.hpp"
#include "python/joint_command.hpp"
#include "surefoot/base/fields.hpp"
#include "surefoot/base/formatted.hpp"
#include "surefoot/base/nearest_name.hpp"
#include "surefoot/closed_loop/change_log.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace surefoot::python {
namespace {

void check_duration(double duration) {
  if (!(duration > 0.0))
    throw Error(formatted("duration is %g", duration) + "; a number of seconds above 0 is valid");
}

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

/// "imu late (3)", "encoders jump (0.1), LF_KFE, for 0.2 s"
std::string fault_text(const std::string& sensor, const std::string& kind, double duration,
                       double size, const std::string& element) {
  return "sensor fault: " + sensor + " " + kind + (size == 0.0 ? "" : formatted(" (%.3g)", size)) +
         (element.empty() ? "" : ", " + element) +
         (std::isfinite(duration) ? formatted(", for %.3g s", duration) : "");
}

void write(BoundPlant& self, const JointCommand& command) {
  for (Eigen::Index i = 0; i < command.torque.size(); ++i)
    check_finite(command.torque[i], "torque[" + std::to_string(i) + "]");
  self.unlocked([&](simulation::Plant& plant) { plant.write(command); });
  self.changes.end_tick();
}

void fail(BoundPlant& self, const std::string& sensor, const std::string& kind, double duration,
          double size, const std::string& element) {
  check_finite(size, "size");
  check_duration(duration);
  simulation::SensorFault fault;
  fault.num_legs = static_cast<int>(self->truth().feet.size());
  choose("sensor", sensor, fields(fault));
  choose("kind", kind, fields(fault));
  fault.duration = duration;
  fault.size = size;
  using enum simulation::FaultySensor;
  const bool is_of_feet = fault.sensor == foot_force;
  const bool has_elements = is_of_feet || fault.sensor == encoders || fault.sensor == joint_torques;
  if (!element.empty() && !has_elements)
    throw Error("element is " + element + ", and " + sensor +
                " has none; those of encoders, joint_torques and foot_force can fail alone");
  if (!element.empty()) choose(is_of_feet ? "leg" : "joint", element, fields(fault));
  self->fail(fault);
  self.changes.add({.time = self->time(),
                    .kind = "fault",
                    .text = fault_text(sensor, kind, duration, size, element),
                    .stack = {},
                    .duration = duration,
                    .body = {}},
                   0);
}

void push(BoundPlant& self, const std::vector<double>& force, const std::string& body,
          double duration, std::optional<double> time) {
  simulation::Push push{.body = body, .time = time.value_or(self->time()), .duration = duration};
  assign(push.force, force, "force", true);
  check_duration(duration);
  check_finite(duration, "duration");
  check_finite(push.time, "time");
  if (push.time < self->time() - kTimeRounding)
    throw Error(
        formatted("time is %g s, and the plant is at %g s; a time from then on would be "
                  "valid",
                  push.time, self->time()));
  push.time = std::max(push.time, self->time());
  self->push(push);
  if (body.empty()) push.body = self.base();
  self.changes.add(closed_loop::push_change(push), 0);
}

}  // namespace

void bind_plant(nb::module_& module) {
  using Self = BoundPlant;
  nb::class_<Self>(module, "Plant",
                   "The robot's stand-in: MuJoCo with actuators, sensors, terrain and "
                   "disturbances. That of a run's Tick ends with the run.",
                   nb::type_slots(kNoVectorcall))
      .def(nb::init<const config::Scenario&>(), nb::arg("scenario"),
           nb::call_guard<Interpreter::Unlocked>())
      .def("__repr__",
           [](const Self& self) {
             return self.has_ended() ? std::string("<plant of a run that has ended>")
                                     : formatted("<plant after %g s>", self->time());
           })
      .def(
          "read", [](const Self& self) { return self->read(); },
          "Readings at the current time; the first is there before the first write().")
      .def("write", &write, nb::arg("command"),
           "Applies a command and advances the physics by one control period.")
      .def(
          "write",
          [](Self& self, const JointNumbers& torque) { write(self, joint_command(torque)); },
          nb::arg("torque"), "The same for a torque of each joint [N·m].")
      .def_prop_ro(
          "time", [](const Self& self) { return self->time(); }, "since the start of the run [s]")
      .def_prop_ro(
          "truth", [](const Self& self) { return self->truth(); },
          "What really happens, at the current time.")
      .def_prop_ro(
          "notes", [](const Self& self) { return self->notes(); }, "Lines worth telling.")
      .def("push", &push, nb::arg("force"), nb::arg("body") = "", nb::arg("duration") = 0.1,
           nb::arg("time") = nb::none(),
           "Pushes a link of the URDF, by default the base, with a force [N] along the axes of the "
           "ground, from a time on [s], which has not passed; without it from now on.")
      .def_prop_ro(
          "bodies", [](const Self& self) { return self->bodies(); }, "links that can be pushed")
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
      .def(
          "terrain_height",
          [](const Self& self, double x, double y) {
            check_finite(x, "x");
            check_finite(y, "y");
            return self->terrain_height(x, y);
          },
          nb::arg("x"), nb::arg("y"),
          "Height of the terrain under a point [m]; NaN where there is none.")
      .def(
          "model_xml", [](const Self& self) { return self->model_xml(); },
          "The physics model as MJCF text, for MuJoCo's own tools.");
}

}  // namespace surefoot::python
