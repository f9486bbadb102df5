#include "surefoot/config/hierarchy_json.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/config/json_line.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace surefoot {
namespace {

using Index = Eigen::Index;
using Json = nlohmann::ordered_json;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Squares and their sums stay in the range of doubles.
constexpr double kLargest = 1e100;
constexpr const char* kForm = R"({"levels":[{"A":[[…]],"b":[…],"D":[[…]],"f":[…]},…]})";

/// Where in the file something is, for messages.
class Place {
 public:
  explicit Place(std::string text) : text_(std::move(text)) {}
  [[nodiscard]] Place at(const std::string& part) const { return Place(text_ + ": " + part); }
  [[noreturn]] void fail(const std::string& message) const {
    throw FileError(text_ + ": " + message);
  }

 private:
  std::string text_;
};

std::string quoted(const Json& value) {
  constexpr std::size_t kLongest = 40;
  const std::string text = value.dump();
  return text.size() <= kLongest ? text : text.substr(0, kLongest) + "…";
}

std::string count(std::size_t number, const std::string& thing) {
  return std::to_string(number) + " " + thing + (number == 1 ? "" : "s");
}

using Vector = std::vector<double>;
using Matrix = std::vector<Vector>;

/// A missing block is an empty one.
const Json& block(const Json& level, const char* key, const Place& place) {
  static const Json kEmpty = Json::array();
  const auto found = level.find(key);
  if (found == level.end()) return kEmpty;
  if (!found->is_array())
    place.fail(std::string(key) + " is " + quoted(*found) + "; expected an array");
  return *found;
}

/// `missing` is what null stands for; NaN: null is no number.
Vector read_vector(const Json& array, const Place& place, double missing = std::nan("")) {
  Vector numbers;
  for (const Json& element : array) {
    if (element.is_null() && !std::isnan(missing)) {
      numbers.push_back(missing);
      continue;
    }
    if (!element.is_number()) {
      place.fail("element " + std::to_string(numbers.size() + 1) + " is " + quoted(element) +
                 "; expected a finite number");
    }
    numbers.push_back(element.get<double>());
    if (std::abs(numbers.back()) > kLargest) {
      place.fail("element " + std::to_string(numbers.size()) + " is " + quoted(element) +
                 ", too large to compute with; expected at most 1e100");
    }
  }
  return numbers;
}

/// `unknowns` is 0 until the first row of the line says how many there are.
Matrix read_matrix(const Json& rows, std::size_t& unknowns, const Place& place) {
  Matrix matrix;
  for (const Json& row : rows) {
    const Place here = place.at("row " + std::to_string(matrix.size() + 1));
    if (!row.is_array()) here.fail("is " + quoted(row) + "; expected an array of numbers");
    matrix.push_back(read_vector(row, here));
    if (matrix.back().empty()) here.fail("is empty; expected a number for each unknown");
    if (unknowns == 0) unknowns = matrix.back().size();
    if (matrix.back().size() != unknowns) {
      here.fail("has " + count(matrix.back().size(), "element") + "; the rows before it have " +
                std::to_string(unknowns) + ", one for each unknown");
    }
  }
  return matrix;
}

/// A block of rows and its right-hand side.
struct Block {
  Matrix rows;
  Vector lower, upper;
  std::vector<std::string> names;
  std::vector<int> ids;
};

/// "A 1", "A 2", … where the file gives no names.
std::vector<std::string> read_names(const Json& level, const std::string& matrix_key,
                                    std::size_t rows, const Place& place) {
  const std::string key = matrix_key + "_names";
  const auto found = level.find(key);
  std::vector<std::string> names;
  if (found == level.end()) {
    for (std::size_t i = 1; i <= rows; ++i) names.push_back(matrix_key + " " + std::to_string(i));
    return names;
  }
  const bool is_texts = found->is_array() && std::ranges::all_of(*found, [](const Json& name) {
                          return name.is_string();
                        });
  if (!is_texts || found->size() != rows) {
    place.fail(key + " is " + quoted(*found) + "; expected an array of " + count(rows, "text") +
               ", one for each row of " + matrix_key);
  }
  for (const Json& name : *found) names.push_back(name.get<std::string>());
  return names;
}

/// 0, 1, … from `first` on where the file gives no ids.
std::vector<int> read_ids(const Json& level, const std::string& matrix_key, std::size_t rows,
                          std::size_t first, const Place& place) {
  const std::string key = matrix_key + "_ids";
  const auto found = level.find(key);
  std::vector<int> ids;
  if (found == level.end()) {
    for (std::size_t i = 0; i < rows; ++i) ids.push_back(static_cast<int>(first + i));
    return ids;
  }
  const auto is_id = [](const Json& id) {
    return id.is_number_integer() && id.get<double>() == static_cast<double>(id.get<int>());
  };
  if (!found->is_array() || found->size() != rows || !std::ranges::all_of(*found, is_id)) {
    place.fail(key + " is " + quoted(*found) + "; expected an array of " + count(rows, "integer") +
               ", one for each row of " + matrix_key);
  }
  for (const Json& id : *found) ids.push_back(id.get<int>());
  return ids;
}

Vector read_bounds(const Json& level, const char* key, const Block& block, const char* matrix_key,
                   double missing, const Place& place) {
  Vector bounds = read_vector(surefoot::block(level, key, place), place.at(key), missing);
  if (bounds.size() != block.rows.size()) {
    place.fail(std::string(key) + " has " + count(bounds.size(), "element") + ", " + matrix_key +
               " has " + count(block.rows.size(), "row") + "; expected one element for each row");
  }
  return bounds;
}

/// A x = b.
Block read_equalities(const Json& level, std::size_t& unknowns, const Place& place) {
  Block result;
  result.rows = read_matrix(block(level, "A", place), unknowns, place.at("A"));
  result.upper = result.lower = read_bounds(level, "b", result, "A", std::nan(""), place);
  result.names = read_names(level, "A", result.rows.size(), place);
  result.ids = read_ids(level, "A", result.rows.size(), 0, place);
  return result;
}

/// lower ≤ D x ≤ f; without "lower" every row has an f.
Block read_inequalities(const Json& level, std::size_t first_id, std::size_t& unknowns,
                        const Place& place) {
  Block result;
  result.rows = read_matrix(block(level, "D", place), unknowns, place.at("D"));
  result.lower.assign(result.rows.size(), -kInfinity);
  const bool has_lower = level.contains("lower");
  if (has_lower) result.lower = read_bounds(level, "lower", result, "D", -kInfinity, place);
  const double missing = has_lower ? kInfinity : std::nan("");
  result.upper = read_bounds(level, "f", result, "D", missing, place);
  for (std::size_t i = 0; i < result.rows.size(); ++i) {
    const std::string row = "row " + std::to_string(i + 1) + " of D ";
    if (result.lower[i] == -kInfinity && result.upper[i] == kInfinity)
      place.fail(row + "has no bound; expected a number in lower, in f or in both");
    if (result.lower[i] > result.upper[i]) place.fail(row + "has lower above f");
  }
  result.names = read_names(level, "D", result.rows.size(), place);
  result.ids = read_ids(level, "D", result.rows.size(), first_id, place);
  return result;
}

struct LevelBlocks {
  std::string name, unit;
  Block equal, between;
};

/// A text of a level; what is no text counts as missing.
std::string text_or(const Json& level, const char* key, const std::string& otherwise) {
  const auto given = level.find(key);
  return given != level.end() && given->is_string() ? given->get<std::string>() : otherwise;
}

std::vector<LevelBlocks> read_levels(const Json& line, std::size_t& unknowns, const Place& place) {
  if (!line.is_object() || !line.contains("levels") || !line["levels"].is_array()) {
    place.fail("has no array \"levels\"; expected " + std::string(kForm));
  }
  std::vector<LevelBlocks> levels;
  for (const Json& level : line["levels"]) {
    const std::string name = "level " + std::to_string(levels.size() + 1);
    const Place here = place.at(name);
    if (!level.is_object())
      here.fail("is " + quoted(level) + "; expected an object with A, b, D and f");
    Block equal = read_equalities(level, unknowns, here);
    Block between = read_inequalities(level, equal.rows.size(), unknowns, here);
    levels.push_back({text_or(level, "name", name), text_or(level, "unit", ""), std::move(equal),
                      std::move(between)});
  }
  return levels;
}

void append(const Block& block, Level& level) {
  for (std::size_t i = 0; i < block.rows.size(); ++i) {
    Rows row = level.add(1, block.ids[i]);
    row.A = Eigen::Map<const Eigen::RowVectorXd>(block.rows[i].data(), row.A.cols());
    row.lower[0] = block.lower[i];
    row.upper[0] = block.upper[i];
  }
}

/// A block of a level while it is written.
struct JsonBlock {
  Json rows = Json::array(), lower = Json::array(), upper = Json::array();
  Json names = Json::array(), ids = Json::array();
  bool has_lower = false;

