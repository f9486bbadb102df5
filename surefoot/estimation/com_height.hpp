#pragma once

#include "surefoot/estimation/ground_reaction.hpp"

#include <optional>

namespace surefoot::estimation {

/// Estimates the centre of mass's height in B relative to the model's, from a torso that turns on
/// the spot: a higher COM moves further sideways as the torso tilts.
///
/// With the COM's offset o from the model's, fixed in B, and up = Rᵀe_z, the line of action of the
/// ground's force passes through the COM except for the robot's rotation. Its intersection with B's
/// plane through the model's COM, projected along up, gives
///
///     e = proj Rᵀ (line of action at c_model − c_model + dD/dt) = o_xy − o_z up_xy / up_z,
///     proj v = v_xy − v_z up_xy / up_z,   D = (L_y, −L_x, 0) / F_z
///
/// with L the angular momentum about the model's COM. o_z is the slope of e over −up_xy / up_z, by
/// least squares with separate means for x and y, which cancels constant errors of vertical and
/// forces. The robot rests at both ends, where D = 0, so Σ s dD/dt = −Σ ds/dt D needs no
/// derivative. Neglected are o_z F_xy / F_z, some percent of o_z, and the load's own inertia, which
/// makes 6.9 kg at 0.2 m seem a seventh higher. Ours (decision 0028). Does not allocate.
class ComHeight {
 public:
  explicit ComHeight(double period) : period_(period) {}

  /// Discards the past.
  void forget() noexcept { sums_ = Sums{}; }
  /// Adds a tick of the motion.
  void add(const model::Dynamics& dynamics, const GroundReaction& reaction) noexcept;
  /// o_z by the motion so far [m]; empty if the torso has hardly tilted.
  [[nodiscard]] std::optional<double> found() const noexcept;

 private:
  /// Of x and y.
  struct Sums {
    int ticks = 0;
    Vec2 tilt = Vec2::Zero(), error = Vec2::Zero();
    Vec2 tilt_tilt = Vec2::Zero(), tilt_error = Vec2::Zero();
    Vec2 rate_momentum = Vec2::Zero();
  };

  double period_;
  Sums sums_;
};

}  // namespace surefoot::estimation
