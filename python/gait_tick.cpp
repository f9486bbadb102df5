// What a gait that is written in Python is given at a tick.

#include "python/bindings.hpp"
#include "python/named_command.hpp"
#include "python/numbers.hpp"
#include "python/own_gait.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/tuple.h>

#include <cmath>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace surefoot::python {

void bind_gait_tick(nb::module_& module) {
  using Self = GaitTick;
  using Place = std::vector<double>;
  const auto place = [](const Place& numbers) {
    Vec3 to;
    assign(to, numbers, "to", true);
    return to;
  };
  const auto duration = [](double seconds, const char* what) {
    if (seconds > 0.0 && std::isfinite(seconds)) return seconds;
    throw Error(std::string(what) + " is " + std::to_string(seconds) +
                "; a time above 0 s would be valid");
  };
  const auto at_least_0 = [](double number, const char* what, const char* kind) {
    if (number >= 0.0 && std::isfinite(number)) return number;
    throw Error(std::string(what) + " is " + std::to_string(number) + "; a " + kind +
                " of at least 0 would be valid");
  };
  nb::class_<Self>(module, "GaitTick", "A tick as a gait sees it, for as long as its method runs.",
                   nb::type_slots(kNoVectorcall))
      .def("__repr__",
           [](const Self& self) {
             return "<gait's tick at " + std::to_string(self.now().time) + " s>";
           })
      .def_prop_ro(
          "time", [](const Self& self) { return self.now().time; }, "[s]")
      .def_prop_ro(
          "yaw", [](const Self& self) { return self.now().yaw; },
          "reference of the torso's heading [rad]")
      .def_prop_ro(
          "user", [](const Self& self) { return NamedCommand(self.now().user); },
          "the command, within what the legs can follow")
      .def_prop_ro(
          "state", [](const Self& self) { return self.now().state; }, "as believed")
      .def_prop_ro("dynamics", &Self::dynamics, "the robot at `state`")
      .def_prop_ro(
          "before", [](const Self& self) { return self.now().before; }, "the plan a tick ago")
      .def_prop_ro(
          "com", [](const Self& self) { return self.body().com.at(self.now().time); },
          "the library's plan of the centre of mass, now: of the last plan_com(), or to rest over "
          "the feet")
      .def_prop_ro(
          "all_down", [](const Self& self) { return self.body().legs.all_down(); },
          "do all feet stand?")
      .def_prop_ro(
          "yields", [](const Self& self) { return self.now().yields; },
          "does another gait wait for all feet down?")
      .def(
          "is_down",
          [](const Self& self, const std::string& leg) {
            return self.body().legs[self.leg(leg)].down();
          },
          nb::arg("leg"), "Does the foot stand?")
      .def(
          "is_unloaded",
          [](const Self& self, const std::string& leg) {
            return self.body().legs[self.leg(leg)].unloaded();
          },
          nb::arg("leg"), "Does the foot bear so little that it can lift off?")
      .def(
          "foothold",
          [at_least_0](const Self& self, const std::string& leg, double cycle) {
            const gaits::Body& body = self.body();
            Vec3 at = body.footholds.foothold(self.leg(leg), body.legs.footholds(), body.plane,
                                              self.now().yaw, self.now().user,
                                              at_least_0(cycle, "cycle", "time [s]"));
            return nb::module_::import_("numpy").attr("array")(view(at, nb::handle()));
          },
          nb::arg("leg"), nb::arg("cycle"),
          nb::sig("def foothold(self, leg: str, cycle: float) -> "
                  "numpy.typing.NDArray[numpy.float64]"),
          "Where the leg's next step goes in W [m], with a step of it every `cycle` seconds.")
      .def(
          "plan_com",
          [place, duration](
              const Self& self,
              const std::vector<std::tuple<std::string, double, double, Place>>& steps) {
            const Self::Parts& parts = self.changing();
            std::vector<StepAhead> ahead;
            double time = self.now().time;
            for (const auto& [leg, support, swing, to] : steps) {
              time += duration(support, "support");
              ahead.push_back({self.leg(leg), time, duration(swing, "swing"), place(to)});
              time += swing;
            }
            parts.gait->plan_com(std::move(ahead), *parts.changed, *parts.changed_body);
          },
          nb::arg("steps"),
          nb::sig("def plan_com(self, steps: typing.Sequence[tuple[str, float, float, "
                  "numpy.typing.ArrayLike]]) -> None"),
          "Plans `com` for steps ahead, each (leg, support, swing, to): after `support` seconds "
          "the "
          "leg lifts off, and lands\non `to` in W [m] after `swing` seconds. At most 4 steps, or "
          "fewer with legs in the air.")
      .def(
          "unload",
          [](const Self& self, const std::string& leg, double lift_off) {
            const Self::Parts& parts = self.changing();
            check_finite(lift_off, "lift_off");
            parts.gait->unload(self.standing_leg(leg), lift_off, *parts.changed_body);
          },
          nb::arg("leg"), nb::arg("lift_off"),
          "Takes the load off a foot that stands until the time of its lift-off [s].")
      .def(
          "lift",
          [place, duration, at_least_0](const Self& self, const std::string& leg, const Place& to,
                                        double seconds, const std::optional<double>& apex) {
            const Self::Parts& parts = self.changing();
            const double rise =
                at_least_0(apex.value_or(self.body().options.swing.apex), "apex", "height [m]");
            parts.gait->lift(self.standing_leg(leg), place(to), duration(seconds, "duration"), rise,
                             *parts.changed, *parts.changed_body);
          },
          nb::arg("leg"), nb::arg("to"), nb::arg("duration"), nb::arg("apex") = nb::none(),
          "Begins a swing to a place in W [m], of a foot that stands; others may be in the air, "
          "and collisions and catches are counted for all together. It\nends at the first contact; "
          "without one the foot goes on down.");
}

}  // namespace surefoot::python
