#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <vector>

namespace surefoot::config {

/// Ids of a level's rows, each of one row only.
class RowIds {
 public:
  /// False: another row has it.
  [[nodiscard]] bool take(int id) { return taken_.insert(id).second; }

  /// The first of `count` consecutive free ids.
  [[nodiscard]] int first_of(std::ptrdiff_t count) const {
    std::ptrdiff_t first = 0;
    for (const int id : taken_) {
      if (id >= first && id < first + count) first = std::ptrdiff_t{id} + 1;
    }
    return static_cast<int>(first);
  }

  /// Gives rows without ids the free ones of 0, 1, …
  void fill_up(std::size_t rows, std::vector<int>& ids) {
    while (ids.size() < rows) {
      if (take(next_)) ids.push_back(next_);
      ++next_;
    }
  }

  /// Error message for an id that another row has; rows count from 1.
  [[nodiscard]] static std::string taken(const std::string& key, std::size_t row,
                                         const std::string& id) {
    return key + ": element " + std::to_string(row) + " is " + id +
           ", which another row of the level has; expected one that none has";
  }

 private:
  std::set<int> taken_;
  int next_ = 0;
};

}  // namespace surefoot::config
