#pragma once

#include "surefoot/solver/hierarchy.hpp"

#include <Eigen/Core>

#include <vector>

namespace surefoot {

/// A row of a hierarchy.
struct RowIndex {
  std::size_t level = 0;
  Eigen::Index row = 0;
};

/// Rows of length 1 and where they come from.
struct RowSet {
  explicit RowSet(Eigen::Index unknowns) : rows(0, unknowns) {}
  void add(const Eigen::VectorXd& row, RowIndex from);
  void add(const RowSet& other);

  Eigen::MatrixXd rows;
  std::vector<RowIndex> origin;
};

/// What decides whether x is optimal for a level, see `certify`: the gradient g of the level, and
/// its own rows as they bind the levels after it. Allocates.
struct LevelConditions {
  Eigen::VectorXd gradient;  ///< g = Σ vᵢ aᵢ
  double residual = 0.0;     ///< √Σ violation²
  double scale = 1.0;        ///< s (s (1 + ‖x‖) + Σ |vᵢ|), s the length of the shortest row
  /// Rows (1 + ‖x‖) √(‖aᵢ‖² − s²) aᵢ, of those longer than s that are equalities, violated or at a
  /// bound.
  Eigen::MatrixXd longer;
  double pull = 0.0;      ///< Σ |vᵢ| ‖aᵢ‖
  double rounding = 0.0;  ///< that may be in g
  RowSet fixed;           ///< E: equality rows and violated rows
  RowSet touching;        ///< T: satisfied rows at a bound, signed so that T z ≤ 0 keeps them
};

/// `tight`: a row this close to a bound, relative to ‖a‖ (1 + ‖x‖), touches it.
[[nodiscard]] LevelConditions optimality_conditions(const Hierarchy& hierarchy, std::size_t level,
                                                    const Eigen::VectorXd& x, double tight);

/// Multipliers that come closest to −g = Eᵀ λ + Tᵀ μ, μ ≥ 0, as `LevelCertificate` measures it.
struct Multipliers {
  Eigen::VectorXd fixed;      ///< λ, one for each row of E
  Eigen::VectorXd touching;   ///< μ, one for each row of T
  double distance = 0.0;      ///< ‖g + Eᵀ λ + Tᵀ μ‖
  double stationarity = 0.0;  ///< the same as `LevelCertificate` measures it
  double rounding = 0.0;      ///< that may be in μ: the weaker the rows of E, the more
};

/// `rank`: relative length below which a row of E, or of T beside E, depends on others.
[[nodiscard]] Multipliers multipliers(const LevelConditions& level, const RowSet& fixed,
                                      const RowSet& touching, double rank);

/// Moves rows from T to E whose μ is positive for certain: all optima of the level lie on them.
/// What the rows of E leave free says so as well, but where these are nearly dependent only to
/// within rounding over the smallest pivot.
void fix_pushing(const LevelConditions& level, const Multipliers& multipliers, RowSet& fixed,
                 RowSet& touching);

/// μ ≥ 0 that minimises ‖A μ − b‖ (Lawson and Hanson 1974, ch. 23).
[[nodiscard]] Eigen::VectorXd non_negative_least_squares(const Eigen::MatrixXd& A,
                                                         const Eigen::VectorXd& b);

}  // namespace surefoot
