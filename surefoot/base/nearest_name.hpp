#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace surefoot {

/// End of an error message about an unknown name: a similar valid name, and all valid ones.
///
///     did you mean "apex"? Valid are: apex, armed_after, …
[[nodiscard]] std::string valid_names(std::string_view given,
                                      const std::vector<std::string>& valid);

/// The same where there are many: the nearest alone.
///
///     did you mean "LF_FOOT"? closest: LF_FOOT, RF_FOOT, …
[[nodiscard]] std::string near_names(std::string_view given, const std::vector<std::string>& valid);

}  // namespace surefoot
