#include "app/log_replay.hpp"

#include "app/closed_loop.hpp"
#include "surefoot/config/scenario_file.hpp"
#include "tests/logging/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

namespace surefoot {
namespace {

/// Ticks of a log whose torques a controller made from it alone does not give bit for bit, and all.
std::pair<int, int> replay(const std::string& path) {
  LogReplay log(path);
  int different = 0, ticks = 0;
  for (; log.step(); ++ticks) different += log.is_same() ? 0 : 1;
  return {different, ticks};
}

void expect_replayed(const ScenarioRequest& request) {
  const test::TemporaryFolder folder;
  ClosedLoopOptions options;
  options.record_path = folder / "run.mcap";
  const RunResult result = run_closed_loop(load_scenario(request), options);
  EXPECT_GT(result.metrics.steps_taken, 0);
  const auto [different, ticks] = replay(folder / "run.mcap");
  EXPECT_EQ(different, 0) << "of " << ticks;
  EXPECT_EQ(ticks, std::lround(result.metrics.duration_s / 0.0025));
}

TEST(LogReplay, a_log_alone_gives_a_controller_with_the_same_torques_bit_by_bit) {
  expect_replayed({"step_down", 3, {"duration=4", "planner.calibration.duration=0"}});
}

TEST(LogReplay, also_of_a_stack_over_another_with_gains_from_the_command_line) {
  expect_replayed({"step_down",
                   0,
                   {"duration=4", "stack=terrain_without_limits", "tasks.swing_foot.kp=700",
                    "planner.calibration.duration=0",
                    "user=[{time: 0.2, walk: true, velocity: [0.05, 0.0]}]"}});
}

}  // namespace
}  // namespace surefoot
