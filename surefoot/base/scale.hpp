#pragma once

#include <cmath>
#include <string_view>

namespace surefoot {

/// How large a robot is, as ratios to the one that the library's constants and defaults are written
/// for: ANYmal B, 30.475 kg on legs of 0.5643 m. Gravity is the same for all, so two robots of one
/// shape walk alike where times go with the root of lengths (Froude's law; Hof, "Scaling gait data
/// to body size", Gait & Posture 4, 1996).
struct Scale {
  double length = 1.0;       ///< of the legs
  double mass = 1.0;         ///< of the robot
  double half_length = 1.0;  ///< of the rectangle of its hips, along x
  double half_width = 1.0;   ///< of the rectangle of its feet below the hips, along y
  double hip_height = 0.0;   ///< of the hips over the base's origin, beyond the reference's [m]
  double stride = 1.0;       ///< share of a stride that hips so close to each other allow

  [[nodiscard]] double time() const { return std::sqrt(length); }
  [[nodiscard]] double speed() const { return std::sqrt(length); }
  [[nodiscard]] double rate() const { return 1.0 / time(); }  ///< of 1/s, rad/s, Hz
  [[nodiscard]] double force() const { return mass; }
  [[nodiscard]] double torque() const { return mass * length; }

  /// The factor of a quantity with this unit: "N·m·s/rad", "1/s²", "m/√s". 1 for what has no
  /// dimension, as "rad", and for words, as "ticks".
  [[nodiscard]] double of(std::string_view unit) const;
};

}  // namespace surefoot
