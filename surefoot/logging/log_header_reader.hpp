#pragma once

#include "surefoot/logging/log_header.hpp"

#include <string>

namespace surefoot::logging {

/// The header of the log at `path` from its attachment header.json, without `row_name` and
/// attachments. Throws FileError, with advice, if it is damaged, incomplete or of another major
/// version.
[[nodiscard]] LogHeader read_log_header(const std::string& path, const std::string& text);

}  // namespace surefoot::logging
