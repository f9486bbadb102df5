#pragma once

#include "surefoot/estimation/ground_reaction.hpp"

#include <optional>

namespace surefoot {

/// How much higher in B the centre of mass lies than the model's, from a torso that turns on the
/// spot: a COM that is higher goes farther aside as the torso tilts.
///
/// With the COM off the model's by o, fixed in B, and up = Rᵀe_z, the line of action of the
/// ground's force passes it but for what turns the robot. Where it passes B's plane through the
/// model's COM, projected along up,
///
///     e = proj Rᵀ (line of action at c_model − c_model + dD/dt) = o_xy − o_z up_xy / up_z,
///     proj v = v_xy − v_z up_xy / up_z,   D = (L_y, −L_x, 0) / F_z
///
/// with L the angular momentum about the model's COM. o_z is the slope of e over −up_xy / up_z, by
/// least squares with a mean of its own for x and y: constant errors of the vertical and of the
/// forces drop out. The robot rests at both ends of the motion, D = 0 there, so Σ s dD/dt = −Σ
/// ds/dt D and nothing is differentiated. Left out are o_z F_xy / F_z, some percent of
/// o_z, and the inertia that a load has of its own: 6.9 kg that lie 0.2 m high seem a seventh
/// higher by that. Ours (decision 0028). Does not allocate.
class ComHeight {
 public:
  explicit ComHeight(double period) : period_(period) {}

  /// What was seen before says nothing.
  void forget() noexcept { sums_ = Sums{}; }
  /// A tick of the motion.
  void add(const Dynamics& dynamics, const GroundReaction& reaction) noexcept;
  /// o_z by the motion so far [m]; nothing where the torso has hardly tilted.
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

}  // namespace surefoot
