#pragma once

#include <string>
#include <vector>

namespace surefoot {

/// Columns of text: the first to the left, the others as wide as their widest entry. Width counts
/// letters, not bytes.
[[nodiscard]] std::string aligned(const std::vector<std::vector<std::string>>& rows);

}  // namespace surefoot
