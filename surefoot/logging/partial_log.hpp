#pragma once

#include <string>

namespace surefoot::logging {

/// Path of an unfinished log.
[[nodiscard]] std::string partial_path(const std::string& path);

/// The log of an unfinished or cut-off run next to `path`; empty without one.
[[nodiscard]] std::string existing_partial(const std::string& path);

}  // namespace surefoot::logging
