#include "surefoot/config/hierarchy_json.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/base/printable.hpp"
#include "surefoot/config/json_line.hpp"
#include "surefoot/config/nearest_name.hpp"
#include "surefoot/config/number_range.hpp"
#include "surefoot/solver/extra_rows.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <set>
#include <utility>
#include <vector>

namespace surefoot {
namespace {

using Index = Eigen::Index;
using Json = nlohmann::ordered_json;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Squares and their sums stay in the range of doubles.
constexpr const char* kForm = R"({"levels":[{"A":[[…]],"b":[…],"D":[[…]],"f":[…]},…]})";

/// Where in the file something is, for messages.
class Place {
 public:
  explicit Place(std::string text) : text_(std::move(text)) {}
  [[nodiscard]] Place at(const std::string& part) const { return Place(text_ + ": " + part); }
  [[noreturn]] void fail(const std::string& message) const {
    throw FileError(printable(text_ + ": " + message));
  }

 private:
  std::string text_;
};

std::string quoted(const Json& value) {
  constexpr std::size_t kLongest = 40;
  const std::string text = value.dump();
  std::size_t end = kLongest;
  while (end < text.size() && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;
  return text.size() <= kLongest ? text : text.substr(0, end) + "…";
}

std::string count(std::size_t number, const std::string& thing) {
  return std::to_string(number) + " " + thing + (number == 1 ? "" : "s");
}

void check_keys(const Json& object, const std::vector<std::string>& valid, const Place& place) {
  for (const auto& [key, value] : object.items()) {
    if (std::ranges::find(valid, key) == valid.end())
      place.fail("unknown key " + quoted(Json(key)) + "; " + valid_names(key, valid));
  }
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

/// Of a number that comes as a text because no double holds it.
void check_range(const Json& element, const std::string& what, const Place& place) {
  if (!element.is_string()) return;
  const auto& text = element.get_ref<const std::string&>();
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  const bool has_digits = text.find_first_of("0123456789") != std::string::npos;
  if (!has_digits || *end != '\0') return;
  if (std::isinf(number)) place.fail(what + too_large(text));
  if (number == 0.0) {
    place.fail(
        what + "is " + text +
        ", too small for a double; expected 0 or at least 4.9406564584124654e-324 either way");
  }
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
      check_range(element, "element " + std::to_string(numbers.size() + 1) + " ", place);
      place.fail("element " + std::to_string(numbers.size() + 1) + " is " + quoted(element) +
                 "; expected a finite number");
    }
    numbers.push_back(element.get<double>());
    if (std::abs(numbers.back()) > kLargestNumber)
      place.fail("element " + std::to_string(numbers.size()) + " " + too_large(quoted(element)));
  }
  return numbers;
}

/// A row whose square is no number would ask for nothing, without a word.
void check_length(const Vector& row, const Place& place) {
  double largest = 0.0;
  for (const double number : row) largest = std::max(largest, std::abs(number));
  if (largest == 0.0 || largest >= kSmallestRow) return;
  place.fail(too_small(quoted(Json(largest))));
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
    check_length(matrix.back(), here);
  }
  return matrix;
}

/// A block of rows and its right-hand side.
struct Block {
  Matrix rows;
  Vector lower, upper, weights;
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

double read_positive(const Json& value, const Place& place) {
  if (value.is_number() && value.get<double>() > 0.0 && value.get<double>() <= kLargestNumber)
    return value.get<double>();
  place.fail("is " + quoted(value) + "; expected a number above 0, at most 1e100");
}

/// Those of the rows of a block; 1 without. The weighted rows are numbers as any others.
Vector read_weights(const Json& level, const std::string& matrix_key, const Block& block,
                    const Place& place) {
  const std::string key = matrix_key + "_weights";
  const auto found = level.find(key);
  if (found == level.end()) return Vector(block.rows.size(), 1.0);
  if (!found->is_array() || found->size() != block.rows.size()) {
    place.fail(key + " is " + quoted(*found) + "; expected an array of " +
               count(block.rows.size(), "number") + ", one for each row of " + matrix_key);
  }
  Vector weights;
  for (const Json& element : *found) {
    const std::size_t i = weights.size();
    const Place here = place.at(key).at("element " + std::to_string(i + 1));
    const double weight = weights.emplace_back(read_positive(element, here));
    Vector row = block.rows[i];
    for (double& number : row) number *= weight;
    check_length(row, here.at("the weighted row"));
    for (const double bound : {block.lower[i], block.upper[i]})
      row.push_back(std::isfinite(bound) ? weight * bound : 0.0);
    for (const double number : row) {
      if (std::abs(number) > kLargestNumber)
        here.at("a number of the weighted row").fail(too_large(quoted(Json(number))));
    }
  }
  return weights;
}

/// Ids of a level's rows; none is there twice.
class LevelIds {
 public:
  LevelIds(const Json& level, const Place& place) : level_(level), place_(place) {}

