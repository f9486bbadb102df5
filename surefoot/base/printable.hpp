#pragma once

#include <string>
#include <string_view>

namespace surefoot {

/// Makes text from a file safe for a terminal: writes control characters (ASCII, and U+0080 to
/// U+009F in UTF-8), which could move the cursor or change colours, as in JSON, `\u001b`. Those in
/// `kept` stay.
[[nodiscard]] std::string printable(std::string_view text, std::string_view kept = "");

}  // namespace surefoot
