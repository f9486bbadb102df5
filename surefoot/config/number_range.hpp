#pragma once

#include <string>

namespace surefoot::config {

/// Largest magnitude of a number in a hierarchy file: larger ones have no finite square.
inline constexpr double kLargestNumber = 1e100;
/// Least magnitude of the largest element of a nonzero row: smaller rows would have no effect.
inline constexpr double kSmallestRow = 1e-100;

/// Error message for rows of A that have bounds.
inline constexpr const char* kRowsWithBounds =
    "rows with bounds are those of D, lower ≤ D x ≤ f; write D instead of A, and f instead of "
    "upper";

/// Error message after the name of such an element or row; `number` as given.
[[nodiscard]] inline std::string too_large(const std::string& number) {
  return "is " + number + ", too large to compute with; expected at most 1e100 either way";
}
[[nodiscard]] inline std::string too_small(const std::string& number) {
  return "has nothing larger than " + number +
         ", too small to compute with; expected at least 1e-100, or zeros only";
}

/// Error message after the name of an invalid weight or damping.
[[nodiscard]] inline std::string not_positive(const std::string& number) {
  return "is " + number + "; expected a number above 0, at most 1e100";
}

/// Does a weight make a nonzero row zero by underflow?
[[nodiscard]] inline bool is_weighted_away(double largest, double weight) {
  return largest != 0.0 && weight * largest == 0.0;
}
/// Error message after the name of such a weight.
[[nodiscard]] inline std::string weighted_away(const std::string& weight, const std::string& row) {
  return "is " + weight + " and makes zeros of " + row +
         ", too small to compute with; expected an element of at least 1e-100 in the weighted row";
}

}  // namespace surefoot::config
