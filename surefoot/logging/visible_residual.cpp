#include "surefoot/logging/visible_residual.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace surefoot::logging {
namespace {

/// Smallest visible residuals by unit, at scale 1.
constexpr double kOtherUnits = 0.05;
constexpr double kSlowed = 1.5;  // of a tip that its slow joints let lag, m/s² and rad/s² together
constexpr std::array<std::pair<std::string_view, double>, 4> kVisible{
    {{"m/s²", 0.02}, {"rad/s²", 0.05}, {"N·m", 0.1}, {"N", 0.5}}};

}  // namespace

double visible_residual(std::string_view level_name, std::string_view unit, const Scale& scale) {
  if (level_name.ends_with("_minimisation") || level_name == "arm_rest")
    return std::numeric_limits<double>::quiet_NaN();
  if (level_name == "arm_tip") return kSlowed;
  const auto found = std::ranges::find(kVisible, unit, &std::pair<std::string_view, double>::first);
  return scale.of(unit) * (found == kVisible.end() ? kOtherUnits : found->second);
}

}  // namespace surefoot::logging
