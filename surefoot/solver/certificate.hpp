#pragma once

#include "surefoot/solver/hierarchy.hpp"

#include <Eigen/Core>

#include <limits>
#include <string_view>
#include <vector>

namespace surefoot::solver {

/// Possible gains in exact arithmetic that doubles can't see: in directions that rows see so weakly
/// that rank is a matter of tolerance, or next to forces whose rounding hides it.
struct Doubt {
  /// Share of the level's residual that could be gained, or that is rounding of x, relative to
  /// residual, largest bound and longest row together.
  double residual = 0.0;
  double stationarity = 0.0;  ///< as in `LevelCertificate`, without any tolerance for rounding
  /// Smallest independent part of a row, relative to its length (within a factor of 2), among rows
  /// with more than the rounding of its elements, 1e-14.
  double weakest = 1.0;
};

/// Distance of a level from its lexicographic optimum.
struct LevelCertificate {
  double residual = 0.0;  ///< √Σ violation²
  /// 0 at an optimum. With r = Zᵀ (g + Tᵀ μ), Z an orthonormal basis of E's null space, U the rows
  /// uᵢ aᵢ, uᵢ = Σⱼ |aᵢⱼ xⱼ| + ‖aᵢ‖ (1 + 1e-3 ‖x‖), of equalities and of violated rows and rows at
  /// a bound, the least over μ ≥ 0 of
  ///
  ///     √(rᵀ (Zᵀ Uᵀ U Z + w² I)⁻¹ r)
  ///
  /// Times the largest u it bounds the gain of the least-squares step of these rows in the
  /// remaining directions, √(residual² − residual² after it): a residual, not a gradient, so that
  /// nearly parallel rows do not square its error. Each row may be off by its own u, so long rows
  /// excuse nothing that only short ones see. w is 1e8 times the rounding of forces: of the rows,
  /// their unit, μ and λ. ∞ if x or a number computed with it isn't finite.
  double stationarity = 0.0;
  /// What doubles can't decide. If it is large, the answer depends on tolerances of rank or
  /// rounding, and stationarity means nothing.
  Doubt doubt = {};
  /// Index of the first unproven level above, −1: none. The freedom of this level depends on the
  /// optimality of those above, so it is not proven either, even if it meets its conditions with
  /// their rows at x.
  int rests_on = -1;
};

/// Judgement of x. Not judged: x meets the conditions as far as doubles can tell, but exact
/// arithmetic could gain something, in this level or one above.
enum class Verdict : int { proven = 0, not_judged = 1, not_proven = 2 };

/// Largest stationarity from rounding.
inline constexpr double kProvenStationarity = 1e-8;
/// Largest negligible share of a level's residual.
inline constexpr double kSameResidual = 1e-7;

/// "proven", "not judged" or "not proven".
[[nodiscard]] std::string_view name(Verdict verdict);

[[nodiscard]] Verdict verdict(const LevelCertificate& level);
/// The worst of all levels; proven without levels.
[[nodiscard]] Verdict verdict(const std::vector<LevelCertificate>& levels);

struct CertificateOptions {
  double tight = 1e-8;  ///< distance of a row that touches a bound, relative to its `row_unit`
  double rank = 1e-8;   ///< relative length below which a row depends on others
  /// Number of leading levels that x claims to optimize.
  std::size_t levels = std::numeric_limits<std::size_t>::max();
};

/// Checks x against the optimality conditions of every level, without any solver code:
///
///     g = Σ vᵢ aᵢ  the gradient of ½ ‖violation‖² of the level at x
///     E            equality rows and violated rows of all levels before: their residual is fixed;
///                  those violated by less than `tight` only if no error of x causes it (see
///                  `fix_violated`); and rows of T that push back at a level before by more than
///                  rounding: all of its optima lie on them
///     T            satisfied rows of all levels before that touch a bound,
///                  signed so that T z ≤ 0 keeps them satisfied
///
/// The level is optimal if and only if −g lies in the cone {Eᵀ λ + Tᵀ μ, μ ≥ 0} (the problem is
/// convex). Non-negative least squares with Eigen's decompositions gives the distance; it shares no
/// line with the solvers. Own rows that touch a bound are not in T: their violation is zero and so
/// is their share of g. Allocates.
[[nodiscard]] std::vector<LevelCertificate> certify(const Hierarchy& hierarchy,
                                                    const Eigen::VectorXd& x,
                                                    const CertificateOptions& options = {});

/// Largest stationarity of all levels; 0 without levels, ∞ for NaN.
[[nodiscard]] double worst_stationarity(const std::vector<LevelCertificate>& levels);

}  // namespace surefoot::solver
