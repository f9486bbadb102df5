#pragma once

#include "surefoot/view/report.hpp"

#include <string>

namespace surefoot::report {

/// The pictures as HTML, with everything inside; a note where there are none, nothing where nobody
/// asked for any.
[[nodiscard]] std::string pictures(const ReportPictures& pictures);

/// Bytes as base64 (RFC 4648).
[[nodiscard]] std::string base64(const std::string& bytes);

}  // namespace surefoot::report