  void add(const Level& level, Index i, const std::string& name) {
    Json numbers = Json::array();
    for (const double number : level.A().row(i)) numbers.push_back(number + 0.0);  // −0 becomes 0
    rows.push_back(std::move(numbers));
    const double low = level.lower()[i], up = level.upper()[i];
    has_lower = has_lower || low > -kInfinity;
    lower.push_back(low > -kInfinity ? Json(low) : Json());
    upper.push_back(up < kInfinity ? Json(up) : Json());
    names.push_back(name);
    ids.push_back(level.id(i));
  }
};

Json to_json(const Level& level, std::size_t k, const RowName& row_name, const std::string& unit) {
  JsonBlock equal, between;
  for (Index i = 0; i < level.num_rows(); ++i) {
    const double lower = level.lower()[i], upper = level.upper()[i];
    if (lower == -kInfinity && upper == kInfinity) continue;  // asks for nothing
    JsonBlock& block = lower == upper ? equal : between;
    block.add(level, i, row_name ? row_name(k, i) : "");
  }
  Json object = {{"name", level.name()}};
  if (!unit.empty()) object["unit"] = unit;
  object["A"] = std::move(equal.rows);
  object["b"] = std::move(equal.upper);
  object["D"] = std::move(between.rows);
  if (between.has_lower) object["lower"] = std::move(between.lower);
  object["f"] = std::move(between.upper);
  if (row_name) {
    object["A_names"] = std::move(equal.names);
    object["D_names"] = std::move(between.names);
  }
  object["A_ids"] = std::move(equal.ids);
  object["D_ids"] = std::move(between.ids);
  return object;
}

}  // namespace

