#pragma once

#include "surefoot/solver/hierarchy.hpp"
#include "surefoot/solver/sweep.hpp"

#include <cstddef>
#include <vector>

namespace surefoot::solver {

/// Owns the arrays of a sweep, aligned and padded for every instruction set.
class SweepMemory {
 public:
  static constexpr int kWidestPack = 8;  ///< doubles: a cache line
  /// The next multiple of the widest pack.
  static constexpr int padded(int size) {
    return (size + kWidestPack - 1) / kWidestPack * kWidestPack;
  }

  /// `more_rows`: room besides the levels' rows.
  explicit SweepMemory(const Hierarchy& capacity, std::size_t more_rows = 0);
  SweepMemory(const SweepMemory&) = delete;
  SweepMemory& operator=(const SweepMemory&) = delete;
  SweepMemory(SweepMemory&& other) noexcept = default;
  SweepMemory& operator=(SweepMemory&& other) noexcept = default;
  ~SweepMemory() = default;

  Sweep sweep;

 private:
  std::vector<double> doubles_;
  std::vector<int> ints_;
  std::vector<signed char> sides_;
  std::vector<const double*> pointers_;
};

/// Appends a level's rows unchecked.
void append_level(Sweep& sweep, const Level& level);

}  // namespace surefoot::solver
