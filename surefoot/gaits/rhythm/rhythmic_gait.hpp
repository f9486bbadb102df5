#pragma once

#include "surefoot/gaits/gait.hpp"
#include "surefoot/gaits/rhythm/driven_com.hpp"
#include "surefoot/gaits/rhythm/phase_clock.hpp"

namespace surefoot::gaits {

/// A gait by a clock, such as a trot: legs lift off at their times, whatever the others do, and
/// step to where they catch the robot. The clock waits for late feet before a leg is unloaded.
class RhythmicGait final : public Gait {
 public:
  RhythmicGait(const RhythmOptions& options, const Scale& scale)
      : options_(options), scale_(scale), clock_(options) {}

  void begin(Situation& now, Body& body, const std::optional<Action>& first) override;
  [[nodiscard]] bool waits(const Body&) const override { return false; }
  [[nodiscard]] bool is_static() const override { return false; }
  [[nodiscard]] double stride_duration(double) const override;
  [[nodiscard]] ComPlan com(const Situation&, const Body&) const override { return com_.plan(); }

 private:
  [[nodiscard]] std::optional<Action> answer(LegEvent event, const Situation& now,
                                             Leg leg) const override;
  void follow(const Action& action, const Situation& now, Body& body) override;
  void plan_com(const Situation&, Body&) override {}
  GaitOutcome go_on(Situation& now, Body& body) override;

  void drive_com(const Situation& now);
  void advance_clock(const Body& body);
  void move_leg(Leg leg, const Situation& now, Body& body);
  void lift(Leg leg, const Situation& now, Body& body);
  /// Is a foot in the air that should land before the next lift-off, whose force ramp begins?
  [[nodiscard]] bool misses_foot(const Body& body) const;
  [[nodiscard]] bool is_slow(const Situation& now) const;
  [[nodiscard]] Vec3 foothold(Leg leg, double until_landing, const Situation& now) const;

  RhythmOptions options_;
  Scale scale_;
  PhaseClock clock_;
  DrivenCom com_;
  double waited_ = 0.0;  // of the clock, for late feet [s]
  bool stops_ = false;   // no leg lifts off any more
};

}  // namespace surefoot::gaits
