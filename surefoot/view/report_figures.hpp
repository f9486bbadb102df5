#pragma once

#include "surefoot/view/axes.hpp"
#include "surefoot/view/run_data.hpp"

#include <string>
#include <vector>

/// The report's figures, each an SVG image; empty where the log has nothing for it.
namespace surefoot::report {

/// Of all figures over time: from the first tick to the end of the last.
[[nodiscard]] plot::Range time_range(const RunData& run);
/// In which the robot calibrates itself on the spot.
[[nodiscard]] std::vector<plot::Range> calibration_times(const RunData& run);
/// True if rows of the limb limits were at a bound at any time.
[[nodiscard]] bool limb_limits_acted(const RunData& run);

/// The paper's Fig. 4: desired and true centre of mass, and the error between them.
[[nodiscard]] std::string com_figure(const RunData& run);
/// How far the believed tilt, velocity and position of the base are off, until the robot stops for
/// good; position and heading count from where it began, as no sensor knows these. Empty without a
/// truth, or where the truth was given to the controller.
[[nodiscard]] std::string estimate_figure(const RunData& run);
/// The paper's Fig. 6: errors of orientation and height, hip–foot distances with their limits,
/// stance phases.
[[nodiscard]] std::string adaptation_figure(const RunData& run);
/// Ground, footprints, path of the centre of mass and support polygons from above; ground, paths of
/// feet, base and centre of mass from the side.
[[nodiscard]] std::string map_figure(const RunData& run);
/// Joint torques against their limits.
[[nodiscard]] std::string torque_figure(const RunData& run);
/// What the planner did and when.
[[nodiscard]] std::string event_figure(const RunData& run);
/// Normal force of each foot.
[[nodiscard]] std::string force_figure(const RunData& run);
/// Residual of each level over time, and the inequalities that acted, by task and leg.
[[nodiscard]] std::string residual_figure(const RunData& run);
[[nodiscard]] std::string active_rows_figure(const RunData& run);
/// Histogram of the time per tick, with the control period.
[[nodiscard]] std::string timing_figure(const RunData& run);

}  // namespace surefoot::report
