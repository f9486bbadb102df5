#pragma once

#include "server/live_run.hpp"

#include <string>

namespace surefoot::server {

/// Serves the page of a log until ^C, and prints its link. Throws FileError, with advice, on a file
/// that is not our log or is of a newer program; Error where it can't listen.
void serve_log(const std::string& path, const ViewArguments& arguments);

}  // namespace surefoot::server
