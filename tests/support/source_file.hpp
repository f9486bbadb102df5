#pragma once

#include <string>

namespace surefoot::test {

/// Path of a file of the source tree, `name` being relative to its root.
[[nodiscard]] std::string source_file(const std::string& name);

}  // namespace surefoot::test
