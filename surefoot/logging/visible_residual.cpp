#include "surefoot/logging/visible_residual.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

namespace surefoot::logging {
namespace {

/// Smallest visible residuals by unit.
constexpr double kOtherUnits = 0.05;
constexpr std::array<std::pair<std::string_view, double>, 4> kVisible{
    {{"m/s²", 0.02}, {"rad/s²", 0.05}, {"N·m", 0.1}, {"N", 0.5}}};

}  // namespace

double visible_residual(std::string_view level_name, std::string_view unit) {
  if (level_name.ends_with("_minimisation") || level_name == "arm_rest") return kNaN;
  const auto found = std::ranges::find(kVisible, unit, &std::pair<std::string_view, double>::first);
  return found == kVisible.end() ? kOtherUnits : found->second;
}

std::vector<double> visible_residuals(const LogHeader& header) {
  std::vector<double> residuals;
  for (std::ptrdiff_t k = 0; k < std::ssize(header.level_names); ++k)
    residuals.push_back(visible_residual(header.level_name(k), header.level_unit(k)));
  return residuals;
}

}  // namespace surefoot::logging
