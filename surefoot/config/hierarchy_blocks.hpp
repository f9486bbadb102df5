#pragma once

#include "surefoot/config/row_ids.hpp"
#include "surefoot/solver/hierarchy.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

/// Reads the blocks of rows in one line of a hierarchy file, for `parse_hierarchy`.
namespace surefoot::config::hierarchy_file {

using Json = nlohmann::ordered_json;

/// A place in the file, for messages.
class Place {
 public:
  explicit Place(std::string text) : text_(std::move(text)) {}
  [[nodiscard]] Place at(const std::string& part) const { return Place(text_ + ": " + part); }
  [[noreturn]] void fail(const std::string& message) const;  ///< throws FileError

 private:
  std::string text_;
};

[[nodiscard]] std::string quoted(const Json& value);
/// "1 row", "2 rows".
[[nodiscard]] std::string count(std::size_t number, const std::string& thing);
void check_keys(const Json& object, const std::vector<std::string>& valid, const Place& place);

using Vector = std::vector<double>;
using Matrix = std::vector<Vector>;

/// A block of rows and its right-hand side.
struct Block {
  Matrix rows;
  Vector lower, upper, weights;
  std::vector<std::string> names;
  std::vector<int> ids;
};

/// A x = b. `unknowns` is 0 until the first row of the line determines it.
[[nodiscard]] Block read_equalities(const Json& level, std::size_t& unknowns, const Place& place);
/// lower ≤ D x ≤ f; one side may be missing; null means no bound.
[[nodiscard]] Block read_inequalities(const Json& level, std::size_t& unknowns, const Place& place);
/// Finite numbers.
[[nodiscard]] Vector read_numbers(const Json& array, const Place& place);
[[nodiscard]] double read_positive(const Json& value, const Place& place);

/// The ids of a level's rows.
class LevelIds : public RowIds {
 public:
  LevelIds(const Json& level, const Place& place) : level_(level), place_(place) {}

  /// Reads the ids of a block, if given.
  void read(const std::string& key, std::size_t rows, std::vector<int>& ids) {
    const auto found = level_.find(key);
    if (found == level_.end()) return;
    if (!found->is_array() || found->size() != rows || !std::ranges::all_of(*found, is_id)) {
      place_.fail(key + " is " + quoted(*found) + "; expected an array of " +
                  count(rows, "integer") + " from -2147483648 to 2147483647, one for each row of " +
                  key.front());
    }
    for (const Json& id : *found) {
      ids.push_back(id.get<int>());
      if (!take(ids.back())) place_.fail(taken(key, ids.size(), quoted(id)));
    }
  }

 private:
  static bool is_id(const Json& id) {
    return id.is_number_integer() && id.get<double>() == static_cast<double>(id.get<int>());
  }

  const Json& level_;
  const Place& place_;
};

}  // namespace surefoot::config::hierarchy_file
