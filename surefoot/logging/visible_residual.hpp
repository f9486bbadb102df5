#pragma once

#include "surefoot/base/scale.hpp"

#include <string_view>

namespace surefoot::logging {

/// Smallest residual, in its unit, at which a level of a robot of this size visibly gave way. NaN:
/// the level wants zero forces or torques, or an arm that reaches at rest, so it always has a
/// residual and never gives way. `arm_tip` always has one, as its joints are slowed.
[[nodiscard]] double visible_residual(std::string_view level_name, std::string_view unit,
                                      const Scale& scale);

}  // namespace surefoot::logging
