#pragma once

#include "surefoot/gaits/reactions/situation.hpp"

namespace surefoot::gaits {

/// Which leg steps when: the gait's order, mirrored fore and hind when it walks backward, and its
/// durations, all longer by a factor `pace`.
class StepSequence {
 public:
  /// Throws Error unless the gait's order has each leg once.
  StepSequence(const GaitOptions& gait, const ProbeOptions& probe);

  /// The leg that swings or is about to, or the one that follows after so many more.
  [[nodiscard]] Leg next(int ahead = 0) const;
  void advance() { cursor_ = (cursor_ + 1) % kNumLegs; }
  /// The order goes on from this leg.
  void go_on_with(Leg leg) {
    while (next() != leg) advance();
  }
  void set_backward(bool backward) { backward_ = backward; }

  /// With all feet down before that leg [s].
  [[nodiscard]] double support_duration(double pace, int ahead = 0) const;
  /// With both touches, where the leg probes [s].
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

/// Where the other feet's triangle is too thin to swing the next leg: another leg that goes first,
/// if one can and its step to its nominal place widens the triangle.
[[nodiscard]] std::optional<Leg> leg_for_wider_support(const Situation& now,
                                                       const StepSequence& steps);

/// Lifts the leg off to its next foothold; one that probes first touches ahead of it.
/// `cycle_duration` of the gait's steps [s].
void begin_swing(Leg leg, const Situation& now, Body& body, double cycle_duration);

}  // namespace surefoot::gaits
