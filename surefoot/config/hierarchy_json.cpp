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

Vector read_vector(const Json& array, const Place& place) {
  Vector numbers;
  for (const Json& element : array) {
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
  Vector bounds;
  std::vector<std::string> names;
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

Block read_block(const Json& level, const char* matrix_key, const char* vector_key,
                 std::size_t& unknowns, const Place& place) {
  Block result;
  result.rows = read_matrix(block(level, matrix_key, place), unknowns, place.at(matrix_key));
  result.bounds = read_vector(block(level, vector_key, place), place.at(vector_key));
  if (result.bounds.size() != result.rows.size()) {
    place.fail(std::string(vector_key) + " has " + count(result.bounds.size(), "element") + ", " +
               matrix_key + " has " + count(result.rows.size(), "row") +
               "; expected one element for each row");
  }
  result.names = read_names(level, matrix_key, result.rows.size(), place);
  return result;
}

struct LevelBlocks {
  std::string name, unit;
  Block equal, at_most;
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
    levels.push_back({text_or(level, "name", name), text_or(level, "unit", ""),
                      read_block(level, "A", "b", unknowns, here),
                      read_block(level, "D", "f", unknowns, here)});
  }
  return levels;
}

void append(const Block& block, bool is_equality, Level& level) {
  const Index first_id = level.num_rows();
  Rows rows = level.add(static_cast<Index>(block.rows.size()), static_cast<int>(first_id));
  for (std::size_t i = 0; i < block.rows.size(); ++i) {
    const auto row = static_cast<Index>(i);
    rows.A.row(row) = Eigen::Map<const Eigen::RowVectorXd>(block.rows[i].data(), rows.A.cols());
    rows.upper[row] = block.bounds[i];
    rows.lower[row] = is_equality ? block.bounds[i] : -kInfinity;
  }
}

/// The four blocks of a level while it is written.
struct JsonBlocks {
  Json A = Json::array(), b = Json::array(), A_names = Json::array();
  Json D = Json::array(), f = Json::array(), D_names = Json::array();

  static void add(Json& rows, Json& bounds, const Eigen::RowVectorXd& row, double bound) {
    Json numbers = Json::array();
    for (const double number : row) numbers.push_back(number + 0.0);  // −0 becomes 0
    rows.push_back(std::move(numbers));
    bounds.push_back(bound);
  }
};

}  // namespace

NamedHierarchy parse_hierarchy(std::string_view line, const std::string& place_name) {
  const Place place(place_name);
  std::size_t unknowns = 0;
  const std::vector<LevelBlocks> levels =
      read_levels(parse_json_line(line, place_name, kForm), unknowns, place);
  if (unknowns == 0) place.fail("has no unknowns; expected at least one row in A or D of a level");
  NamedHierarchy result{Hierarchy(static_cast<Index>(unknowns)), {}, {}};
  for (const LevelBlocks& level : levels) {
    const auto rows = static_cast<Index>(level.equal.rows.size() + level.at_most.rows.size());
    const std::size_t k = result.hierarchy.add_level(level.name, rows);
    append(level.equal, true, result.hierarchy.level(k));
    append(level.at_most, false, result.hierarchy.level(k));
    result.units.push_back(level.unit);
    result.row_names.push_back(level.equal.names);
    result.row_names.back().insert(result.row_names.back().end(), level.at_most.names.begin(),
                                   level.at_most.names.end());
  }
  return result;
}

std::string format_hierarchy(const Hierarchy& hierarchy, const RowName& row_name,
                             const std::vector<std::string>& units) {
  Json levels = Json::array();
  for (std::size_t k = 0; k < hierarchy.num_levels(); ++k) {
    const Level& level = hierarchy.level(k);
    JsonBlocks blocks;
    for (Index i = 0; i < level.num_rows(); ++i) {
      const Eigen::RowVectorXd row = level.A().row(i);
      const std::string name = row_name ? row_name(k, i) : "";
      const double lower = level.lower()[i];
      const double upper = level.upper()[i];
      if (lower == upper) {
        JsonBlocks::add(blocks.A, blocks.b, row, upper);
        blocks.A_names.push_back(name);
        continue;
      }
      if (upper < kInfinity) {
        JsonBlocks::add(blocks.D, blocks.f, row, upper);
        blocks.D_names.push_back(name);
      }
      if (lower > -kInfinity) {
        JsonBlocks::add(blocks.D, blocks.f, -row, -lower);
        blocks.D_names.push_back(name);
      }
    }
    Json object = {{"name", level.name()}};
    if (k < units.size() && !units[k].empty()) object["unit"] = units[k];
    object["A"] = std::move(blocks.A);
    object["b"] = std::move(blocks.b);
    object["D"] = std::move(blocks.D);
    object["f"] = std::move(blocks.f);
    if (row_name) {
      object["A_names"] = std::move(blocks.A_names);
      object["D_names"] = std::move(blocks.D_names);
    }
    levels.push_back(std::move(object));
  }
  return Json{{"levels", std::move(levels)}}.dump();
}

}  // namespace surefoot
