#pragma once

#include "surefoot/solver/hierarchy.hpp"

#include <Eigen/Core>

#include <vector>

namespace surefoot {

/// A row of a hierarchy.
struct RowIndex {
  std::size_t level = 0;
  Eigen::Index row = 0;

  friend bool operator==(const RowIndex&, const RowIndex&) = default;
};

/// Rows of length 1 and where they come from.
struct RowSet {
  explicit RowSet(Eigen::Index unknowns) : rows(0, unknowns) {}
  void add(const Eigen::VectorXd& row, RowIndex from);
  void add(const RowSet& other);

  Eigen::MatrixXd rows;
  std::vector<RowIndex> origin;
};

/// How large a row is at x, u = Σ |aⱼ xⱼ| + ‖a‖ (1 + 1e-3 ‖x‖): what is judged of its value is
/// judged relative to it. The last part is what solvers leave of rounding where x is large: 1e-11
/// ‖a‖ ‖x‖ of what counts as 1e-8.
[[nodiscard]] double row_unit(const Eigen::Ref<const Eigen::RowVectorXd>& row,
                              const Eigen::VectorXd& x);

/// What decides whether x is optimal for a level, see `certify`: the gradient g of the level, and
/// its own rows as they bind the levels after it. Allocates.
struct LevelConditions {
  Eigen::VectorXd gradient;  ///< g = Σ vᵢ aᵢ
  double residual = 0.0;     ///< √Σ violation²
  /// Rows uᵢ aᵢ, uᵢ = `row_unit`, of those that are equalities, violated or at a bound.
  Eigen::MatrixXd in_units;
  double pull = 0.0;      ///< Σ ‖aᵢ‖ |vᵢ| of the same rows, and ‖aᵢ‖² (1 + ‖x‖) of the shortest
  double rounding = 0.0;  ///< that may be in g: 100 ε Σ ‖aᵢ‖ (|vᵢ| + ‖aᵢ‖ (1 + ‖x‖))
  RowSet fixed;           ///< E: equality rows and violated rows
  RowSet touching;        ///< T: satisfied rows at a bound, signed so that T z ≤ 0 keeps them
};

/// `tight`: a row this close to a bound, relative to its `row_unit`, touches it.
[[nodiscard]] LevelConditions optimality_conditions(const Hierarchy& hierarchy, std::size_t level,
                                                    const Eigen::VectorXd& x, double tight);

/// Of each column the length of what no other column has; 0 where others make it. So large an error
/// in what they make, divided by it, is one of the column's coefficient.
[[nodiscard]] Eigen::VectorXd independence(const Eigen::MatrixXd& columns);

/// Which multipliers are positive.
[[nodiscard]] std::vector<Eigen::Index> pushing(const Eigen::VectorXd& mu);

/// Multipliers that come closest to −g = Eᵀ λ + Tᵀ μ, μ ≥ 0, as `LevelCertificate` measures it.
struct Multipliers {
  Eigen::VectorXd fixed;      ///< λ, one for each row of E
  Eigen::VectorXd touching;   ///< μ, one for each row of T
  double distance = 0.0;      ///< ‖g + Eᵀ λ + Tᵀ μ‖
  double stationarity = 0.0;  ///< the same as `LevelCertificate` measures it
  /// What rounding may make of each μ: what it makes of Zᵀ g, and ten times what is left over,
  /// divided by what of the row neither E nor another row that pushes has. Rounding of g is that of
  /// the level's rows and values, and 100 ε times μ and the multipliers that rows of E need beside
  /// it, because Z is only as good as these rows are independent.
  Eigen::VectorXd rounding;
};

/// `rank`: relative length below which a row of E, or of T beside E, depends on others.
[[nodiscard]] Multipliers multipliers(const LevelConditions& level, const RowSet& fixed,
                                      const RowSet& touching, double rank);

/// Moves rows from T to E whose μ is positive by more than rounding: all optima of the level lie on
/// them.
void fix_pushing(const Multipliers& multipliers, RowSet& fixed, RowSet& touching);

/// Moves rows of the level from its T to its E that are beyond their bound, by less than `tight`
/// but for certain: of that violation the least-squares step of all rows of the level that are
/// beyond a bound, in the directions that `fixed` leaves free, takes less than half. So it is no
/// error of x but what balances others of the level, and all optima of the level have it.
void fix_violated(const Level& rows, const Eigen::VectorXd& x, const RowSet& fixed, double rank,
                  LevelConditions& level);

/// μ ≥ 0 that minimises ‖A μ − b‖ (Lawson and Hanson 1974, ch. 23).
[[nodiscard]] Eigen::VectorXd non_negative_least_squares(const Eigen::MatrixXd& A,
                                                         const Eigen::VectorXd& b);

}  // namespace surefoot
