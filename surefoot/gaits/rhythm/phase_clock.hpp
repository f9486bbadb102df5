#pragma once

#include "surefoot/gaits/planner_options.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::gaits {

/// The clock of a gait: where each leg is in its cycle. A leg's cycle begins with its swing.
class PhaseClock {
 public:
  explicit PhaseClock(const RhythmOptions& options)
      : options_(options), lifts_(static_cast<int>(options.duty.size()), false) {}

  /// Sets the clock to `before` [s] before this leg's lift-off.
  void start(double before, Leg first) {
    phase_ = fraction(options_.offset[index(first)] - before / options_.period);
    lifts_.fill(false);
  }
  void advance(double dt) {
    const double next = after(dt);
    for (const Leg k : lifts_.legs()) lifts_[index(k)] = begins_cycle(k, next);
    phase_ = next;
  }

  /// Goes back to `before` [s] before this leg should land.
  void return_to_landing(Leg leg, double before) {
    const double share = 1.0 - options_.duty[index(leg)] - before / options_.period;
    phase_ = fraction(options_.offset[index(leg)] + share);
    lifts_.fill(false);
  }

  /// Of the cycle, in [0, 1).
  [[nodiscard]] double phase() const { return phase_; }
  /// Did this leg's swing begin at the last advance?
  [[nodiscard]] bool lifts(Leg leg) const { return lifts_[index(leg)]; }
  /// Should this leg be in the air?
  [[nodiscard]] bool swings(Leg leg) const { return of(leg) < 1.0 - options_.duty[index(leg)]; }
  [[nodiscard]] double until_lift_off(Leg leg) const { return (1.0 - of(leg)) * options_.period; }
  /// Negative in the leg's stance.
  [[nodiscard]] double until_landing(Leg leg) const {
    return until_lift_off(leg) - stance_duration(leg);
  }
  [[nodiscard]] double swing_duration(Leg leg) const {
    return (1.0 - options_.duty[index(leg)]) * options_.period;
  }
  [[nodiscard]] double stance_duration(Leg leg) const {
    return options_.duty[index(leg)] * options_.period;
  }

 private:
  [[nodiscard]] static double fraction(double x) { return x - std::floor(x); }
  [[nodiscard]] double after(double dt) const { return fraction(phase_ + dt / options_.period); }
  /// Share of the leg's cycle that has passed, in [0, 1).
  [[nodiscard]] double of(Leg leg) const { return share(leg, phase_); }
  [[nodiscard]] double share(Leg leg, double phase) const {
    return fraction(phase - options_.offset[index(leg)]);
  }
  /// Does a cycle of the leg begin on the way to another phase?
  [[nodiscard]] bool begins_cycle(Leg leg, double next) const { return share(leg, next) < of(leg); }

  RhythmOptions options_;
  double phase_ = 0.0;  // of the cycle, in [0, 1)
  PerLeg<bool> lifts_;
};

}  // namespace surefoot::gaits
