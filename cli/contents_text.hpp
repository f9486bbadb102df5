#pragma once

#include "cli/log_contents.hpp"

#include <nlohmann/json.hpp>

#include <string>

namespace surefoot::cli {

/// What `info` prints.
[[nodiscard]] std::string contents_text(const std::string& path, const LogContents& contents);
[[nodiscard]] nlohmann::ordered_json contents_json(const std::string& path,
                                                   const LogContents& contents);

}  // namespace surefoot::cli
