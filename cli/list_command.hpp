#pragma once

#include <string>
#include <vector>

namespace surefoot::cli {

/// Selects a part of what is listed.
struct ListFilter {
  std::string about;  ///< how keys of options begin; or the kind of file that a schema is of
  bool json = false;  ///< options or metrics as JSON
  std::string robot = "anymal_b";  ///< whose defaults options and tasks are listed with
};

/// What `list_command` lists: "robots", "stacks", …
[[nodiscard]] const std::vector<std::string>& listable();

/// Prints all things of a kind of these. Returns an ExitCode. Throws Error on an unknown kind, or a
/// filter that makes no sense.
int list_command(const std::string& what, const ListFilter& filter = {});

}  // namespace surefoot::cli
