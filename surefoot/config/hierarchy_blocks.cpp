#include "surefoot/config/hierarchy_blocks.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/base/nearest_name.hpp"
#include "surefoot/base/printable.hpp"
#include "surefoot/config/number_range.hpp"
#include "surefoot/math/numbers.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace surefoot::config::hierarchy_file {
namespace {

/// A missing block is an empty one.
const Json& block(const Json& level, const char* key, const Place& place) {
  static const Json kEmpty = Json::array();
  const auto found = level.find(key);
  if (found == level.end()) return kEmpty;
  if (!found->is_array())
    place.fail(std::string(key) + " is " + quoted(*found) + "; expected an array");
  return *found;
}

/// Throws FileError for a number given as a string because it is out of the range of doubles.
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

/// `missing` is the value of null; NaN: null is invalid.
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
                 "; expected a finite number" +
                 (std::isnan(missing) ? "" : ", or null where there is no bound"));
    }
    numbers.push_back(element.get<double>());
    if (std::abs(numbers.back()) > kLargestNumber)
      place.fail("element " + std::to_string(numbers.size()) + " " + too_large(quoted(element)));
  }
  return numbers;
}

double largest_of(const Vector& row) {
  double largest = 0.0;
  for (const double number : row) largest = std::max(largest, std::abs(number));
  return largest;
}

/// Throws FileError for a row whose square underflows: it would silently have no effect.
void check_length(const Vector& row, const Place& place) {
  const double largest = largest_of(row);
  if (largest == 0.0 || largest >= kSmallestRow) return;
  place.fail(too_small(quoted(Json(largest))));
}

/// `unknowns` is 0 until the first row of the line determines it.
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

/// "A 1", "A 2", … if the file gives no names.
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

/// Weights of the rows of a block; 1 if not given. Checks the range of the weighted rows.
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
    if (is_weighted_away(largest_of(row), weight)) {
      here.fail(
          weighted_away(quoted(element), "row " + std::to_string(i + 1) + " of " + matrix_key));
    }
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

Vector read_bounds(const Json& level, const char* key, const Block& block, const char* matrix_key,
                   double missing, const Place& place) {
  Vector bounds = read_vector(hierarchy_file::block(level, key, place), place.at(key), missing);
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

}  // namespace

void Place::fail(const std::string& message) const {
  throw FileError(printable(text_ + ": " + message));
}

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

double read_positive(const Json& value, const Place& place) {
  if (value.is_number() && value.get<double>() > 0.0 && value.get<double>() <= kLargestNumber)
    return value.get<double>();
  place.fail(not_positive(quoted(value)));
}

Block read_equalities(const Json& level, std::size_t& unknowns, const Place& place) {
  Block result;
  result.rows = read_matrix(block(level, "A", place), unknowns, place.at("A"));
  result.upper = result.lower = read_bounds(level, "b", result, "A", std::nan(""), place);
  result.weights = read_weights(level, "A", result, place);
  result.names = read_names(level, "A", result.rows.size(), place);
  return result;
}

Block read_inequalities(const Json& level, std::size_t& unknowns, const Place& place) {
  Block result;
  result.rows = read_matrix(block(level, "D", place), unknowns, place.at("D"));
  result.lower.assign(result.rows.size(), -kInfinity);
  const bool has_lower = level.contains("lower");
  if (has_lower) result.lower = read_bounds(level, "lower", result, "D", -kInfinity, place);
  result.upper.assign(result.rows.size(), kInfinity);
  if (!has_lower || level.contains("f"))
    result.upper = read_bounds(level, "f", result, "D", kInfinity, place);
  for (std::size_t i = 0; i < result.rows.size(); ++i) {
    if (result.lower[i] <= result.upper[i]) continue;
    place.fail("row " + std::to_string(i + 1) + " of D has lower " + quoted(result.lower[i]) +
               " above f " + quoted(result.upper[i]) + "; expected lower ≤ f");
  }
  result.weights = read_weights(level, "D", result, place);
  result.names = read_names(level, "D", result.rows.size(), place);
  return result;
}

Vector read_numbers(const Json& array, const Place& place) { return read_vector(array, place); }

}  // namespace surefoot::config::hierarchy_file
