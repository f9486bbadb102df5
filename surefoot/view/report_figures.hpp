#pragma once

#include "surefoot/view/run_data.hpp"

#include <string>

/// The report's figures, each an SVG image; empty where the log has nothing for it.
namespace surefoot::report {

/// The paper's Fig. 4: desired and true centre of mass, and the error between them.
[[nodiscard]] std::string com_figure(const RunData& run);
/// The paper's Fig. 6: errors of orientation and height, hip–foot distances with their limits,
/// stance phases.
[[nodiscard]] std::string adaptation_figure(const RunData& run);
/// Footprints, path of the centre of mass and support polygons, seen from above.
[[nodiscard]] std::string footprint_figure(const RunData& run);
/// Joint torques against their limits.
[[nodiscard]] std::string torque_figure(const RunData& run);
/// What the planner did and when.
[[nodiscard]] std::string event_figure(const RunData& run);
/// Normal force of each foot.
[[nodiscard]] std::string force_figure(const RunData& run);
/// Residual of each level over time, and the inequality rows that were active.
[[nodiscard]] std::string residual_figure(const RunData& run);
[[nodiscard]] std::string active_rows_figure(const RunData& run);
/// Histogram of the time per tick.
[[nodiscard]] std::string timing_figure(const RunData& run);

}  // namespace surefoot::report
