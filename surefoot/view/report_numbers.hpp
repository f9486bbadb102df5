#pragma once

#include <string>

namespace surefoot::report {

/// The run's numbers beside the paper's, as a table, and all of them below. From the log's summary;
/// the paper's are those under `paper:` in the options of the log's header.
[[nodiscard]] std::string numbers(const std::string& summary, const std::string& options);

/// Whether the run's criteria hold, and why it ended, in a line.
[[nodiscard]] std::string verdict(const std::string& summary);

}  // namespace surefoot::report
