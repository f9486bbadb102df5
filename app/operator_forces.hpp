#pragma once

#include "surefoot/simulation/plant_options.hpp"
#include "surefoot/view/view_session.hpp"

#include <string>
#include <vector>

namespace surefoot {

/// A force of the operator, and what it has given.
struct OutsideForce {
  Vec3 force = Vec3::Zero();  ///< in W [N]
  int body = -1;              ///< its place among the bodies that can be pushed; -1: nothing acts
  double given = 0.0;         ///< ∫ |force| dt since it began [N·s]
};

/// What the operator does to the robot at a tick.
struct OutsideForces {
  OutsideForce push;  ///< the sum of the pushes that act; since the first of those that overlap
  OutsideForce pull;
  bool is_weaker = false;  ///< the pull is held at less than was asked for
  double store = 0.0;      ///< that pushes and pulls may give yet [N·s]
};

/// Keeps what an operator's pushes and pulls do within limits, in the run's time, however many
/// come at once: together at most `push_force`, and what they give, ∫ |force| dt, comes out of a
/// store of `push_impulse` that fills again by `push_refill`:
///
///     Σ |force| ≤ push_force,  given in any time T ≤ push_impulse + push_refill T
///
/// A push gets all of its impulse or none. A pull gets what the pushes leave, and fades towards
/// what refills the store as that runs out: |force| ≤ min(push_force − pushes, store / 0.2 s).
class OperatorForces {
 public:
  OperatorForces(const ViewLimits& limits, std::vector<std::string> bodies);

  /// Counts what acted up to a time [s].
  void advance(double time);
  /// A push that begins now; why it can't be, empty: it begins.
  [[nodiscard]] std::string push(const Push& push);
  /// The force that a pull may have now, in the direction that is asked for [N].
  [[nodiscard]] Vec3 bounded(const Vec3& wanted) const;
  /// Whether the present pull is too much for `duration` more, as a push came beside it.
  [[nodiscard]] bool is_too_much(double duration) const;
  /// From now on; one that follows none, or is at another body, begins.
  void pull(const Pull& pull, bool is_weaker);

  [[nodiscard]] const OutsideForces& now() const { return now_; }

 private:
  [[nodiscard]] int place(const std::string& body) const;
  [[nodiscard]] double pushing() const;
  void sum_up();

  ViewLimits limits_;
  std::vector<std::string> bodies_;
  std::vector<Push> pushes_;  // that act
  OutsideForces now_;
  double time_ = 0.0;  // [s]
};

}  // namespace surefoot
