#pragma once

#include "surefoot/solver/hierarchy.hpp"

#include <Eigen/Core>

#include <vector>

namespace surefoot::solver {

/// A row of a hierarchy.
struct RowIndex {
  std::size_t level = 0;
  Eigen::Index row = 0;

  friend bool operator==(const RowIndex&, const RowIndex&) = default;
};

/// Rows of length 1 with their origin.
struct RowSet {
  explicit RowSet(Eigen::Index unknowns) : rows(0, unknowns) {}
  void add(const Eigen::VectorXd& row, RowIndex from);
  void add(const RowSet& other);

  Eigen::MatrixXd rows;
  std::vector<RowIndex> origin;
};

/// Size of a row at x, u = Σ |aⱼ xⱼ| + ‖a‖ (1 + 1e-3 ‖x‖), the unit of its value. The last part is
/// the solvers' rounding for large x: 1e-11 ‖a‖ ‖x‖ against a tolerance of 1e-8.
[[nodiscard]] double row_unit(const Eigen::Ref<const Eigen::RowVectorXd>& row,
                              const Eigen::VectorXd& x);

/// Optimality conditions of x for a level, see `certify`: the level's gradient g, and its own rows
/// as they bind the levels after it. Allocates.
struct LevelConditions {
  Eigen::VectorXd gradient;  ///< g = Σ vᵢ aᵢ
  double residual = 0.0;     ///< √Σ violation²
  /// Rows uᵢ aᵢ, uᵢ = `row_unit`, that are equalities, violated or at a bound.
  Eigen::MatrixXd in_units;
  double pull = 0.0;      ///< Σ ‖aᵢ‖ |vᵢ| of these rows, plus ‖aᵢ‖² (1 + ‖x‖) of the shortest
  double rounding = 0.0;  ///< of g: 100 ε Σ ‖aᵢ‖ (|vᵢ| + ‖aᵢ‖ (1 + ‖x‖))
  RowSet fixed;           ///< E: equality rows and violated rows
  RowSet touching;        ///< T: satisfied rows at a bound, signed so that T z ≤ 0 keeps them
};

/// `tight`: distance of a row that touches a bound, relative to its `row_unit`.
[[nodiscard]] LevelConditions optimality_conditions(const Hierarchy& hierarchy, std::size_t level,
                                                    const Eigen::VectorXd& x, double tight);

/// Length of each column's part that is orthogonal to all others; 0 if others span it. An error in
/// their sum, divided by it, is the error of the column's coefficient.
[[nodiscard]] Eigen::VectorXd independence(const Eigen::MatrixXd& columns);

/// Indices of the positive multipliers.
[[nodiscard]] std::vector<Eigen::Index> pushing(const Eigen::VectorXd& mu);

/// Multipliers with the least distance from −g = Eᵀ λ + Tᵀ μ, μ ≥ 0, as in `LevelCertificate`.
struct Multipliers {
  Eigen::VectorXd fixed;      ///< λ, one for each row of E
  Eigen::VectorXd touching;   ///< μ, one for each row of T
  double distance = 0.0;      ///< ‖g + Eᵀ λ + Tᵀ μ‖
  double stationarity = 0.0;  ///< the same as in `LevelCertificate`
  /// Rounding of each μ: that of Zᵀ g, plus ten times the remaining distance, divided by the row's
  /// part that is independent of E and other pushing rows. Rounding of g comes from the level's
  /// rows and values, plus 100 ε times the multipliers in E and T, because Z is only as good as
  /// these rows are independent.
  Eigen::VectorXd rounding;
};

/// `rank`: relative length below which a row of E, or of T after projection on E, is dependent.
[[nodiscard]] Multipliers multipliers(const LevelConditions& level, const RowSet& fixed,
                                      const RowSet& touching, double rank);

/// Moves rows with μ positive beyond rounding from T to E: all optima of the level lie on them.
void fix_pushing(const Multipliers& multipliers, RowSet& fixed, RowSet& touching);

/// Moves rows of the level from its T to its E that are violated by less than `tight`, but for
/// certain: the least-squares step of all the level's violated rows, in the directions left by
/// `fixed`, removes less than half of the violation. So it is no error of x but balances other rows
/// of the level, and all optima of the level have it.
void fix_violated(const Level& rows, const Eigen::VectorXd& x, const RowSet& fixed, double rank,
                  LevelConditions& level);

/// μ ≥ 0 that minimises ‖A μ − b‖ (Lawson and Hanson 1974, ch. 23).
[[nodiscard]] Eigen::VectorXd non_negative_least_squares(const Eigen::MatrixXd& A,
                                                         const Eigen::VectorXd& b);

}  // namespace surefoot::solver
