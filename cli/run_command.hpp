#pragma once

#include "server/live_run.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace surefoot::cli {

/// `surefoot run`, as typed.
struct RunArguments {
  std::string scenario;
  std::optional<std::uint64_t> seed;
  int seeds = 0;  ///< 0: one run
  int jobs = 1;
  std::vector<std::string> assignments;
  std::string record;
  std::string report;
  bool no_pictures = false;  ///< in the report: they take seconds
  std::string video;
  bool json = false;
  bool all = false;    ///< print every metric
  bool check = false;  ///< read the scenario and run nothing
  server::ViewArguments view;
};

/// Runs a scenario once, or once for each of several seeds. Returns an ExitCode; throws Error on
/// wrong input.
int run_command(const RunArguments& arguments);

}  // namespace surefoot::cli
