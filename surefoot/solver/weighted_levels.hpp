#pragma once

#include "surefoot/solver/hierarchy.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace surefoot::solver {

/// The same tasks, weighted instead of strict from one level on, for an honest comparison: the
/// levels before `first` stay as they are, all others become one last level
///
///     min Σₖ wₖ² ‖violation of level k‖²   over the levels k from `first` on
///
/// Row i of level k gets its id plus k · `kIdStride`. Memory is allocated at construction.
class WeightedLevels {
 public:
  static constexpr int kIdStride = 100000;

  /// `weights`, > 0, of the levels from `first` on; missing ones are 1. Unit: inverse of the
  /// level's rows' unit. Throws Error without a level `first`.
  WeightedLevels(const Hierarchy& capacity, std::size_t first, std::vector<double> weights = {},
                 const std::string& name = "weighted");

  /// `hierarchy` must be within the capacity; with other unknowns it is returned as
  /// it is, for the solver to refuse. The reference stays valid until the next call.
  const Hierarchy& update(const Hierarchy& hierarchy) noexcept;

 private:
  std::size_t first_;
  std::vector<double> weights_;
  Hierarchy weighted_;
};

}  // namespace surefoot::solver
