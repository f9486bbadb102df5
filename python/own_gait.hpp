#pragma once

#include "python/dynamics.hpp"
#include "python/own_parts.hpp"
#include "surefoot/gaits/gait.hpp"

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace surefoot::python {

/// A step that the centre of mass prepares for: the leg lifts off at `lift_off` [s], and lands on
/// `to` after `swing` [s].
struct StepAhead {
  Leg leg;
  double lift_off, swing;
  Vec3 to;
};

/// A gait that is written in Python.
class PythonGait final : public gaits::Gait {
 public:
  PythonGait(SharedObject object, std::shared_ptr<Robot> robot)
      : object_(std::move(object)), robot_(std::move(robot)) {}

  void restart() override {
    forget_steps();
    in_python([&] { (*object_).attr("restart")(); });
  }
  void begin(gaits::Situation& now, gaits::Body& body,
             const std::optional<gaits::Action>& first) override;
  bool waits(const gaits::Body&) const override {
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
  ComPlan com(const gaits::Situation& now, const gaits::Body& body) const override;

  // For GaitTick.
  void lift(Leg leg, const Vec3& to, double duration, double apex, gaits::Situation& now,
            gaits::Body& body) {
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
  void unload(Leg leg, double lift_off, gaits::Body& body) {
    unloads_ = leg;
    body.legs[leg].unload(lift_off);
  }
  /// What is planned again, as after a touchdown, has these steps ahead, too.
  void plan_com(std::vector<StepAhead> steps, const gaits::Situation& now, gaits::Body& body) {
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
  gaits::GaitStatus status(const gaits::Body&) const override {
    return {.swings = swings_, .unloads = unloads_, .lands_at = lands_at_};
  }
  void follow(const gaits::Action& action, const gaits::Situation&, gaits::Body& body) override {
    if (unloads_ && action.reloads == unloads_) unloads_.reset();
    if (!swings_ || action.lands != swings_) return;
    swings_.reset();
    ++body.steps_taken;
  }
  void plan_com(const gaits::Situation& now, gaits::Body& body) override;
  gaits::GaitOutcome go_on(gaits::Situation& now, gaits::Body& body) override;

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
    const gaits::Situation* now;
    const gaits::Body* body;
    gaits::Situation* changed = nullptr;
    gaits::Body* changed_body = nullptr;
    PythonGait* gait = nullptr;
  };
  GaitTick(const Parts& parts, std::shared_ptr<Robot> robot)
      : parts_(std::make_shared<Parts>(parts)), robot_(std::move(robot)) {}
  void end() { *parts_ = {}; }

  [[nodiscard]] const gaits::Situation& now() const { return *live().now; }
  [[nodiscard]] const gaits::Body& body() const { return *live().body; }
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

}  // namespace surefoot::python
