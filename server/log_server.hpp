#pragma once

#include "server/live_run.hpp"

#include <string>

namespace surefoot::server {

/// Serves the page on a log until ^C; its link is printed. Throws FileError, with what to do, on a
/// file that is no log of ours or of a newer program, Error where it can't listen.
void serve_log(const std::string& path, const ViewArguments& arguments);

}  // namespace surefoot::server
