#pragma once

#include "surefoot/config/scenario.hpp"

#include <string>

namespace surefoot::cli {

/// Cost of a run to the end of its duration.
struct RunCost {
  double ticks = 0.0;
  double wall_seconds = 0.0;  ///< on this machine, from its first ticks [s]
  double memory = 0.0;        ///< that grows with its ticks [bytes]
  double log = 0.0;           ///< about the size of its log, where it is recorded [bytes]
};

/// Throws Error, as a run would at its start, if plant or controller can't be made.
[[nodiscard]] RunCost run_cost(const config::Scenario& scenario);

/// "at most 8000 ticks: about 2 s here, and 23 MB of log with --record"; memory only if it is
/// large.
[[nodiscard]] std::string cost_text(const RunCost& cost);

}  // namespace surefoot::cli
