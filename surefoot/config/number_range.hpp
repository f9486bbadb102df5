#pragma once

#include <string>

namespace surefoot::config {

/// Numbers of hierarchies that are given from outside: beyond it their squares are none.
inline constexpr double kLargestNumber = 1e100;
/// A row has an element of this size, or it is zero: below it would ask for nothing, without a
/// word.
inline constexpr double kSmallestRow = 1e-100;

/// What is wrong with rows of A that have bounds.
inline constexpr const char* kRowsWithBounds =
    "rows with bounds are those of D, lower ≤ D x ≤ f; write D instead of A, and f instead of "
    "upper";

/// What follows the name of such an element or row; `number` as it was given.
[[nodiscard]] inline std::string too_large(const std::string& number) {
  return "is " + number + ", too large to compute with; expected at most 1e100 either way";
}
[[nodiscard]] inline std::string too_small(const std::string& number) {
  return "has nothing larger than " + number +
         ", too small to compute with; expected at least 1e-100, or zeros only";
}

/// What follows the name of a weight or a damping that is none.
[[nodiscard]] inline std::string not_positive(const std::string& number) {
  return "is " + number + "; expected a number above 0, at most 1e100";
}

/// Whether a weight makes zeros of a row that asks for something: no double holds what it would be.
[[nodiscard]] inline bool is_weighted_away(double largest, double weight) {
  return largest != 0.0 && weight * largest == 0.0;
}
/// What follows the name of such a weight.
[[nodiscard]] inline std::string weighted_away(const std::string& weight, const std::string& row) {
  return "is " + weight + " and makes zeros of " + row +
         ", too small to compute with; expected an element of at least 1e-100 in the weighted row";
}

}  // namespace surefoot::config
