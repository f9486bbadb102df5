#pragma once

#include "surefoot/solver/substitution.hpp"
#include "tests/support/random_hierarchy.hpp"

namespace surefoot::test {

/// All x that satisfy the first levels, which are equalities, in an orthonormal basis.
[[nodiscard]] solver::Substitution substitution_of(const HierarchyData& levels,
                                                   std::size_t num_levels);
/// In a skew basis, and from an arbitrary one of them.
[[nodiscard]] solver::Substitution skew_substitution_of(const HierarchyData& levels,
                                                        std::size_t num_levels,
                                                        RandomMatrices& random);

}  // namespace surefoot::test
