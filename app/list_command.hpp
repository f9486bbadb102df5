#pragma once

#include <string>
#include <vector>

namespace surefoot {

/// What `surefoot list` can list.
[[nodiscard]] const std::vector<std::string>& listable();

/// Prints the robots, stacks, scenarios, randomisations or tasks that there are. Returns an
/// ExitCode.
int list_command(const std::string& what);

}  // namespace surefoot
