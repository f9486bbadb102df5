#pragma once

#include <Eigen/Core>

#include <cstddef>

namespace surefoot::solver {

/// x = offset + basis · y: exactly the x that satisfy the first `num_levels` levels of a hierarchy.
struct Substitution {
  std::size_t num_levels = 0;
  /// Unknowns × size of y; columns independent, of any length and angle.
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> basis;
  Eigen::VectorXd offset;
};

}  // namespace surefoot::solver