NamedHierarchy parse_hierarchy(std::string_view line, const std::string& place_name) {
  const Place place(place_name);
  std::size_t unknowns = 0;
  const std::vector<LevelBlocks> levels =
      read_levels(parse_json_line(line, place_name, kForm), unknowns, place);
  if (unknowns == 0) place.fail("has no unknowns; expected at least one row in A or D of a level");
  NamedHierarchy result{Hierarchy(static_cast<Index>(unknowns)), {}, {}};
  for (const LevelBlocks& level : levels) {
    const auto rows = static_cast<Index>(level.equal.rows.size() + level.between.rows.size());
    const std::size_t k = result.hierarchy.add_level(level.name, rows);
    append(level.equal, result.hierarchy.level(k));
    append(level.between, result.hierarchy.level(k));
    result.units.push_back(level.unit);
    result.row_names.push_back(level.equal.names);
    result.row_names.back().insert(result.row_names.back().end(), level.between.names.begin(),
                                   level.between.names.end());
  }
  return result;
}

std::string format_hierarchy(const Hierarchy& hierarchy, const RowName& row_name,
                             const std::vector<std::string>& units) {
  Json levels = Json::array();
  for (std::size_t k = 0; k < hierarchy.num_levels(); ++k) {
    levels.push_back(
        to_json(hierarchy.level(k), k, row_name, k < units.size() ? units[k] : std::string()));
  }
  return Json{{"levels", std::move(levels)}}.dump();
}

}  // namespace surefoot
