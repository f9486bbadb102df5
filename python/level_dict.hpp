#pragma once

#include "surefoot/base/error.hpp"
#include "surefoot/config/nearest_name.hpp"
#include "surefoot/solver/hierarchy.hpp"

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/string.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

namespace surefoot::python {

namespace nb = nanobind;

/// Rows lower ≤ A x ≤ upper, and the name of the matrix that they were given in.
struct Block {
  std::string key;
  Rows::RowMajor A;
  Eigen::VectorXd lower, upper;
};

/// One level of a hierarchy as the caller gives it: a dict of arrays.
class LevelDict {
 public:
  LevelDict(nb::handle given, std::size_t number) : place_("level " + std::to_string(number)) {
    if (!nb::isinstance<nb::dict>(given)) {
      fail("is " + text(nb::repr(given)) + "; expected a dict with A, b, D, f, lower or upper");
    }
    dict_ = nb::borrow<nb::dict>(given);
    check_keys();
  }

  [[noreturn]] void fail(const std::string& message) const { throw Error(place_ + ": " + message); }

  [[nodiscard]] std::string name() const { return has("name") ? text(dict_["name"]) : place_; }

  /// In the order A, D.
  [[nodiscard]] std::vector<Block> blocks() const {
    const bool is_bounded = has("lower") || has("upper");
    if (has("A") && has("b") == is_bounded) {
      fail("A goes with b (A x = b) or with lower, upper or both (lower ≤ A x ≤ upper)");
    }
    if (!has("A") && (has("b") || is_bounded)) fail("b, lower and upper go with A");
    if (has("D") != has("f")) fail("D goes with f (D x ≤ f)");
    std::vector<Block> blocks;
    if (has("b")) blocks.push_back(block("A", "b", "b"));
    if (is_bounded) blocks.push_back(block("A", "lower", "upper"));
    if (has("D")) blocks.push_back(block("D", "", "f"));
    return blocks;
  }

 private:
  using Array = nb::ndarray<const double, nb::c_contig, nb::device::cpu>;

  static constexpr double kInfinity = std::numeric_limits<double>::infinity();

  static std::string text(nb::handle value) { return nb::cast<std::string>(nb::str(value)); }

  static std::string count(Eigen::Index number, const std::string& thing) {
    return std::to_string(number) + " " + thing + (number == 1 ? "" : "s");
  }

  [[nodiscard]] bool has(const std::string& key) const { return dict_.contains(key.c_str()); }

  void check_keys() const {
    const std::vector<std::string> valid{"A", "b", "D", "f", "lower", "upper", "name"};
    for (const nb::handle key : dict_.keys()) {
      if (std::ranges::find(valid, text(key)) != valid.end()) continue;
      fail("unknown key \"" + text(key) + "\"; " + valid_names(text(key), valid));
    }
  }

  /// Any array or nested list of numbers.
  [[nodiscard]] Array array(const std::string& key, std::size_t axes) const {
    nb::object numbers;
    try {
      numbers = nb::module_::import_("numpy").attr("array")(
          dict_[key.c_str()], nb::arg("dtype") = "float64", nb::arg("order") = "C");
    } catch (const nb::python_error& error) {
      fail(key + ": " + text(error.value()));
    }
    const auto result = nb::cast<Array>(numbers);
    if (result.size() > 0 && result.ndim() != axes) {
      fail(key + " has " + std::to_string(result.ndim()) + " axes; expected " +
           std::to_string(axes));
    }
    return result;
  }

  [[nodiscard]] Rows::RowMajor matrix(const std::string& key) const {
    const Array numbers = array(key, 2);
    if (numbers.size() == 0) return {};
    Rows::RowMajor result = Eigen::Map<const Rows::RowMajor>(
        numbers.data(), static_cast<Eigen::Index>(numbers.shape(0)),
        static_cast<Eigen::Index>(numbers.shape(1)));
    if (!result.allFinite()) fail(key + " holds a number that is not finite");
    return result;
  }

  /// `missing` where there is no such key.
  [[nodiscard]] Eigen::VectorXd vector(const std::string& key, const Block& block,
                                       double missing) const {
    if (!has(key)) return Eigen::VectorXd::Constant(block.A.rows(), missing);
    const Array numbers = array(key, 1);
    Eigen::VectorXd result = Eigen::Map<const Eigen::VectorXd>(
        numbers.data(), static_cast<Eigen::Index>(numbers.size()));
    if (result.size() != block.A.rows()) {
      fail(key + " has " + count(result.size(), "element") + ", " + block.key + " has " +
           count(block.A.rows(), "row") + "; expected one element for each row");
    }
    if (result.hasNaN()) fail(key + " holds NaN");
    return result;
  }

  [[nodiscard]] Block block(const std::string& key, const std::string& lower,
                            const std::string& upper) const {
    Block result{key, matrix(key), {}, {}};
    result.lower = vector(lower, result, -kInfinity);
    result.upper = vector(upper, result, kInfinity);
    for (Eigen::Index i = 0; i < result.A.rows(); ++i)
      check_bounds(result.lower[i], result.upper[i], i);
    return result;
  }

  void check_bounds(double lower, double upper, Eigen::Index row) const {
    if (lower <= upper && lower < kInfinity && upper > -kInfinity) return;
    fail("row " + std::to_string(row) + " has the bounds " + std::to_string(lower) + " and " +
         std::to_string(upper) + ", which nothing can meet");
  }

  std::string place_;
  nb::dict dict_;
};

}  // namespace surefoot::python
