#pragma once

#include <Eigen/Core>

#include <cmath>
#include <limits>

namespace surefoot::solver {

/// A number of about 32 digits, the sum of two doubles (Dekker 1971; Knuth, TAOCP 2, 4.2.2): for
/// checks beyond the rounding of doubles, with Eigen's decompositions. Overflow gives NaN.
struct DoubleDouble {
  double high = 0.0, low = 0.0;  ///< |low| ≤ half a unit in the last place of high

  DoubleDouble() = default;
  DoubleDouble(double number) : high(number) {}  // NOLINT: implicit, like numbers
  DoubleDouble(double h, double l) : high(h), low(l) {}

  explicit operator double() const { return high; }

  DoubleDouble operator-() const { return {-high, -low}; }

  friend DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
    const DoubleDouble s = sum(a.high, b.high), t = sum(a.low, b.low);
    const DoubleDouble u = ordered_sum(s.high, s.low + t.high);
    return ordered_sum(u.high, u.low + t.low);
  }
  friend DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) { return a + (-b); }
  friend DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
    const double product = a.high * b.high;
    const double rest = std::fma(a.high, b.high, -product);
    return ordered_sum(product, rest + (a.high * b.low + a.low * b.high));
  }
  friend DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) {
    const double first = a.high / b.high;
    const DoubleDouble rest = a - b * DoubleDouble(first);
    const double second = rest.high / b.high;
    const double third = (rest - b * DoubleDouble(second)).high / b.high;
    return ordered_sum(first, second) + DoubleDouble(third);
  }
  DoubleDouble& operator+=(const DoubleDouble& b) { return *this = *this + b; }
  DoubleDouble& operator-=(const DoubleDouble& b) { return *this = *this - b; }
  DoubleDouble& operator*=(const DoubleDouble& b) { return *this = *this * b; }
  DoubleDouble& operator/=(const DoubleDouble& b) { return *this = *this / b; }

  friend bool operator==(const DoubleDouble& a, const DoubleDouble& b) {
    return a.high == b.high && a.low == b.low;
  }
  friend bool operator<(const DoubleDouble& a, const DoubleDouble& b) {
    return a.high < b.high || (a.high == b.high && a.low < b.low);
  }
  friend bool operator>(const DoubleDouble& a, const DoubleDouble& b) { return b < a; }
  friend bool operator<=(const DoubleDouble& a, const DoubleDouble& b) {
    return a.high < b.high || (a.high == b.high && a.low <= b.low);
  }
  friend bool operator>=(const DoubleDouble& a, const DoubleDouble& b) { return b <= a; }

  friend DoubleDouble abs(const DoubleDouble& a) { return a.high < 0.0 ? -a : a; }
  friend bool isfinite(const DoubleDouble& a) { return std::isfinite(a.high); }
  friend bool isnan(const DoubleDouble& a) { return std::isnan(a.high); }
  friend bool isinf(const DoubleDouble& a) { return std::isinf(a.high); }
  friend DoubleDouble sqrt(const DoubleDouble& a) {
    if (!(a.high > 0.0)) return {std::sqrt(a.high), 0.0};
    const DoubleDouble root(std::sqrt(a.high));
    return root + (a - root * root) / DoubleDouble(2.0 * root.high);
  }

 private:
  static DoubleDouble ordered_sum(double a, double b) {  // |a| ≥ |b|, or a = 0
    const double s = a + b;
    return {s, b - (s - a)};
  }
  static DoubleDouble sum(double a, double b) {
    const double s = a + b, of_b = s - a;
    return {s, (a - (s - of_b)) + (b - of_b)};
  }
};

}  // namespace surefoot::solver

template <>
struct Eigen::NumTraits<surefoot::solver::DoubleDouble>
    : Eigen::GenericNumTraits<surefoot::solver::DoubleDouble> {
  using Real = surefoot::solver::DoubleDouble;
  using NonInteger = surefoot::solver::DoubleDouble;
  using Nested = surefoot::solver::DoubleDouble;
  using Literal = double;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = 2,
    AddCost = 20,
    MulCost = 10
  };
  static Real epsilon() { return {4.93e-32, 0.0}; }
  static Real dummy_precision() { return {1e-28, 0.0}; }
  static Real highest() { return {std::numeric_limits<double>::max(), 0.0}; }
  static Real lowest() { return {-std::numeric_limits<double>::max(), 0.0}; }
  static int digits10() { return 31; }
};
