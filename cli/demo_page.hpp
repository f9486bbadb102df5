#pragma once

#include <string>
#include <vector>

namespace surefoot {

/// One line of the demo's table.
struct DemoRow {
  std::string name, description, measured, seeds, paper;
  std::string verdict;  ///< "✓", "✗", or "as found"
  std::string report;   ///< path of its report, relative to the page; empty: none
};

/// The overview as one HTML page without network: the table, each line with a link to its report.
[[nodiscard]] std::string demo_page(const std::vector<DemoRow>& rows, const std::string& summary);

}  // namespace surefoot
