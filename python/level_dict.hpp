#pragma once

#include "surefoot/base/error.hpp"
#include "surefoot/base/nearest_name.hpp"
#include "surefoot/config/number_range.hpp"
#include "surefoot/config/row_ids.hpp"
#include "surefoot/math/numbers.hpp"
#include "surefoot/solver/hierarchy.hpp"

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace surefoot::python {

namespace nb = nanobind;

/// As Python prints it.
inline std::string text(nb::handle value) { return nb::cast<std::string>(nb::str(value)); }
inline std::string text(double number) { return text(nb::float_(number)); }

using Array = nb::ndarray<const double, nb::c_contig, nb::device::cpu>;

/// Any array or nested list of numbers; `fail` is told what is wrong with it.
template <typename Fail>
Array numbers_of(nb::handle given, const std::string& name, std::size_t axes, const Fail& fail) {
  const std::string expected = axes == 2 ? "(rows, unknowns)" : "(rows,)";
  nb::object numbers;
  const nb::module_ numpy = nb::module_::import_("numpy");
  try {
    if (nb::cast<bool>(numpy.attr("iscomplexobj")(numpy.attr("asarray")(given))))
      fail(name + " is complex; expected real numbers of shape " + expected);
    numbers = numpy.attr("array")(given, nb::arg("dtype") = "float64", nb::arg("order") = "C");
  } catch (const nb::python_error& error) {
    fail(name + ": " + text(error.value()) + "; expected numbers of shape " + expected);
  }
  const auto result = nb::cast<Array>(numbers);
  if (result.size() > 0 && result.ndim() != axes) {
    fail(name + " has the shape " + text(numbers.attr("shape")) + "; expected " + expected);
  }
  return result;
}

/// Rows lower ≤ A x ≤ upper, their weights, the name of the matrix that they were given in, and
/// what they are called.
struct Block {
  std::string key;
  std::vector<std::string> names;
  std::vector<int> ids;
  solver::Rows::RowMajor A;
  Eigen::VectorXd lower, upper, weights;
};

/// One level of a hierarchy as the caller gives it: a dict of arrays. Levels count from 1.
class LevelDict {
 public:
  LevelDict(nb::handle given, std::size_t number) : place_("level " + std::to_string(number)) {
    if (!nb::isinstance<nb::dict>(given)) {
      fail("is " + text(nb::repr(given)) + "; expected a dict with A, b, D, lower or f");
    }
    dict_ = nb::borrow<nb::dict>(given);
    check_keys();
    if (has("name") && !nb::isinstance<nb::str>(dict_["name"]))
      fail("name is " + text(nb::repr(dict_["name"])) + "; expected a text");
  }

  [[noreturn]] void fail(const std::string& message) const { throw Error(place_ + ": " + message); }

  [[nodiscard]] std::string name() const { return has("name") ? text(dict_["name"]) : place_; }

  /// Of its rows; empty where there is none.
  [[nodiscard]] std::string unit() const { return has("unit") ? text(dict_["unit"]) : ""; }

  /// 0 where there is none.
  [[nodiscard]] double damping() const {
    if (!has("damping")) return 0.0;
    double damping = 0.0;
    const bool is_number = nb::try_cast(dict_["damping"], damping);
    if (is_number && damping > 0.0 && damping <= config::kLargestNumber) return damping;
    fail("damping " + config::not_positive(text(nb::repr(dict_["damping"]))));
  }

  /// In the order A, D; `ids` gets those of their rows.
  [[nodiscard]] std::vector<Block> blocks(config::RowIds& ids) const {
    const bool has_bounds = has("lower") || has("f");
    if (has("upper") || (has("A") && !has("b") && !has("D") && has_bounds))
      fail(config::kRowsWithBounds + given());
    if (has("A") != has("b")) fail("A goes with b (A x = b)" + given());
    if (has("D") != has_bounds) fail("D goes with lower, f or both (lower ≤ D x ≤ f)" + given());
    for (const std::string matrix : {"A", "D"}) {
      for (const std::string more : {"_weights", "_names", "_ids"})
        if (has(matrix + more) && !has(matrix))
          fail(matrix + more + " goes with " + matrix + given());
    }
    std::vector<Block> blocks;
    if (has("A")) blocks.push_back(block("A", "b", "b"));
    if (has("D")) blocks.push_back(block("D", "lower", "f"));
    for (const Block& each : blocks) {
      for (std::size_t i = 0; i < each.ids.size(); ++i)
        if (!ids.take(each.ids[i]))
          fail(config::RowIds::taken(each.key + "_ids", i + 1, std::to_string(each.ids[i])));
    }
    for (Block& each : blocks) ids.fill_up(static_cast<std::size_t>(each.A.rows()), each.ids);
    return blocks;
  }

 private:
  static std::string count(Eigen::Index number, const std::string& thing) {
    return std::to_string(number) + " " + thing + (number == 1 ? "" : "s");
  }

  [[nodiscard]] bool has(const std::string& key) const { return dict_.contains(key.c_str()); }

  void check_keys() const {
    const std::vector<std::string> valid{"A",       "b",         "D",         "f",       "lower",
                                         "name",    "A_weights", "D_weights", "damping", "unit",
                                         "A_names", "D_names",   "A_ids",     "D_ids"};
    for (const nb::handle key : dict_.keys()) {
      if (text(key) == "upper" || std::ranges::find(valid, text(key)) != valid.end()) continue;
      fail("unknown key \"" + text(key) + "\"; " + valid_names(text(key), valid));
    }
  }

  /// The keys that there are, for a message's tail.
  [[nodiscard]] std::string given() const {
    std::string keys;
    for (const nb::handle key : dict_.keys()) keys += (keys.empty() ? "" : ", ") + text(key);
    return "; given are: " + keys;
  }

  [[nodiscard]] Array array(const std::string& key, std::size_t axes) const {
    return numbers_of(dict_[key.c_str()], key, axes,
                      [this](const std::string& message) { fail(message); });
  }

  [[nodiscard]] solver::Rows::RowMajor matrix(const std::string& key) const {
    const Array numbers = array(key, 2);
    if (numbers.size() == 0) return {};
    solver::Rows::RowMajor result = Eigen::Map<const solver::Rows::RowMajor>(
        numbers.data(), static_cast<Eigen::Index>(numbers.shape(0)),
        static_cast<Eigen::Index>(numbers.shape(1)));
    for (Eigen::Index i = 0; i < result.size(); ++i) {
      const double number = result.data()[i];
      if (std::abs(number) <= config::kLargestNumber) continue;
      const std::string place = key + "[" + std::to_string(i / result.cols()) + ", " +
                                std::to_string(i % result.cols()) + "] ";
      if (std::isfinite(number)) fail(place + config::too_large(text(number)));
      fail(place + "is " + text(number) + "; expected a finite number");
    }
    for (Eigen::Index i = 0; i < result.rows(); ++i) {
      const double largest = result.row(i).lpNorm<Eigen::Infinity>();
      if (largest == 0.0 || largest >= config::kSmallestRow) continue;
      fail(key + "[" + std::to_string(i) + "] " + config::too_small(text(largest)));
    }
    return result;
  }

  /// With numbers in place of None.
  [[nodiscard]] Array array_without_none(const std::string& key, double missing) const {
    const nb::object given = dict_[key.c_str()];
    if (!nb::isinstance<nb::list>(given) && !nb::isinstance<nb::tuple>(given)) return array(key, 1);
    nb::list numbers;
    for (const nb::handle element : given)
      numbers.append(element.is_none() ? nb::object(nb::float_(missing))
                                       : nb::borrow<nb::object>(element));
    return numbers_of(numbers, key, 1, [this](const std::string& message) { fail(message); });
  }

  /// `missing` where there is no such key, and for None unless it is finite.
  [[nodiscard]] Eigen::VectorXd vector(const std::string& key, const Block& block,
                                       double missing) const {
    if (!has(key)) return Eigen::VectorXd::Constant(block.A.rows(), missing);
    const Array numbers =
        std::isfinite(missing) || key == "b" ? array(key, 1) : array_without_none(key, missing);
    Eigen::VectorXd result = Eigen::Map<const Eigen::VectorXd>(
        numbers.data(), static_cast<Eigen::Index>(numbers.size()));
    if (result.size() != block.A.rows()) {
      fail(key + " has " + count(result.size(), "element") + ", " + block.key + " has " +
           count(block.A.rows(), "row") + "; expected one element for each row");
    }
    for (Eigen::Index i = 0; i < result.size(); ++i) {
      const std::string place = key + "[" + std::to_string(i) + "] ";
      if (std::isnan(result[i])) fail(place + "is nan; expected a number");
      if (std::isfinite(result[i]) && std::abs(result[i]) > config::kLargestNumber)
        fail(place + config::too_large(text(result[i])));
    }
    return result;
  }

  [[nodiscard]] Block block(const std::string& key, const std::string& lower,
                            const std::string& upper) const {
    Block result{.key = key,
                 .names = {},
                 .ids = {},
                 .A = matrix(key),
                 .lower = {},
                 .upper = {},
                 .weights = {}};
    result.names = names(result);
    result.ids = one_for_each_row<int>(result, "_ids", "a list of whole numbers");
    result.lower = vector(lower, result, -kInfinity);
    result.upper = vector(upper, result, kInfinity);
    for (Eigen::Index i = 0; i < result.A.rows(); ++i) check_bounds(result, i);
    result.weights = vector(key + "_weights", result, 1.0);
    for (Eigen::Index i = 0; i < result.A.rows(); ++i) check_weight(result, i);
    return result;
  }

  /// "A[0]", "A[1]", … where none are given.
  [[nodiscard]] std::vector<std::string> names(const Block& block) const {
    std::vector<std::string> result =
        one_for_each_row<std::string>(block, "_names", "a list of texts");
    for (std::size_t i = result.size(); i < static_cast<std::size_t>(block.A.rows()); ++i)
      result.push_back(block.key + "[" + std::to_string(i) + "]");
    return result;
  }

  /// What a key says of each row; empty where there is no such key.
  template <typename T>
  [[nodiscard]] std::vector<T> one_for_each_row(const Block& block, const char* ending,
                                                const char* expected) const {
    const std::string key = block.key + ending;
    std::vector<T> result;
    if (!has(key)) return result;
    if (!nb::try_cast(dict_[key.c_str()], result))
      fail(key + " is " + text(nb::repr(dict_[key.c_str()])) + "; expected " + expected);
    if (result.size() == static_cast<std::size_t>(block.A.rows())) return result;
    fail(key + " has " + count(static_cast<Eigen::Index>(result.size()), "element") + ", " +
         block.key + " has " + count(block.A.rows(), "row") +
         "; expected one element for each row");
  }

  /// The weighted row has numbers as any other.
  void check_weight(const Block& block, Eigen::Index row) const {
    const double weight = block.weights[row];
    const std::string place = block.key + "_weights[" + std::to_string(row) + "] ";
    if (!(weight > 0.0 && weight <= config::kLargestNumber))
      fail(place + config::not_positive(text(weight)));
    double largest = block.A.row(row).lpNorm<Eigen::Infinity>();
    if (config::is_weighted_away(largest, weight))
      fail(place +
           config::weighted_away(text(weight), block.key + "[" + std::to_string(row) + "]"));
    largest *= weight;
    if (largest != 0.0 && largest < config::kSmallestRow)
      fail(place + "makes a row that " + config::too_small(text(largest)));
    for (const double bound : {block.lower[row], block.upper[row]})
      if (std::isfinite(bound)) largest = std::max(largest, std::abs(weight * bound));
    if (largest > config::kLargestNumber)
      fail(place + "makes a number that " + config::too_large(text(largest)));
  }

  void check_bounds(const Block& block, Eigen::Index row) const {
    const double lower = block.lower[row];
    const double upper = block.upper[row];
    if (lower <= upper && lower < kInfinity && upper > -kInfinity) return;
    fail(block.key + "[" + std::to_string(row) + "] has the bounds " + text(lower) + " and " +
         text(upper) +
         ", which nothing can meet; expected lower ≤ upper, lower < inf, upper > -inf");
  }

  std::string place_;
  nb::dict dict_;
};

}  // namespace surefoot::python
