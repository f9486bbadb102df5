#pragma once

#include "surefoot/solver/hierarchy.hpp"
#include "surefoot/solver/optimality_conditions.hpp"

#include <vector>

namespace surefoot {

/// Rows without those that say the same as one before, which are listed with it.
struct DistinctRows {
  RowSet rows;
  std::vector<std::vector<RowIndex>> same;  ///< by row

  /// The number among `rows` of a row, or of the one that says the same; of none their count.
  [[nodiscard]] Eigen::Index place_of(RowIndex at) const;
};

/// By how much row i of a set is beyond its bounds at x, along the set's row of length 1.
[[nodiscard]] double missed(const RowSet& set, Eigen::Index i, const Hierarchy& hierarchy,
                            const Eigen::VectorXd& x);

/// Of E: rows of the same direction, either way, that are missed alike, if at all. Allocates.
[[nodiscard]] DistinctRows distinct_fixed(const RowSet& fixed, const Hierarchy& hierarchy,
                                          const Eigen::VectorXd& x);

/// Of T: rows of the same direction that are at their bound, or are missed alike and hold as they
/// are. Allocates.
[[nodiscard]] DistinctRows distinct_touching(const RowSet& touching, const Hierarchy& hierarchy,
                                             const Eigen::VectorXd& x);

/// Of both: all that hold or are at their bound, whether they push or not. Allocates.
[[nodiscard]] DistinctRows held_rows(const RowSet& fixed, const RowSet& touching,
                                     const Hierarchy& hierarchy, const Eigen::VectorXd& x);

}  // namespace surefoot
