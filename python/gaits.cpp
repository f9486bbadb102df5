// Gaits that are written in Python.

#include "python/bindings.hpp"
#include "python/dynamics.hpp"
#include "python/in_python.hpp"
#include "python/named_command.hpp"
#include "python/numbers.hpp"
#include "python/parts.hpp"
#include "surefoot/gaits/com_horizon.hpp"
#include "surefoot/gaits/gait.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/tuple.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace surefoot::python {
namespace {

using gaits::Body;
using gaits::GaitOutcome;
using gaits::Situation;

/// `Gait` in Python.
struct BoundGait {};

/// A step that the centre of mass prepares for: the leg lifts off at `lift_off` [s], and lands on
/// `to` after `swing` [s].
struct StepAhead {
  Leg leg;
  double lift_off, swing;
  Vec3 to;
};

class PythonGait final : public gaits::Gait {
 public:
  PythonGait(SharedObject object, std::shared_ptr<Robot> robot)
      : object_(std::move(object)), robot_(std::move(robot)) {}

  void restart() override {
    forget_steps();
    in_python([&] { (*object_).attr("restart")(); });
  }
  void begin(Situation& now, Body& body, const std::optional<gaits::Action>& first) override;
  bool waits(const Body&) const override {
    return in_python([&] { return truth_of("waits", (*object_).attr("waits")()); });
  }
  double height() const override { return number_of("height", "a number [m]"); }
  double stride_duration(double) const override {
    return number_of("stride_duration", "a time [s]");
  }
  bool is_static() const override {
    return in_python([&] { return truth_of("is_static", (*object_).attr("is_static")()); });
  }
  double speed() const override { return number_of("speed", "a speed [m/s]"); }
  Motion<double> bounce() const override;
  ComPlan com(const Situation& now, const Body& body) const override;

  // For GaitTick.
  void lift(Leg leg, const Vec3& to, double duration, double apex, Situation& now, Body& body) {
    swings_ = leg;
    begins_step_ = true;
    unloads_.reset();
    std::erase_if(steps_, [&](const StepAhead& step) { return step.leg == leg; });
    lands_at_ = now.time + duration;
    act({.events = now.event_list(PlanEvent::lift_off, leg),
         .swing = gaits::SwingOrder{leg,
                                    {.start = now.foot(leg),
                                     .goal = to,
                                     .normal = body.plane.normal,
                                     .duration = duration,
                                     .apex = apex}}},
        now, body);
  }
  void unload(Leg leg, double lift_off, Body& body) {
    unloads_ = leg;
    body.legs[leg].unload(lift_off);
  }
  /// What is planned again, as after a touchdown, has these steps ahead, too.
  void plan_com(std::vector<StepAhead> steps, const Situation& now, Body& body) {
    steps_ = std::move(steps);
    plan_com(now, body);
  }

 private:
  [[nodiscard]] double number_of(const char* method, const char* valid) const {
    return in_python([&] {
      const nb::object given = (*object_).attr(method)();
      double number = kNaN;
      if (nb::try_cast<double>(given, number) && std::isfinite(number)) return number;
      throw Error(wrong_result(*object_, method, given, valid));
    });
  }
  [[nodiscard]] bool truth_of(const char* method, nb::handle given) const {
    bool is_true = false;
    if (nb::try_cast<bool>(given, is_true)) return is_true;
    throw Error(wrong_result(*object_, method, given, "True or False"));
  }

  void forget_steps() {
    begins_step_ = false;
    swings_.reset();
    unloads_.reset();
    steps_.clear();
  }
  gaits::GaitStatus status(const Body&) const override {
    return {.swings = swings_, .unloads = unloads_, .lands_at = lands_at_};
  }
  void follow(const gaits::Action& action, const Situation&, Body& body) override {
    if (unloads_ && action.reloads == unloads_) unloads_.reset();
    if (!swings_ || action.lands != swings_) return;
    swings_.reset();
    ++body.steps_taken;
  }
  void plan_com(const Situation& now, Body& body) override;
  GaitOutcome go_on(Situation& now, Body& body) override;

  SharedObject object_;
  std::shared_ptr<Robot> robot_;
  std::optional<Leg> swings_, unloads_;
  double lands_at_ = gaits::kNever;  // the swing leg [s]
  std::vector<StepAhead> steps_;
  bool begins_step_ = false;  // at this tick
};

/// What a gait is given at a tick, for as long as its method runs; `GaitTick` in Python.
class GaitTick {
 public:
  /// Null where the gait may only look.
  struct Parts {
    const Situation* now;
    const Body* body;
    Situation* changed = nullptr;
    Body* changed_body = nullptr;
    PythonGait* gait = nullptr;
  };
  GaitTick(const Parts& parts, std::shared_ptr<Robot> robot)
      : parts_(std::make_shared<Parts>(parts)), robot_(std::move(robot)) {}
  void end() { *parts_ = {}; }

