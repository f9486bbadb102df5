#pragma once

#include <string>
#include <vector>

namespace surefoot::config {

/// The kinds of files that have a schema: scenario, randomisation, robot, stack.
[[nodiscard]] const std::vector<std::string>& kinds_of_files();

/// JSON Schema (draft 2020-12) of a kind of file, made from the options that are read from it:
/// keys, types, ranges, names that are valid. What holds between several keys it does not say, and
/// of a scenario it requires no key, as a base may have it.
[[nodiscard]] std::string json_schema(const std::string& kind);

}  // namespace surefoot::config
