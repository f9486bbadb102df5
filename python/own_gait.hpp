#pragma once

#include "python/dynamics.hpp"
#include "python/own_parts.hpp"
#include "surefoot/gaits/gait.hpp"

#include <algorithm>
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

/// A leg in the air that the gait has lifted, and when it is expected to land [s].
struct Swing {
  Leg leg;
  double lands_at;
};

/// A gait that is written in Python. Any number of legs may be in the air at once.
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
  Motion<double> bounce() const override {
    return motion_of("bounce", "(height, velocity, acceleration) [m, m/s, m/s²]");
  }
  Motion<double> pitch() const override {
    return motion_of("pitch", "(angle, rate, acceleration) [rad, rad/s, rad/s²]");
  }
  ComPlan com(const gaits::Situation& now, const gaits::Body& body) const override;

  // For GaitTick, of legs that are down.
  void lift(Leg leg, const Vec3& to, double duration, double apex, gaits::Situation& now,
            gaits::Body& body) {
    swings_.push_back({leg, now.time + duration});
    begins_step_ = true;
    std::erase_if(steps_, [&](const StepAhead& step) { return step.leg == leg; });
    if (steps_.size() > most_steps())
      steps_.erase(steps_.begin() + static_cast<std::ptrdiff_t>(most_steps()), steps_.end());
    act({.events = now.event_list(PlanEvent::lift_off, leg),
         .memory = body.swing.for_new_swing(),
         .swing = gaits::SwingOrder{leg,
                                    {.start = now.foot(leg),
                                     .goal = to,
                                     .normal = body.plane.normal,
                                     .duration = duration,
                                     .apex = apex}}},
        now, body);
  }
  static void unload(Leg leg, double lift_off, gaits::Body& body) {
    body.legs[leg].unload(lift_off);
  }
  /// What is planned again, as after a touchdown, has these steps ahead, too. Throws Error on more
  /// than a plan has phases for.
  void plan_com(std::vector<StepAhead> steps, const gaits::Situation& now, gaits::Body& body);

 private:
  /// A plan has a phase for each landing, two for a step ahead, and one to rest.
  [[nodiscard]] std::size_t most_steps() const {
    return (gaits::ComProblem::kMaxPhases - 1 - swings_.size()) / 2;
  }
  [[nodiscard]] double number_of(const char* method, const char* valid) const {
    return in_python([&] {
      const nb::object given = (*object_).attr(method)();
      double number = kNaN;
      if (nb::try_cast<double>(given, number) && std::isfinite(number)) return number;
      throw Error(wrong_result(*object_, method, given, valid));
    });
  }
  [[nodiscard]] Motion<double> motion_of(const char* method, const char* valid) const;
  [[nodiscard]] bool truth_of(const char* method, nb::handle given) const {
    bool is_true = false;
    if (nb::try_cast<bool>(given, is_true)) return is_true;
    throw Error(wrong_result(*object_, method, given, "True or False"));
  }

  void forget_steps() {
    begins_step_ = false;
    swings_.clear();
    steps_.clear();
  }
  [[nodiscard]] bool swings(Leg leg) const {
    return std::ranges::any_of(swings_, [&](const Swing& swing) { return swing.leg == leg; });
  }
  gaits::GaitStatus status(const gaits::Body& body) const override;
  std::optional<gaits::Action> answer(gaits::LegEvent event, const gaits::Situation& now,
                                      Leg leg) const override;
  void follow(const gaits::Action& action, const gaits::Situation& now, gaits::Body& body) override;
  void plan_com(const gaits::Situation& now, gaits::Body& body) override;
  gaits::GaitOutcome go_on(gaits::Situation& now, gaits::Body& body) override;

  SharedObject object_;
  std::shared_ptr<Robot> robot_;
  std::vector<Swing> swings_;
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
  /// Throws Error if it is in the air.
  [[nodiscard]] Leg standing_leg(const std::string& name) const;

 private:
  [[nodiscard]] const Parts& live() const {
    if (parts_->now != nullptr) return *parts_;
    throw Error("this tick is over; take what you need of it while the gait's method runs");
  }

  std::shared_ptr<Parts> parts_;
  std::shared_ptr<Robot> robot_;
};

}  // namespace surefoot::python
