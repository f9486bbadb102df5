#pragma once

#include "server/live_run.hpp"

#include <string>

namespace surefoot {

/// `surefoot demo`, as typed.
struct DemoArguments {
  std::string out;  ///< folder of the report; empty: demo/ in the build folder, or here
  int seeds = 10;   ///< of the experiments that are random
  int jobs = 2;
  bool no_pictures = false;  ///< in the reports: they take seconds each
  ViewArguments view;        ///< instead of all this: the step, watched live
};

/// Runs the paper's experiments, prints a table beside the paper's numbers, and writes the reports;
/// with a view it shows one of them instead. Returns an ExitCode: 0 if every experiment came out as
/// it must. Throws Error.
int demo_command(const DemoArguments& arguments);

}  // namespace surefoot
