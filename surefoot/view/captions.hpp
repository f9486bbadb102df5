#pragma once

#include "surefoot/view/run_data.hpp"

#include <string>

/// Captions that depend on what the run's stack has.
namespace surefoot::report {

/// What the bar at the upper edge of figures over time stands for, as HTML; empty without one.
[[nodiscard]] std::string time_note(const RunData& run);
[[nodiscard]] std::string com_caption(const RunData& run);
[[nodiscard]] std::string adaptation_caption(const RunData& run);
[[nodiscard]] std::string map_caption(const RunData& run);
[[nodiscard]] std::string residual_caption(const RunData& run);
[[nodiscard]] std::string timing_caption(const RunData& run);

}  // namespace surefoot::report
