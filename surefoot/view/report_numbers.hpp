#pragma once

#include <string>

namespace surefoot::report {

/// The run's numbers beside the paper's, as a table, and all of them below; from the log's summary.
[[nodiscard]] std::string numbers(const std::string& summary);

/// Whether the run's criteria hold, and why it ended, in a line.
[[nodiscard]] std::string verdict(const std::string& summary);

}  // namespace surefoot::report
