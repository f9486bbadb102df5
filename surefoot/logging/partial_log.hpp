#pragma once

#include <string>

namespace surefoot {

/// Where a log stands until it is whole.
[[nodiscard]] std::string partial_path(const std::string& path);

/// The log of a run that goes on or was cut off, where it lies beside `path`; empty: none does.
[[nodiscard]] std::string partial_beside(const std::string& path);

}  // namespace surefoot
