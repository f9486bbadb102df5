#pragma once

#include "surefoot/closed_loop/closed_loop.hpp"

#include <functional>
#include <string>

namespace surefoot::server {

/// `--view` and what belongs to it, as typed.
struct ViewArguments {
  bool view = false;
  int port = 7373;       ///< 0: any that is free
  std::string listen;    ///< address; empty: loopback alone
  std::string token;     ///< for commands; empty: a random one
  int clients = 8;       ///< pages at once
  bool no_wait = false;  ///< for the first of them
};

/// Throws Error where options of the view are given without it.
void check(const ViewArguments& arguments);

/// Whether anything is not as it is by default, but `view` itself.
[[nodiscard]] bool says_where(const ViewArguments& arguments);

/// The last of the runs that were shown.
struct LiveResult {
  closed_loop::RunResult run;
  std::string record_path;  ///< as `ClosedLoopOptions` has it
};

/// Runs a scenario before the eyes of those who open the page, whose link is printed, at real time
/// or what the operator asks for. When the run has ended the page stays, until ^C; the operator may
/// begin the run again, and then its log is another one: "run-2.mcap". `ended` gets the result of
/// each that was not cut off; the last one's is returned. Throws Error as `run_closed_loop`, and
/// where it can't listen.
LiveResult run_live(const config::Scenario& scenario, closed_loop::ClosedLoopOptions options,
                    const ViewArguments& arguments,
                    const std::function<void(const closed_loop::RunResult&)>& ended);

/// Tells where the page is, on standard error.
void tell_link(const std::string& link, const std::string& how_it_ends, const std::string& listen);

}  // namespace surefoot::server
