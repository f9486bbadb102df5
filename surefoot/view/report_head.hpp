#pragma once

#include "surefoot/view/outcome.hpp"
#include "surefoot/view/run_data.hpp"

#include <string>

/// The beginning of the page: what was run, how it came out, and how to run it again.
namespace surefoot::report {

/// Name and description of the scenario, and with what it ran.
[[nodiscard]] std::string title(const LogHeader& header);

/// Whether the run's criteria hold, whether its goal was reached, why it ended, and what went wrong
/// on the way; a warning where the log shows only the beginning of a run.
[[nodiscard]] std::string verdict(const RunData& run, const Outcome& outcome);

/// The command that makes the run again, and everything that its result depends on.
[[nodiscard]] std::string provenance(const RunData& run, const Outcome& outcome);

}  // namespace surefoot::report
