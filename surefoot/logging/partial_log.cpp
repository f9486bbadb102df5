#include "surefoot/logging/partial_log.hpp"

#include <filesystem>
#include <system_error>

namespace surefoot::logging {

std::string partial_path(const std::string& path) { return path + ".partial"; }

std::string existing_partial(const std::string& path) {
  std::error_code ignored;
  const std::string partial = partial_path(path);
  return std::filesystem::is_regular_file(partial, ignored) ? partial : "";
}

}  // namespace surefoot::logging