  [[nodiscard]] const Situation& now() const { return *live().now; }
  [[nodiscard]] const Body& body() const { return *live().body; }
  [[nodiscard]] NamedDynamics dynamics() const { return {robot_, now().dynamics}; }
  /// Throws Error outside of begin() and go_on().
  [[nodiscard]] const Parts& changing() const {
    if (live().gait != nullptr) return *parts_;
    throw Error("the legs are moved in begin() and go_on() only");
  }
  [[nodiscard]] Leg leg(const std::string& name) const {
    for (const Leg each : body().legs.all())
      if (leg_name(each, now().num_legs()) == name) return each;
    throw UnknownNameError("no leg \"" + name + "\"; before.feet has their names");
  }

 private:
  [[nodiscard]] const Parts& live() const {
    if (parts_->now != nullptr) return *parts_;
    throw Error("this tick is over; take what you need of it while the gait's method runs");
  }

  std::shared_ptr<Parts> parts_;
  std::shared_ptr<Robot> robot_;
};

/// Calls a method of the user's with a tick that ends with it.
template <typename Use>
auto with_tick(const SharedObject& object, const char* method, GaitTick tick, const Use& use) {
  return in_python([&] {
    const struct End {
      GaitTick& tick;
      ~End() { tick.end(); }
    } at_end{tick};
    return use((*object).attr(method)(tick));
  });
}

void PythonGait::begin(Situation& now, Body& body, const std::optional<gaits::Action>& first) {
  forget_steps();
  plan_com(now, body);
  if (first) act(*first, now, body);
  with_tick(object_, "begin", {{&now, &body, &now, &body, this}, robot_}, [](const nb::object&) {});
}

/// Feet in the air land where they are aimed at; then come the steps ahead, and rest.
void PythonGait::plan_com(const Situation& now, Body& body) {
  gaits::ComHorizon ahead(now, false);
  double time = now.time;
  const auto pass_until = [&](double until) {
    const double duration = std::max(until - time, body.period);
    time += duration;
    return duration;
  };
  if (swings_) ahead.add(pass_until(lands_at_), true);
  for (const Leg k : body.legs.all())
    if (!ahead.is_down(k)) ahead.land(k, swings_ == k ? body.legs[k].target().goal : now.foot(k));
  for (const StepAhead& step : steps_) {
    ahead.add_support_until_lift_off(step.leg, pass_until(step.lift_off));
    ahead.add(pass_until(time + step.swing), true);
    ahead.land(step.leg, step.to);
  }
  ahead.come_to_rest(body);
}

GaitOutcome PythonGait::go_on(Situation& now, Body& body) {
  return with_tick(object_, "go_on", {{&now, &body, &now, &body, this}, robot_},
                   [&](const nb::object& given) {
                     const bool hands_over = truth_of("go_on", given);
                     if (hands_over && !body.legs.all_down())
                       throw Error("go_on() hands over with a foot in the air");
                     return GaitOutcome{.hands_over = hands_over,
                                        .begins_step = std::exchange(begins_step_, false)};
                   });
}

Motion<double> PythonGait::bounce() const {
  return in_python([&] {
    const nb::object given = (*object_).attr("bounce")();
    std::vector<double> numbers;
    if (nb::try_cast(given, numbers) && numbers.size() == 3 &&
        std::ranges::all_of(numbers, [](double number) { return std::isfinite(number); }))
      return Motion<double>{numbers[0], numbers[1], numbers[2]};
    throw Error(
        wrong_result(*object_, "bounce", given, "(height, velocity, acceleration) [m, m/s, m/s²]"));
  });
}

ComPlan PythonGait::com(const Situation& now, const Body& body) const {
  return with_tick(object_, "com", {{&now, &body}, robot_}, [&](const nb::object& given) {
    const ComPlan& plan = result_of<ComPlan>(*object_, "com", "ComPlan", given);
    if (plan.p.allFinite() && plan.v.allFinite() && plan.a.allFinite()) return plan;
    throw Error("com() gave NaN or infinity");
  });
}

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
          [](const Self& self, const std::string& leg, double cycle) {
            const Body& body = self.body();
            Vec3 at = body.footholds.foothold(self.leg(leg), body.legs.footholds(), body.plane,
                                              self.now().yaw, self.now().user, cycle);
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
          "leg lifts off, and lands\non `to` in W [m] after `swing` seconds.")
      .def(
          "unload",
          [](const Self& self, const std::string& leg, double lift_off) {
            const Self::Parts& parts = self.changing();
            check_finite(lift_off, "lift_off");
            parts.gait->unload(self.leg(leg), lift_off, *parts.changed_body);
          },
          nb::arg("leg"), nb::arg("lift_off"),
          "Takes the load off a foot until the time of its lift-off [s].")
      .def(
          "lift",
          [place, duration](const Self& self, const std::string& leg, const Place& to,
                            double seconds, const std::optional<double>& apex) {
            const Self::Parts& parts = self.changing();
            const double rise = apex.value_or(self.body().options.swing.apex);
            check_finite(rise, "apex");
            parts.gait->lift(self.leg(leg), place(to), duration(seconds, "duration"), rise,
                             *parts.changed, *parts.changed_body);
          },
          nb::arg("leg"), nb::arg("to"), nb::arg("duration"), nb::arg("apex") = nb::none(),
          "Begins a swing to a place in W [m]. It ends at the first contact; without one the foot "
          "goes on down.");
}

