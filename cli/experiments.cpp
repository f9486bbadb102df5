#include "cli/experiments.hpp"

namespace surefoot {

const std::vector<Experiment>& experiments() {
  static const std::vector<std::string> kWalk{"com_error_max_m", "com_lateral_sway_m", "speed_mps"};
  static const std::vector<std::string> kStep{"goal_reached", "max_tilt_rad", "torque_max_nm",
                                              "com_error_max_m"};
  static const std::vector<std::string> kOutcome{"reason", "distance_m", "com_error_max_m"};
  static const std::vector<std::string> kTorque{"torque_step_max_nm"};
  static const std::vector<Experiment> kExperiments{
      {.name = "walk_flat", .scenario = "walk_flat", .assignments = {}, .shown = kWalk},
      {.name = "walk_flat_sea", .scenario = "walk_flat_sea", .assignments = {}, .shown = kWalk},
      {.name = "step_down",
       .scenario = "step_down",
       .assignments = {},
       .seeds = true,
       .shown = kStep},
      {.name = "step_down_regular_stack",
       .scenario = "step_down_regular_stack",
       .assignments = {},
       .seeds = true,
       .shown = {"goal_reached", "reason"}},
      {.name = "step_down_without_limits",
       .scenario = "step_down_without_limits",
       .assignments = {},
       .seeds = true,
       .shown = {"goal_reached", "reason"},
       .as_found = true},
      {.name = "step_up", .scenario = "step_up", .assignments = {}, .shown = kStep},
      {.name = "manipulability_standing",
       .scenario = "manipulability_standing",
       .assignments = {},
       .shown = {"base_height_end_m"}},
      {.name = "manipulability",
       .scenario = "manipulability",
       .assignments = {},
       .shown = {"base_height_end_m", "com_error_max_m"}},
      {.name = "slope_up",
       .scenario = "slope_up",
       .assignments = {},
       .shown = kOutcome,
       .as_found = true},
      {.name = "slope_along",
       .scenario = "slope_along",
       .assignments = {},
       .shown = kOutcome,
       .as_found = true},
      {.name = "slope_down",
       .scenario = "slope_down",
       .assignments = {},
       .shown = kOutcome,
       .as_found = true},
      {.name = "push", .scenario = "push", .assignments = {}, .shown = kOutcome, .as_found = true},
      {.name = "slippery",
       .scenario = "slippery",
       .assignments = {},
       .shown = kOutcome,
       .as_found = true},
      {.name = "torque_continuity",
       .scenario = "torque_continuity",
       .assignments = {},
       .shown = kTorque},
      {.name = "torque_continuity_without_ramps",
       .scenario = "torque_continuity",
       .assignments = {"planner.force.ramps=false"},
       .shown = kTorque,
       .as_found = true},
  };
  return kExperiments;
}

}  // namespace surefoot
