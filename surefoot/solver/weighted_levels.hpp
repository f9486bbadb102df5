#pragma once

#include "surefoot/solver/hierarchy.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace surefoot {

/// The same tasks, weighted instead of strict from one level on, to compare the two honestly: the
/// levels before `first` stay as they are, all others become one last level
///
///     min Σₖ wₖ² ‖violation of level k‖²   over the levels k from `first` on
///
/// Row i of level k has the id of its own plus k · `kIdStride`. Memory is taken at construction.
class WeightedLevels {
 public:
  static constexpr int kIdStride = 100000;

  /// `weights`, > 0, of the levels from `first` on; where there is none it is 1. Unit: one over
  /// the unit of the level's rows. Throws Error where there is no level `first`.
  WeightedLevels(const Hierarchy& capacity, std::size_t first, std::vector<double> weights = {},
                 const std::string& name = "weighted");

  /// `hierarchy` must be within the capacity; over other unknowns it comes back as it is, for the
  /// solver to refuse. The reference stays valid until the next call.
  const Hierarchy& update(const Hierarchy& hierarchy) noexcept;

 private:
  std::size_t first_;
  std::vector<double> weights_;
  Hierarchy weighted_;
};

}  // namespace surefoot
