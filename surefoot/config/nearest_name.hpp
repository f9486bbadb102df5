#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace surefoot::config {

/// End of an error message about an unknown name: a similar valid name, and all valid ones.
///
///     did you mean "apex"? Valid are: apex, armed_after, …
[[nodiscard]] std::string valid_names(std::string_view given,
                                      const std::vector<std::string>& valid);

}  // namespace surefoot::config
