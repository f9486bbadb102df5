#pragma once

#include <Eigen/Core>

#include <cstddef>

namespace surefoot {

/// x = offset + basis · y: all x that satisfy the first `num_levels` levels of a hierarchy exactly,
/// and no others.
struct Substitution {
  std::size_t num_levels = 0;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>
      basis;  ///< unknowns × size of y; columns independent, of any length and angle
  Eigen::VectorXd offset;
};

}  // namespace surefoot
