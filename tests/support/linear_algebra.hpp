#pragma once

#include "surefoot/math/types.hpp"

namespace surefoot::test {

// Eigen's decompositions behind plain functions, so that they are compiled once and not in each
// test.

[[nodiscard]] Eigen::Index rank(const MatX& A);

/// The shortest X of those with the least ‖A X − B‖.
[[nodiscard]] MatX least_squares(const MatX& A, const MatX& B);

/// Largest singular value over the smallest.
[[nodiscard]] double condition(const MatX& A);

}  // namespace surefoot::test
