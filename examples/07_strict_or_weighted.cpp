// Strict priorities against weights: the same tasks, once in eleven levels, once with all after the
// physics in one level, whose weights somebody had to tune. Down a step of 14 cm.
#include "surefoot/closed_loop.hpp"
#include "surefoot/scenario.hpp"

#include <cstdio>

int main() {
  auto strict = surefoot::config::load_scenario({"step_down", 0, {}});
  auto weighted = strict;
  weighted.controller.stack =
      surefoot::control::weighted_from(weighted.controller.stack, 4);  // after the friction cone
  for (surefoot::control::TaskSpec& task : weighted.controller.stack.levels.back().tasks) {
    if (task.task == "com_xy" || task.task == "swing_foot") task.weight = 10.0;
    if (task.task == "contact_force_minimisation") task.weight = 0.01;  // its rows are in N
  }

  std::printf("%-10s %12s %12s\n", "stack", "COM rms", "tilt max");
  bool all_stand = true;
  for (const auto* scenario : {&strict, &weighted}) {
    const auto result = surefoot::closed_loop::run_closed_loop(*scenario, {});
    std::printf("%-10s %9.2f mm %8.3f rad %s\n", scenario == &strict ? "strict" : "weighted",
                1e3 * result.metrics.com_error_rms_m, result.metrics.max_tilt_rad,
                result.metrics.reason.c_str());
    all_stand = all_stand && (scenario == &weighted || !result.safety_stop);
  }
  return all_stand ? 0 : 1;
}
