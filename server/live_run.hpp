#pragma once

#include "server/web_server.hpp"
#include "surefoot/closed_loop/closed_loop.hpp"

#include <functional>
#include <string>

namespace surefoot::server {

/// `--view` and its options, as typed.
struct ViewArguments {
  bool view = false;
  int port = 7373;       ///< 0: any that is free
  std::string listen;    ///< address; empty: loopback alone
  std::string token;     ///< for commands; empty: a random one
  int clients = 8;       ///< pages at once
  bool no_wait = false;  ///< do not wait for the first page
};

/// Throws Error where its options are given without `--view`.
void check(const ViewArguments& arguments);

/// Whether any option differs from its default, other than `view`.
[[nodiscard]] bool says_where(const ViewArguments& arguments);

/// The last run that was shown.
struct LiveResult {
  closed_loop::RunResult run;
  std::string record_path;  ///< as `ClosedLoopOptions` has it
};

/// Runs a scenario while pages watch, at real time or the operator's speed, and prints their link.
/// The page stays after the run, until ^C. A run that the operator begins again gets another log:
/// "run-2.mcap". `ended` gets the result of each run that was not cut off; the last result is
/// returned. Throws Error as `run_closed_loop`, and where it can't listen.
LiveResult run_live(const config::Scenario& scenario, closed_loop::ClosedLoopOptions options,
                    const ViewArguments& arguments,
                    const std::function<void(const closed_loop::RunResult&)>& ended);

/// The server's options among those of the view.
[[nodiscard]] WebServerOptions server_options(const ViewArguments& arguments);

/// Prints the link of the page on standard error.
void print_link(const std::string& link, const std::string& how_it_ends, const std::string& listen);

}  // namespace surefoot::server
