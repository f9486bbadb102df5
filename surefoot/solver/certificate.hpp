#pragma once

#include "surefoot/solver/hierarchy.hpp"

#include <Eigen/Core>

#include <vector>

namespace surefoot {

/// How far a level is from its lexicographic optimum.
struct LevelCertificate {
  double residual = 0.0;  ///< √Σ violation²
  /// 0 at an optimum. With r = Zᵀ (g + Tᵀ μ), Z an orthonormal basis of what E leaves free, and s
  /// the length of the level's shortest row, the least over μ ≥ 0 of
  ///
  ///     √(rᵀ (Zᵀ M Z)⁻¹ r),   M = s² (s (1 + ‖x‖) + Σ |vᵢ|)² I
  ///                               + (1 + ‖x‖)² Σ (‖aᵢ‖² − s²) aᵢ aᵢᵀ
  ///
  /// where the second sum is over equality rows and those that are violated or at a bound;
  /// that is ‖r‖ / (s (s (1 + ‖x‖) + Σ |vᵢ|)) where all rows have one length. An error d of x
  /// changes g by Σ aᵢ aᵢᵀ d, so where longer rows see it, more of r is the same error. It is the
  /// same for a level in other units, and what only the shortest row sees is not excused by longer
  /// ones. ∞ where x or a number computed with it isn't finite.
  double stationarity = 0.0;
};

struct CertificateOptions {
  double tight = 1e-8;  ///< a row this close to a bound, relative to ‖a‖ (1 + ‖x‖), touches it
  double rank = 1e-8;   ///< relative length below which a row depends on others
};

/// Checks x against the optimality conditions of every level, without any solver:
///
///     g = Σ vᵢ aᵢ  the gradient of ½ ‖violation‖² of the level at x
///     E            equality rows and violated rows of all levels before: their residual is fixed;
///                  and rows of T that push back for certain at a level before: all of its optima
///                  lie on them
///     T            satisfied rows of all levels before that touch a bound,
///                  signed so that T z ≤ 0 keeps them satisfied
///
/// The level is optimal if and only if −g lies in the cone {Eᵀ λ + Tᵀ μ, μ ≥ 0} (the problem is
/// convex); the distance to it comes from non-negative least squares, by decompositions of Eigen's:
/// what it computes with has no line in common with the solvers. Own rows that touch a bound
/// are not in T: their violation is zero and so is their share of g. Allocates.
[[nodiscard]] std::vector<LevelCertificate> certify(const Hierarchy& hierarchy,
                                                    const Eigen::VectorXd& x,
                                                    const CertificateOptions& options = {});

/// Largest stationarity of all levels; 0 for a hierarchy without levels, ∞ where one is NaN.
[[nodiscard]] double worst_stationarity(const std::vector<LevelCertificate>& levels);

}  // namespace surefoot
