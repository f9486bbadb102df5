#pragma once

#include "surefoot/gaits/reactions/situation.hpp"

namespace surefoot::gaits {

/// Order and durations of the steps: front and hind swap when walking backward, and all durations
/// are multiplied by `pace`.
class StepSequence {
 public:
  /// Throws Error unless the gait's order has each leg once.
  StepSequence(const GaitOptions& gait, const ProbeOptions& probe);

  /// The present or next swing leg, or the one `ahead` swings later.
  [[nodiscard]] Leg next(int ahead = 0) const;
  void advance() { cursor_ = (cursor_ + 1) % gait_.num_legs(); }
  /// Makes this leg the next one.
  void go_on_with(Leg leg) {
    while (next() != leg) advance();
  }
  void set_backward(bool backward) { backward_ = backward; }

  /// With all feet down before the swing of `next(ahead)` [s].
  [[nodiscard]] double support_duration(double pace, int ahead = 0) const;
  /// Including the second swing of a leg that probes [s].
  [[nodiscard]] double swing_duration(double pace, Leg leg) const {
    return pace * gait_.swing_duration + (probes(probe_, leg) ? probe_.duration : 0.0);
  }
  [[nodiscard]] double cycle_duration(double pace) const;

 private:
  GaitOptions gait_;
  ProbeOptions probe_;
  int cursor_ = 0;  // place of the next leg in the order
  bool backward_ = false;
};

/// If the support of the other feet is too thin for the next swing: another leg whose step to its
/// nominal place is possible and widens it.
[[nodiscard]] std::optional<Leg> leg_for_wider_support(const Situation& now,
                                                       const StepSequence& steps);

/// Begins the swing of a leg to its next foothold, or ahead of it if the leg probes.
/// `cycle_duration` of the gait [s].
void begin_swing(Leg leg, const Situation& now, Body& body, double cycle_duration);

}  // namespace surefoot::gaits
