#pragma once

#include "surefoot/math/types.hpp"

#include <string>

namespace surefoot::model {

/// Mass, centre of mass and rotational inertia about it, in the axes of the body's frame.
struct Inertia {
  double mass = 0.0;              ///< [kg]
  Vec3 com = Vec3::Zero();        ///< [m]
  Mat3 about_com = Mat3::Zero();  ///< [kg·m²]

  /// This inertia in a frame where the body is placed by x ↦ R x + p.
  [[nodiscard]] Inertia placed(const Mat3& R, const Vec3& p) const;
  /// Both bodies welded together; either may be massless.
  [[nodiscard]] Inertia operator+(const Inertia& other) const;
};

/// Rounding tolerance of comparisons of moments of inertia, as a share of the largest.
inline constexpr double kInertiaRounding = 1e-9;

/// Principal moments of inertia, the smallest first [kg·m²].
[[nodiscard]] Vec3 principal_moments(const Inertia& inertia);

/// Does a physical body have these moments? None may exceed the sum of the two others by more than
/// rounding.
[[nodiscard]] bool obeys_triangle_inequality(const Vec3& principal_moments);

/// Is a root link's inertia only a placeholder for other tools? At most 1 g, and massless or not
/// positive definite. Controller and plant both ignore it.
[[nodiscard]] bool is_placeholder(const Inertia& inertia);

/// The note on an ignored root link's inertia.
[[nodiscard]] std::string placeholder_note(const std::string& link, double mass);

}  // namespace surefoot::model
