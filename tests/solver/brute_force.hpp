#pragma once

#include "tests/support/random_hierarchy.hpp"

#include <Eigen/Core>

#include <vector>

namespace surefoot::test {

/// Residuals of the lexicographic optimum, by trying for each level every choice of rows that
/// count, rows held at a bound, and rows that are ignored. For tiny problems: exponential in the
/// rows.
std::vector<double> brute_force_residuals(Eigen::Index unknowns, const HierarchyData& levels);

}  // namespace surefoot::test