  /// Those of a block, where the file gives them.
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
      if (taken_.insert(ids.back()).second) continue;
      place_.fail(key + ": element " + std::to_string(ids.size()) + " is " + quoted(id) +
                  ", which another row of the level has; expected one that none has");
    }
  }

  /// The first of so many ids in a row that none has.
  [[nodiscard]] int first_of(Index count) const {
    int first = 0;
    for (const int id : taken_) {
      if (id >= first && id < first + count) first = id + 1;
    }
    return first;
  }

  /// 0, 1, … for rows that have none, without those that others have.
  void fill_up(std::size_t rows, std::vector<int>& ids) {
    while (ids.size() < rows) {
      if (taken_.insert(next_).second) ids.push_back(next_);
      ++next_;
    }
  }

 private:
  static bool is_id(const Json& id) {
    return id.is_number_integer() && id.get<double>() == static_cast<double>(id.get<int>());
  }

  const Json& level_;
  const Place& place_;
  std::set<int> taken_;
  int next_ = 0;
};

Vector read_bounds(const Json& level, const char* key, const Block& block, const char* matrix_key,
                   double missing, const Place& place) {
  Vector bounds = read_vector(surefoot::block(level, key, place), place.at(key), missing);
  if (!level.contains(key) && !block.rows.empty()) {
    place.fail(std::string(matrix_key) + " has " + count(block.rows.size(), "row") + " and no " +
               key + "; expected " + key + " with one element for each row");
  }
  if (!level.contains(matrix_key) && !bounds.empty()) {
    place.fail(std::string(key) + " has " + count(bounds.size(), "element") + " and there is no " +
               matrix_key + "; expected " + matrix_key + " with a row for each");
  }
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
  result.weights = read_weights(level, "A", result, place);
  result.names = read_names(level, "A", result.rows.size(), place);
  return result;
}

/// Without "lower" null is no bound that a row can do without.
void check_upper(const Json& level, const Place& place) {
  if (level.contains("lower")) return;
  const Json& upper = block(level, "f", place);
  const auto missing = std::ranges::find_if(upper, &Json::is_null);
  if (missing == upper.end()) return;
  place.at("f").fail("element " + std::to_string(missing - upper.begin() + 1) +
                     " is null, no bound, and there is no lower; expected a finite number, or "
                     "lower beside f");
}

/// lower ≤ D x ≤ f; without "lower" every row has an f.
Block read_inequalities(const Json& level, std::size_t& unknowns, const Place& place) {
  Block result;
  result.rows = read_matrix(block(level, "D", place), unknowns, place.at("D"));
  result.lower.assign(result.rows.size(), -kInfinity);
  const bool has_lower = level.contains("lower");
  if (has_lower) result.lower = read_bounds(level, "lower", result, "D", -kInfinity, place);
  check_upper(level, place);
  result.upper = read_bounds(level, "f", result, "D", kInfinity, place);
  for (std::size_t i = 0; i < result.rows.size(); ++i) {
    const std::string row = "row " + std::to_string(i + 1) + " of D ";
    if (result.lower[i] == -kInfinity && result.upper[i] == kInfinity)
      place.fail(row + "has no bound; expected a number in lower, in f or in both");
    if (result.lower[i] > result.upper[i])
      place.fail(row + "has lower " + quoted(result.lower[i]) + " above f " +
                 quoted(result.upper[i]) + "; expected lower ≤ f");
  }
  result.weights = read_weights(level, "D", result, place);
  result.names = read_names(level, "D", result.rows.size(), place);
  return result;
}

struct LevelBlocks {
  std::string name, unit;
  Block equal, between;
  double damping = 0.0;      ///< 0: none
  int first_damping_id = 0;  ///< of its rows, as many as the level has

  [[nodiscard]] Index num_rows() const {
    return static_cast<Index>(equal.rows.size() + between.rows.size());
  }
};

std::string read_text(const Json& level, const char* key, const std::string& otherwise,
                      const Place& place) {
  const auto given = level.find(key);
  if (given == level.end()) return otherwise;
  if (!given->is_string()) {
    place.fail(std::string(key) + " is " + quoted(*given) + "; expected a text");
  }
  return given->get<std::string>();
}

LevelBlocks read_level(const Json& level, const std::string& name, std::size_t& unknowns,
                       const Place& place) {
  static const std::vector<std::string> kKeys{"name",  "unit",      "A",         "b",       "D",
                                              "f",     "lower",     "A_names",   "D_names", "A_ids",
                                              "D_ids", "A_weights", "D_weights", "damping"};
  if (!level.is_object())
    place.fail("is " + quoted(level) + "; expected an object with A, b, D and f");
  check_keys(level, kKeys, place);
  LevelBlocks result{.name = read_text(level, "name", name, place),
                     .unit = read_text(level, "unit", "", place),
                     .equal = read_equalities(level, unknowns, place),
                     .between = read_inequalities(level, unknowns, place)};
  Block &equal = result.equal, &between = result.between;
  LevelIds ids(level, place);
  ids.read("A_ids", equal.rows.size(), equal.ids);
  ids.read("D_ids", between.rows.size(), between.ids);
  ids.fill_up(equal.rows.size(), equal.ids);
  ids.fill_up(between.rows.size(), between.ids);
  if (const auto damping = level.find("damping"); damping != level.end()) {
    result.damping = read_positive(*damping, place.at("damping"));
    result.first_damping_id = ids.first_of(result.num_rows());
  }
  return result;
}

