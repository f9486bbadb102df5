#pragma once

#include "surefoot/math/types.hpp"

#include <string>

namespace surefoot {

/// Mass, centre of mass and rotational inertia about it, in the axes of the body's frame.
struct Inertia {
  double mass = 0.0;              ///< [kg]
  Vec3 com = Vec3::Zero();        ///< [m]
  Mat3 about_com = Mat3::Zero();  ///< [kg·m²]

  /// The inertia of this body in a frame that it is placed in by x ↦ R x + p.
  [[nodiscard]] Inertia placed(const Mat3& R, const Vec3& p) const;
  /// Both bodies, welded together. Massless bodies are legal.
  [[nodiscard]] Inertia operator+(const Inertia& other) const;
};

/// What is left to rounding where moments of inertia are compared, as a share of the largest.
inline constexpr double kInertiaRounding = 1e-9;

/// Principal moments of inertia, the smallest first [kg·m²].
[[nodiscard]] Vec3 principal_moments(const Inertia& inertia);

/// Can a body have it whose parts have mass? No moment may exceed the sum of the two others by more
/// than rounding.
[[nodiscard]] bool obeys_triangle_inequality(const Vec3& principal_moments);

/// Is the inertia of a root link none of a body, but there for a tool that wants one? At most 1 g,
/// and massless or not positive definite. Controller and plant leave out the same.
[[nodiscard]] bool is_placeholder(const Inertia& inertia);

/// The note on a root link's inertia that was left out.
[[nodiscard]] std::string placeholder_note(const std::string& link, double mass);

}  // namespace surefoot
