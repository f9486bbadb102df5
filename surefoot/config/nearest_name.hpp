#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace surefoot::config {

/// The tail of an error message about a name that does not exist: the one that was probably meant,
/// if one is close, and all that would be valid.
///
///     did you mean "apex"? Valid are: apex, armed_after, …
[[nodiscard]] std::string valid_names(std::string_view given,
                                      const std::vector<std::string>& valid);

}  // namespace surefoot::config
