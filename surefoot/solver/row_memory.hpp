#pragma once

#include "surefoot/solver/hierarchy.hpp"

#include <cstddef>
#include <vector>

namespace surefoot::solver {

/// Remembers the active side of every row, by the name of its level and its id.
class RowMemory {
 public:
  explicit RowMemory(const Hierarchy& capacity);

  void forget();

  /// The remembered sides of a level's rows, 0 if unknown; `side` has an element for each row. `k`
  /// is the level's current place.
  void recall(std::size_t k, const Level& level, signed char* side);

  /// Replaces the memory of level `k`, which must have been recalled.
  void remember(std::size_t k, const Level& level, const signed char* side);
  void forget_from(std::size_t k);

 private:
  struct LevelMemory {
    std::size_t name = 0;  // hash
    std::size_t num_rows = 0;
    bool is_same = false;  // the level recalled last had these rows
    std::vector<int> id;
    std::vector<signed char> side;
  };
  [[nodiscard]] const LevelMemory* find(std::size_t k, std::size_t name) const;
  [[nodiscard]] static bool has_rows_of(const LevelMemory& memory, const Level& level);

  std::vector<LevelMemory> levels_;
};

}  // namespace surefoot::solver
