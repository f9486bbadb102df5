#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <string_view>

namespace surefoot::config {

/// One line of JSON as other programs write it. What is no number of JSON but stands where one
/// could, NaN, Infinity and numbers beyond the range of doubles, comes as a text, so that whoever
/// reads it can say where it stands. Throws FileError with `place` in front for what isn't JSON,
/// for a key that an object has twice, and for lines nested deeper than 64.
[[nodiscard]] nlohmann::ordered_json parse_json_line(std::string_view line,
                                                     const std::string& place,
                                                     const std::string& expected);

}  // namespace surefoot::config
