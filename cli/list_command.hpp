#pragma once

#include <string>
#include <vector>

namespace surefoot::cli {

/// Kinds of things that `surefoot list` lists.
[[nodiscard]] const std::vector<std::string>& listable();

/// Selects a part of what is listed.
struct ListFilter {
  std::string about;  ///< how keys of options begin; or the kind of file that a schema is of
  bool json = false;  ///< options or metrics as JSON
  std::string robot = "anymal_b";  ///< whose defaults options and tasks are listed with
};

/// Prints all things of a kind of `listable()`. Returns an ExitCode. Throws Error on a filter
/// that makes no sense.
int list_command(const std::string& what, const ListFilter& filter = {});

}  // namespace surefoot::cli
