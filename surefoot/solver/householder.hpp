#pragma once

#include <Eigen/Core>

#include <cmath>

namespace surefoot::solver {

/// A reflection I − β v vᵀ with v₀ = 1 that maps a vector a to (head, 0, …, 0)ᵀ.
struct Reflection {
  double beta = 0.0;  ///< 0 is the identity
  double head = 0.0;  ///< ±‖a‖, with the sign that avoids cancellation
};

/// Turns `a` into the vector v of its reflection, with v₀ = 1. Does not allocate.
template <typename Vector>
[[nodiscard]] Reflection make_reflection(Vector&& a) {
  const double norm = a.norm();
  if (norm == 0.0) {
    if (a.size() > 0) a[0] = 1.0;
    return {};
  }
  const double first = a[0];
  const double head = first > 0.0 ? -norm : norm;
  const double pivot = first - head;
  a /= pivot;
  a[0] = 1.0;
  return {-pivot / head, head};
}

/// a ← (I − β v vᵀ) a.
template <typename Vector, typename Target>
void reflect(const Vector& v, double beta, Target&& a) {
  const double along = beta * v.dot(a);
  a -= along * v;
}

/// T ← T (I − β v vᵀ); `scratch` needs as many elements as T has rows.
template <typename Vector, typename Columns, typename Scratch>
void reflect_columns(const Vector& v, double beta, Columns&& T, Scratch&& scratch) {
  scratch.noalias() = T * v;
  scratch *= beta;
  T.noalias() -= scratch * v.transpose();
}

/// The rotation (a, b) → (c a + s b, c b − s a) that makes b zero.
struct Rotation {
  double c = 1.0;
  double s = 0.0;
};

[[nodiscard]] inline Rotation make_rotation(double a, double b) {
  const double radius = std::hypot(a, b);
  return radius == 0.0 ? Rotation{} : Rotation{a / radius, b / radius};
}

template <typename First, typename Second>
void rotate_columns(const Rotation& rotation, First&& first, Second&& second) {
  for (Eigen::Index i = 0; i < first.size(); ++i) {
    const double a = first[i];
    const double b = second[i];
    first[i] = rotation.c * a + rotation.s * b;
    second[i] = rotation.c * b - rotation.s * a;
  }
}

}  // namespace surefoot::solver