std::vector<LevelBlocks> read_levels(const Json& line, std::size_t& unknowns, const Place& place) {
  if (!line.is_object()) {
    place.fail("is " + quoted(line) + ", which has no array \"levels\"; expected " + kForm);
  }
  check_keys(line, {"levels", "x_ref"}, place);
  if (!line.contains("levels")) {
    place.fail("has no array \"levels\"; expected " + std::string(kForm));
  }
  if (!line["levels"].is_array()) {
    place.fail("has no array \"levels\" but " + quoted(line["levels"]) + "; expected " + kForm);
  }
  std::vector<LevelBlocks> levels;
  for (const Json& level : line["levels"]) {
    const std::string name = "level " + std::to_string(levels.size() + 1);
    levels.push_back(read_level(level, name, unknowns, place.at(name)));
  }
  return levels;
}

void append(const Block& block, Level& level) {
  for (std::size_t i = 0; i < block.rows.size(); ++i) {
    Rows row = level.add(1, block.ids[i]);
    row.A = Eigen::Map<const Eigen::RowVectorXd>(block.rows[i].data(), row.A.cols());
    row.lower[0] = block.lower[i];
    row.upper[0] = block.upper[i];
    row.weigh(0, block.weights[i]);
  }
}

/// Names of rows that are counted.
void append_names(const std::string& what, Index count, std::vector<std::string>& names) {
  for (Index i = 1; i <= count; ++i) names.push_back(what + " " + std::to_string(i));
}

void append_level(const LevelBlocks& level, const Eigen::VectorXd& x_ref, NamedHierarchy& result) {
  const Index rows = level.num_rows();
  const std::size_t k =
      result.hierarchy.add_level(level.name, level.damping > 0.0 ? 2 * rows : rows);
  append(level.equal, result.hierarchy.level(k));
  append(level.between, result.hierarchy.level(k));
  result.units.push_back(level.unit);
  result.row_names.push_back(level.equal.names);
  std::vector<std::string>& names = result.row_names.back();
  names.insert(names.end(), level.between.names.begin(), level.between.names.end());
  if (level.damping == 0.0) return;
  add_damping(result.hierarchy.level(k), level.damping, x_ref, level.first_damping_id);
  append_names("damping", result.hierarchy.level(k).num_rows() - rows, names);
}

/// What the file calls x_ref; empty where it has none.
Vector read_reference(const Json& line, std::size_t unknowns, const Place& place) {
  const auto found = line.find("x_ref");
  if (found == line.end()) return {};
  if (!found->is_array()) place.fail("x_ref is " + quoted(*found) + "; expected an array");
  const Vector x_ref = read_vector(*found, place.at("x_ref"));
  if (x_ref.size() == unknowns) return x_ref;
  place.fail("x_ref has " + count(x_ref.size(), "element") + "; expected " +
             std::to_string(unknowns) + ", one for each unknown");
}

/// Without a row of any level nobody knows how many unknowns there are.
void check_unknowns(std::size_t num_levels, std::size_t unknowns, const Place& place) {
  if (unknowns > 0) return;
  const std::string expected = "; expected at least one row in A or D of a level";
  if (num_levels == 0) place.fail("levels is empty, so there are no unknowns" + expected);
  const std::string last = std::to_string(num_levels);
  if (num_levels == 1)
    place.at("level 1").fail("has no row in A or D, so there are no unknowns" + expected);
  place.at("levels 1 to " + last)
      .fail("have no row in A or D, so there are no unknowns" + expected);
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
  const Json object = parse_json_line(line, place_name, kForm);
  const std::vector<LevelBlocks> levels = read_levels(object, unknowns, place);
  check_unknowns(levels.size(), unknowns, place);
  const Vector x_ref = read_reference(object, unknowns, place);
  NamedHierarchy result{Hierarchy(static_cast<Index>(unknowns)), {}, {}};
  Eigen::VectorXd reference = Eigen::VectorXd::Zero(static_cast<Index>(unknowns));
  std::ranges::copy(x_ref, reference.begin());
  for (const LevelBlocks& level : levels) append_level(level, reference, result);
  if (x_ref.empty()) return result;
  const std::size_t last = result.hierarchy.add_level("x_ref", reference.size());
  add_reference(result.hierarchy.level(last), reference, 0);
  result.units.emplace_back();
  append_names("x", reference.size(), result.row_names.emplace_back());
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
