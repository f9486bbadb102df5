#include "python/own_gait.hpp"

#include "python/bindings.hpp"
#include "surefoot/gaits/com_horizon.hpp"

#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
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

/// Of the legs but one that are about to lift off.
std::optional<Leg> first_unloading(const Body& body, std::optional<Leg> but) {
  for (const Leg k : body.legs.all())
    if (k != but && body.legs[k].phase() == LegPhase::unloading) return k;
  return {};
}

}  // namespace

Leg GaitTick::standing_leg(const std::string& name) const {
  const Leg found = leg(name);
  if (body().legs[found].down()) return found;
  std::string others;
  for (const Leg each : body().legs.all())
    if (body().legs[each].down())
      others += (others.empty() ? "" : ", ") + std::string(leg_name(each, now().num_legs()));
  throw Error(name + " is in the air; a leg that stands would be valid: " +
              (others.empty() ? "there is none" : others));
}

void PythonGait::begin(Situation& now, Body& body, const std::optional<gaits::Action>& first) {
  forget_steps();
  plan_com(now, body);
  if (first) act(*first, now, body);
  with_tick(object_, "begin", {{&now, &body, &now, &body, this}, robot_}, [](const nb::object&) {});
}

gaits::GaitStatus PythonGait::status(const Body& body) const {
  gaits::GaitStatus result;
  if (!swings_.empty()) {
    result.swings = swings_.back().leg;
    result.lands_at = swings_.back().lands_at;
  }
  result.unloads = first_unloading(body, {});
  return result;
}

/// The library's reactions know one leg in the air, and one that is about to lift off: the leg of
/// the event, and another one. What a loss asks of these holds for all.
std::optional<gaits::Action> PythonGait::answer(gaits::LegEvent event, const Situation& now,
                                                Leg leg) const {
  Situation of_leg = now;
  if (swings(leg)) of_leg.gait.swings = leg;
  of_leg.gait.unloads = first_unloading(now.body, leg);
  std::optional<gaits::Action> action = Gait::answer(event, of_leg, leg);
  const bool is_loss = event == gaits::LegEvent::lost || event == gaits::LegEvent::airborne;
  if (action && is_loss)
    for (const Swing& swing : swings_) action->searches[index(swing.leg)] = true;
  return action;
}

void PythonGait::follow(const gaits::Action& action, const Situation& now, Body& body) {
  if (action.reloads)
    for (const Leg k : body.legs.all())
      if (body.legs[k].phase() == LegPhase::unloading) body.legs[k].reload(now.time);
  if (action.swing && !action.swing->keeps_deadline)
    for (Swing& swing : swings_)
      if (swing.leg == action.swing->leg) swing.lands_at = now.time + action.swing->target.duration;
  const auto lands = [&](const Swing& swing) { return swing.leg == action.lands; };
  body.steps_taken += static_cast<int>(std::erase_if(swings_, lands));
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
  const auto land_lost = [&] {
    for (const Leg k : body.legs.all())
      if (!ahead.is_down(k) && !swings(k)) ahead.land(k, now.foot(k));
  };
  std::vector<Swing> swings = swings_;
  std::ranges::sort(swings, {}, &Swing::lands_at);
  for (const Swing& swing : swings) {
    if (time == now.time || swing.lands_at > time) ahead.add(pass_until(swing.lands_at), true);
    land_lost();
    ahead.land(swing.leg, body.legs[swing.leg].target().goal);
  }
  land_lost();
  for (const StepAhead& step : steps_) {
    ahead.add_support_until_lift_off(step.leg, pass_until(step.lift_off));
    ahead.add(pass_until(time + step.swing), true);
    ahead.land(step.leg, step.to);
  }
  ahead.come_to_rest(body);
}

void PythonGait::plan_com(std::vector<StepAhead> steps, const Situation& now, Body& body) {
  if (steps.size() > most_steps())
    throw Error("steps has " + std::to_string(steps.size()) + " steps; with " +
                std::to_string(swings_.size()) + " legs in the air at most " +
                std::to_string(most_steps()) + " would be valid");
  steps_ = std::move(steps);
  plan_com(now, body);
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

Motion<double> PythonGait::motion_of(const char* method, const char* valid) const {
  return in_python([&] {
    const nb::object given = (*object_).attr(method)();
    std::vector<double> numbers;
    if (nb::try_cast(given, numbers) && numbers.size() == 3 &&
        std::ranges::all_of(numbers, [](double number) { return std::isfinite(number); }))
      return Motion<double>{numbers[0], numbers[1], numbers[2]};
    throw Error(wrong_result(*object_, method, given, valid));
  });
}

ComPlan PythonGait::com(const Situation& now, const Body& body) const {
  return with_tick(object_, "com", {{&now, &body}, robot_}, [&](const nb::object& given) {
    const ComPlan& plan = result_of<ComPlan>(*object_, "com", "ComPlan", given);
    if (plan.p.allFinite() && plan.v.allFinite() && plan.a.allFinite()) return plan;
    throw Error("com() gave NaN or infinity");
  });
}

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
          "pitch", [](const Self&) { return std::make_tuple(0.0, 0.0, 0.0); },
          nb::sig("def pitch(self) -> tuple[float, float, float]"),
          "How the torso pitches in a cycle, nose down: angle, rate, acceleration [rad, rad/s, "
          "rad/s²].")
      .def(
          "restart", [](const Self&) {},
          "Forgets everything: the robot may stand elsewhere. The gait is not active.");
}

}  // namespace surefoot::python
