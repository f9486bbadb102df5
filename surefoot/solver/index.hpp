#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <limits>

namespace surefoot::solver {

using Index = Eigen::Index;

inline constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

/// For containers of the standard library.
inline std::size_t at(Index i) { return static_cast<std::size_t>(i); }

}  // namespace surefoot::solver
