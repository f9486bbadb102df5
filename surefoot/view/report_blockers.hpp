#pragma once

#include "surefoot/view/run_data.hpp"

#include <string>

namespace surefoot::report {

/// A table of what gave way to what over the run: each level with the rows of higher levels that
/// cost it most, for how long, and the largest cost. Says so where the log knows it of a part of
/// the ticks only, or where nothing gave way; empty where it knows nothing.
[[nodiscard]] std::string blocker_table(const RunData& run);

}  // namespace surefoot::report
