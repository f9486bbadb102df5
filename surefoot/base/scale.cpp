#include "surefoot/base/scale.hpp"

#include <array>
#include <string>
#include <utility>

namespace surefoot {
namespace {

/// Exponents of length, mass and time.
struct Dimension {
  double length = 0.0, mass = 0.0, time = 0.0;

  void multiply(const Dimension& by, double power) {
    length += power * by.length;
    mass += power * by.mass;
    time += power * by.time;
  }
};

constexpr std::array<std::pair<std::string_view, Dimension>, 6> kSymbols{{{"m", {1.0, 0.0, 0.0}},
                                                                          {"kg", {0.0, 1.0, 0.0}},
                                                                          {"s", {0.0, 0.0, 1.0}},
                                                                          {"N", {1.0, 1.0, -2.0}},
                                                                          {"Hz", {0.0, 0.0, -1.0}},
                                                                          {"W", {2.0, 1.0, -3.0}}}};
constexpr std::array<std::pair<std::string_view, double>, 2> kPowers{{{"²", 2.0}, {"³", 3.0}}};
constexpr std::string_view kRoot = "√";

/// One factor of a unit, as "s²" or "√Hz".
void multiply(Dimension& all, std::string_view factor, double power) {
  if (factor.starts_with(kRoot)) {
    factor.remove_prefix(kRoot.size());
    power /= 2.0;
  }
  for (const auto& [sign, exponent] : kPowers) {
    if (!factor.ends_with(sign)) continue;
    factor.remove_suffix(sign.size());
    power *= exponent;
  }
  for (const auto& [symbol, dimension] : kSymbols) {
    if (factor == symbol) all.multiply(dimension, power);
  }
}

/// Factors are separated by "·" or, in brackets, by a space; those behind a "/" divide.
Dimension dimension_of(std::string_view unit) {
  Dimension all;
  double power = 1.0;
  std::string factor;
  const auto finish = [&] {
    multiply(all, factor, power);
    factor.clear();
  };
  constexpr std::string_view kDot = "·";
  for (std::size_t i = 0; i < unit.size();) {
    if (unit.substr(i).starts_with(kDot)) {
      finish();
      i += kDot.size();
      continue;
    }
    const char c = unit[i++];
    if (c == '/' || c == ' ') finish();
    if (c == '/') power = -1.0;
    if (c != '/' && c != ' ' && c != '(' && c != ')') factor += c;
  }
  finish();
  return all;
}

}  // namespace

double Scale::of(std::string_view unit) const {
  const Dimension dimension = dimension_of(unit);
  return std::pow(length, dimension.length + dimension.time / 2.0) * std::pow(mass, dimension.mass);
}

}  // namespace surefoot
