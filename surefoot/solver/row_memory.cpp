#include "surefoot/solver/row_memory.hpp"

#include <algorithm>

namespace surefoot::solver {

RowMemory::RowMemory(const Hierarchy& capacity) : levels_(capacity.num_levels()) {
  for (std::size_t k = 0; k < levels_.size(); ++k) {
    const auto rows = static_cast<std::size_t>(capacity.level(k).max_rows());
    levels_[k].id.assign(rows, 0);
    levels_[k].side.assign(rows, 0);
  }
}

void RowMemory::forget() { forget_from(0); }

void RowMemory::forget_from(std::size_t k) {
  for (; k < levels_.size(); ++k) levels_[k].name = levels_[k].num_rows = 0;
}

const RowMemory::LevelMemory* RowMemory::find(std::size_t k, std::size_t name) const {
  const auto same_name = [name](const LevelMemory& level) {
    return level.name == name && level.num_rows > 0;
  };
  if (same_name(levels_[k])) return &levels_[k];
  const auto level = std::find_if(levels_.begin(), levels_.end(), same_name);
  return level == levels_.end() ? nullptr : &*level;
}

bool RowMemory::has_rows_of(const LevelMemory& memory, const Level& level) {
  return memory.num_rows == static_cast<std::size_t>(level.num_rows()) &&
         std::equal(memory.id.begin(), memory.id.begin() + level.num_rows(), level.ids());
}

void RowMemory::recall(std::size_t k, const Level& level, signed char* side) {
  const auto rows = static_cast<std::size_t>(level.num_rows());
  const LevelMemory* last = find(k, level.name_hash());
  levels_[k].is_same = false;
  if (last != nullptr && has_rows_of(*last, level)) {
    levels_[k].is_same = last == &levels_[k];
    for (std::size_t i = 0; i < rows; ++i) side[i] = last->side[i];
    return;
  }
  std::fill(side, side + rows, static_cast<signed char>(0));
  if (last == nullptr) return;
  std::size_t next = 0;  // ids mostly keep their order
  for (std::size_t i = 0; i < rows; ++i) {
    for (std::size_t tried = 0; tried < last->num_rows; ++tried) {
      const std::size_t candidate = next;
      next = next + 1 < last->num_rows ? next + 1 : 0;
      if (last->id[candidate] != level.ids()[i]) continue;
      side[i] = last->side[candidate];
      break;
    }
  }
}

void RowMemory::remember(std::size_t k, const Level& level, const signed char* side) {
  LevelMemory& memory = levels_[k];
  if (memory.name == level.name_hash() && level.num_rows() == 0) return;  // it may return
  const bool is_same =
      memory.is_same || (memory.name == level.name_hash() && has_rows_of(memory, level));
  if (!is_same) {
    memory.name = level.name_hash();
    memory.num_rows = static_cast<std::size_t>(level.num_rows());
    std::copy_n(level.ids(), memory.num_rows, memory.id.begin());
  }
  for (std::size_t i = 0; i < memory.num_rows; ++i) memory.side[i] = side[i];
}

}  // namespace surefoot::solver
