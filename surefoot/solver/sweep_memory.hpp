#pragma once

#include "surefoot/solver/hierarchy.hpp"
#include "surefoot/solver/sweep.hpp"

#include <cstddef>
#include <vector>

namespace surefoot {

/// Owns the arrays of a sweep, aligned and padded for every instruction set.
class SweepMemory {
 public:
  /// `more_rows` than the levels have.
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

}  // namespace surefoot
