#pragma once

#include "surefoot/solver/hierarchy.hpp"

#include <Eigen/Core>

#include <limits>
#include <string_view>
#include <vector>

namespace surefoot {

/// What exact arithmetic could still gain where doubles see nothing: in directions that rows see so
/// weakly that a rank is a matter of tolerance, or beside forces so large that their rounding hides
/// it.
struct Doubt {
  /// Of the level's residual the share that could be gained, or that the rounding of x is, relative
  /// to residual, largest bound and longest row together.
  double residual = 0.0;
  double stationarity = 0.0;  ///< as `LevelCertificate` measures it, but excusing nothing
  /// Of a row what the others leave of it at least, relative to its length (to within a factor of
  /// 2), of those where more is left than the rounding of its elements, 1e-14.
  double weakest = 1.0;
};

/// How far a level is from its lexicographic optimum.
struct LevelCertificate {
  double residual = 0.0;  ///< √Σ violation²
  /// 0 at an optimum. With r = Zᵀ (g + Tᵀ μ), Z an orthonormal basis of what E leaves free, U the
  /// rows uᵢ aᵢ, uᵢ = Σⱼ |aᵢⱼ xⱼ| + ‖aᵢ‖ (1 + 1e-3 ‖x‖), of equalities and of what is violated or
  /// at a bound, the
  /// least over μ ≥ 0 of
  ///
  ///     √(rᵀ (Zᵀ Uᵀ U Z + w² I)⁻¹ r)
  ///
  /// Times the longest u it is at least what the least-squares step of these rows in the
  /// directions left would gain, √(residual² − residual² after it): a residual, not a gradient, so
  /// that nearly parallel rows do not square its error. Each row may be off by its own u, so long
  /// rows excuse nothing that only short ones see. w is 1e8 times the rounding of forces: the
  /// rows' and their unit's, μ and λ. ∞ where x or a number computed with it isn't finite.
  double stationarity = 0.0;
  /// What doubles can't tell: where it is large the answer hangs on what counts as a rank or as
  /// rounding, and stationarity says nothing.
  Doubt doubt = {};
  /// Index of the first level above that is not proven, −1: none. What this level may do hangs on
  /// where those above are optimal, so it is not proven either, however well it meets its
  /// conditions with their rows as x has them.
  int rests_on = -1;
};

/// What is said of x. Not judged: x meets the conditions within what doubles can tell, but exact
/// arithmetic could gain something that they excuse, in this level or in one above.
enum class Verdict : int { proven = 0, not_judged = 1, not_proven = 2 };

/// Stationarity at most that is rounding.
inline constexpr double kProvenStationarity = 1e-8;
/// Share of a level's residual at most that makes no difference.
inline constexpr double kSameResidual = 1e-7;

/// "proven", "not judged" or "not proven".
[[nodiscard]] std::string_view name(Verdict verdict);

[[nodiscard]] Verdict verdict(const LevelCertificate& level);
/// The worst of all levels; proven for a hierarchy without levels.
[[nodiscard]] Verdict verdict(const std::vector<LevelCertificate>& levels);

struct CertificateOptions {
  double tight = 1e-8;  ///< a row this close to a bound, relative to its `row_unit`, touches it
  double rank = 1e-8;   ///< relative length below which a row depends on others
  /// The first so many levels: those for which x is said to be the optimum.
  std::size_t levels = std::numeric_limits<std::size_t>::max();
};

/// Checks x against the optimality conditions of every level, without any solver:
///
///     g = Σ vᵢ aᵢ  the gradient of ½ ‖violation‖² of the level at x
///     E            equality rows and violated rows of all levels before: their residual is fixed;
///                  those violated by less than `tight` only where no error of x has made it (see
///                  `fix_violated`); and rows of T that push back at a level before by more than
///                  rounding: all of its optima lie on them
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
