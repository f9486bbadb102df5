#pragma once

#include <string>
#include <vector>

namespace surefoot::cli {

/// What `surefoot list` can list.
[[nodiscard]] const std::vector<std::string>& listable();

/// What of it, for options and schemas alone.
struct ListFilter {
  std::string about;  ///< how keys of options begin; or the kind of file that a schema is of
  bool json = false;  ///< options as JSON
};

/// Prints what there is, as `listable()` names it. Returns an ExitCode. Throws Error on a filter
/// that makes no sense.
int list_command(const std::string& what, const ListFilter& filter = {});

}  // namespace surefoot::cli
