#pragma once

#include "surefoot/solver/hierarchy.hpp"
#include "surefoot/solver/optimality_conditions.hpp"

#include <vector>

namespace surefoot::solver {

/// Rows without duplicates, which are listed with the row they repeat.
struct DistinctRows {
  RowSet rows;
  std::vector<std::vector<RowIndex>> same;  ///< by row

  /// Number of a row or of the one it repeats; the count of rows if it is missing.
  [[nodiscard]] Eigen::Index place_of(RowIndex at) const;
};

/// Signed violation of row i of a set at x, along the set's row of length 1.
[[nodiscard]] double missed(const RowSet& set, Eigen::Index i, const Hierarchy& hierarchy,
                            const Eigen::VectorXd& x);

/// Duplicates in E: parallel rows with the same violation, if any.
/// Allocates.
[[nodiscard]] DistinctRows distinct_fixed(const RowSet& fixed, const Hierarchy& hierarchy,
                                          const Eigen::VectorXd& x);

/// Duplicates in T: rows of the same direction at their bound, or with
/// the same violation. Allocates.
[[nodiscard]] DistinctRows distinct_touching(const RowSet& touching, const Hierarchy& hierarchy,
                                             const Eigen::VectorXd& x);

/// Of both: all rows that are held or at their bound, pushing or not.
/// Allocates.
[[nodiscard]] DistinctRows held_rows(const RowSet& fixed, const RowSet& touching,
                                     const Hierarchy& hierarchy, const Eigen::VectorXd& x);

}  // namespace surefoot::solver
