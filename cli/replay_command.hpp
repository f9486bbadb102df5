#pragma once

#include "server/live_run.hpp"

#include <iosfwd>
#include <string>

namespace surefoot::cli {

/// `surefoot replay`, as typed.
struct ReplayArguments {
  std::string log;
  bool verify = false;
  std::string stack;  ///< another hierarchy to ask; empty: none
  bool json = false;
  std::string csv;             ///< file for the ticks of `stack`; empty: none
  server::ViewArguments view;  ///< of the page, where neither is asked for
};

/// `surefoot replay RUN.mcap`: serves a page that shows the log, until ^C. `--verify`: runs the
/// controller again on the logged readings and says whether every torque is the same to the bit.
/// `--stack OTHER`: what another hierarchy would have commanded at each tick. Returns an ExitCode;
/// throws Error on wrong input.
int run_replay(const ReplayArguments& arguments, std::ostream& out);

}  // namespace surefoot::cli
