#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <string_view>

namespace surefoot::config {

/// Parses one line of JSON. NaN, Infinity and numbers out of the range of doubles become strings,
/// so that the caller can report their place. Throws FileError, beginning with `place`, on invalid
/// JSON, duplicate keys, and nesting deeper than 64 levels.
[[nodiscard]] nlohmann::ordered_json parse_json_line(std::string_view line,
                                                     const std::string& place,
                                                     const std::string& expected);

}  // namespace surefoot::config