void bind_gait(nb::module_& module) {
  using Self = BoundGait;
  nb::class_<Self>(
      module, "Gait",
      "A gait of your own within the library's planner, beside its gaits: load_scenario(…, "
      "gaits={\"mine\": Mine}). As it is,\nit stands. What it raises makes the controller hold its "
      "posture, then sit down.",
      nb::type_slots(kNoVectorcall))
      .def(nb::init<>())
      .def(
          "begin", [](const Self&, const GaitTick&) {}, nb::arg("now"),
          "It becomes the active gait, with all feet down.")
      .def(
          "go_on",
          [](const Self&, const GaitTick& now) {
            return now.body().legs.all_down() && (!now.now().user.walk || now.now().yields);
          },
          nb::arg("now"),
          "A tick of the active gait; True hands over to another gait. Unless you write it, that "
          "is "
          "when the command says\nso and all feet are down.")
      .def(
          "com", [](const Self&, const GaitTick& now) { return now.body().com.at(now.now().time); },
          nb::arg("now"), "Reference of the centre of mass at this tick: `now.com`.")
      .def(
          "waits", [](const Self&) { return true; }, "Does the heading keep still?")
      .def(
          "height", [](const Self&) { return 0.0; }, "Of the torso over the stance's [m].")
      .def(
          "stride_duration", [](const Self&) { return 0.0; },
          "Between two steps of a leg [s]: commands are slowed down to strides that legs can make; "
          "0: "
          "they are not.")
      .def(
          "is_static", [](const Self&) { return true; },
          "Can the robot stop at any moment? Then it leans against pushes, and is slower for them; "
          "else a command to stop\nslows it down step by step.")
      .def(
          "speed", [](const Self&) { return 0.0; },
          "Of the torso's reference [m/s]: another gait waits until it is as slow as both gaits "
          "allow.")
      .def(
          "bounce", [](const Self&) { return std::make_tuple(0.0, 0.0, 0.0); },
          nb::sig("def bounce(self) -> tuple[float, float, float]"),
          "How the torso goes up and down in a cycle: height, velocity, acceleration [m, m/s, "
          "m/s²].")
      .def(
          "restart", [](const Self&) {},
          "Forgets everything: the robot may stand elsewhere. The gait is not active.");
}

}  // namespace

gaits::OwnGaits own_gaits(const nb::dict& makers, std::shared_ptr<std::shared_ptr<Robot>> robot) {
  gaits::OwnGaits own;
  for (const auto& [key, value] : makers) {
    const auto name = nb::cast<std::string>(key);
    if (PyCallable_Check(value.ptr()) == 0)
      throw Error(
          "gaits has \"" + name + "\": " + text_of(nb::repr(value)) +
          "; a class derived from surefoot.Gait, or a function that makes one, would be valid");
    const SharedObject make(nb::borrow<nb::object>(value));
    own.add(
        name,
        [=](const gaits::PlannerOptions&, double, const Scale&) -> std::unique_ptr<gaits::Gait> {
          return in_python([&]() -> std::unique_ptr<gaits::Gait> {
            nb::object gait = (*make)();
            if (nb::isinstance<BoundGait>(gait))
              return std::make_unique<PythonGait>(SharedObject(std::move(gait)), *robot);
            throw Error("gait \"" + name + "\" is made as " + text_of(nb::repr(gait)) +
                        "; an object of a class derived from surefoot.Gait would be valid");
          });
        });
  }
  return own;
}

void bind_gaits(nb::module_& module) {
  bind_gait_tick(module);
  bind_gait(module);
}

}  // namespace surefoot::python
