#pragma once

#include <string>
#include <string_view>

namespace surefoot {

/// A text that comes from a file, for a terminal: control characters (ASCII and U+0080 to U+009F in
/// UTF-8), which could move the cursor or change colours, are written as JSON writes them,
/// `\u001b`. Those in `kept` stay.
[[nodiscard]] std::string printable(std::string_view text, std::string_view kept = "");

}  // namespace surefoot
