#include "surefoot/solver/row_memory.hpp"

#include <algorithm>
#include <cstring>
#include <string>

namespace surefoot {
namespace {

/// Of the length, the first and the last eight letters: names that share them cost time only.
std::uint64_t hash(const std::string& name) {
  std::uint64_t first = 0, last = 0;
  const std::size_t size = std::min(name.size(), sizeof first);
  std::memcpy(&first, name.data(), size);
  std::memcpy(&last, name.data() + name.size() - size, size);
  return (first * 0x9e3779b97f4a7c15u ^ last) + name.size();
}

}  // namespace

RowMemory::RowMemory(const Hierarchy& capacity) : levels_(capacity.num_levels()) {
  for (std::size_t k = 0; k < levels_.size(); ++k) {
    const auto rows = static_cast<std::size_t>(capacity.level(k).max_rows());
    levels_[k].id.assign(rows, 0);
    levels_[k].side.assign(rows, 0);
  }
}

void RowMemory::forget() { forget_from(0); }

void RowMemory::forget_from(std::size_t k) {
  for (; k < levels_.size(); ++k) levels_[k].num_rows = 0;
}

const RowMemory::LevelMemory* RowMemory::find(std::size_t k, std::uint64_t name) const {
  if (levels_[k].name == name) return &levels_[k];
  const auto same_name = [name](const LevelMemory& level) { return level.name == name; };
  const auto level = std::find_if(levels_.begin(), levels_.end(), same_name);
  return level == levels_.end() ? nullptr : &*level;
}

void RowMemory::recall(std::size_t k, const Level& level, signed char* side) const {
  const auto rows = static_cast<std::size_t>(level.num_rows());
  std::fill(side, side + rows, static_cast<signed char>(0));
  const LevelMemory* last = find(k, hash(level.name()));
  if (last == nullptr) return;
  std::size_t next = 0;  // ids mostly come in the same order
  for (std::size_t i = 0; i < rows && last->num_rows > 0; ++i) {
    const int id = level.id(static_cast<Eigen::Index>(i));
    for (std::size_t tried = 0; tried < last->num_rows; ++tried) {
      const std::size_t candidate = next;
      next = next + 1 < last->num_rows ? next + 1 : 0;
      if (last->id[candidate] != id) continue;
      side[i] = last->side[candidate];
      break;
    }
  }
}

void RowMemory::remember(std::size_t k, const Level& level, const signed char* side) {
  LevelMemory& memory = levels_[k];
  memory.name = hash(level.name());
  memory.num_rows = static_cast<std::size_t>(level.num_rows());
  for (std::size_t i = 0; i < memory.num_rows; ++i) {
    memory.id[i] = level.id(static_cast<Eigen::Index>(i));
    memory.side[i] = side[i];
  }
}

}  // namespace surefoot
