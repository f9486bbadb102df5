#pragma once

#include "surefoot/estimation/ground_reaction.hpp"

namespace surefoot {

/// How much higher in B the centre of mass lies than the model's, from a torso that turns on the
/// spot: a COM that is higher goes farther aside as the torso tilts.
///
/// With the COM off the model's by o, fixed in B, and up = Rᵀe_z, the line of action of the
/// ground's force passes it, but for what turns the robot:
///
///     e = Rᵀ (line of action at the model's COM − c_model + d/dt D) = o_xy − o_z up_xy,
///     D = (L_y, −L_x) / F_z,   L the angular momentum about the model's COM
///
/// both in B's x and y. o_z is the slope of e over −up, by least squares with a mean of its own for
/// each axis; up is level where the motion begins and ends, so Σ −up dD/dt = Σ d(up)/dt D and
/// nothing is differentiated. Constant errors of the vertical and of the forces drop out. Pulled to
/// 0 where the torso hardly tilts. Ours (decision 0028). Does not allocate.
class ComHeight {
 public:
  /// A motion begins, or what was found is in use.
  void begin() noexcept { sums_ = Sums{}; }
  /// A tick of the motion; ticks may be missed.
  void add(const Dynamics& dynamics, const GroundReaction& reaction) noexcept;
  /// o_z by the motion so far [m].
  [[nodiscard]] double found() const noexcept;

 private:
  /// Of x and y.
  struct Sums {
    int ticks = 0;
    Vec2 tilt = Vec2::Zero(), error = Vec2::Zero();
    Vec2 tilt_tilt = Vec2::Zero(), tilt_error = Vec2::Zero();
    Vec2 rate_momentum = Vec2::Zero();
  };

  Sums sums_;
};

}  // namespace surefoot
