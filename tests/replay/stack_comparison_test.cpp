// What `replay --stack` finds on recorded runs.
#include "surefoot/replay/stack_comparison.hpp"

#include "surefoot/closed_loop/closed_loop.hpp"
#include "surefoot/config/scenario_file.hpp"
#include "surefoot/control/asked_stack.hpp"
#include "tests/logging/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace surefoot::replay {
namespace {

void record(const std::string& path, std::vector<std::string> changes) {
  changes.emplace_back("planner.calibration.duration=0");
  closed_loop::ClosedLoopOptions options;
  options.record_path = path;
  (void)closed_loop::run_closed_loop(config::load_scenario({"step_down", 3, std::move(changes)}),
                                     options);
}

/// Presses the torso up with all that the joints have: torques that the sensors never felt, which
/// in a run are the sign of a drive that fails.
std::string stiff_stack(const test::TemporaryFolder& folder) {
  test::write_file(
      folder / "stiff.yaml",
      "name: stiff\ndescription: presses the torso up\nbase: terrain_adaptation\nlevels:\n"
      "  - equations_of_motion\n  - no_contact_motion\n  - torque_limits\n  - friction_cone\n"
      "  - task: torso_height\n    kp: 4000\n");
  return folder / "stiff.yaml";
}

TEST(StackComparison, IsAnsweredAtEveryTickHoweverFarItsTorquesAreFromThoseThatTheSensorsFelt) {
  const test::TemporaryFolder folder;
  record(folder / "run.mcap", {"duration=2"});
  const StackComparison result = compare_stack(folder / "run.mcap", stiff_stack(folder));
  EXPECT_EQ(result.ticks, 800);
  EXPECT_EQ(result.compared, result.ticks);
  EXPECT_EQ(result.other_unanswered.ticks, 0);
  EXPECT_EQ(result.other_stopped.ticks, 0);
  EXPECT_GT(result.joints[0].rms, 5.0);
}

TEST(StackComparison, AlsoOfARunWithSensorsFindsNoDifferenceOfItsOwnStack) {
  const test::TemporaryFolder folder;
  record(folder / "run.mcap", {"duration=2"});
  const StackComparison result = compare_stack(folder / "run.mcap", "terrain_adaptation");
  EXPECT_EQ(result.compared, 800);
  for (const JointComparison& joint : result.joints) EXPECT_EQ(joint.largest, 0.0);
}

TEST(StackComparison, ItsTablesAreOfTicksThatBothAnswered) {
  const test::TemporaryFolder folder;
  record(folder / "run.mcap",
         {"duration=1.5", "sensors.faults.one={sensor: imu, kind: nan, time: 1.0}"});
  long ticks = 0, not_asked = 0;
  double square = 0.0;
  const StackComparison result =
      compare_stack(folder / "run.mcap", stiff_stack(folder),
                    [&](const TickRecord& logged, const control::StackAnswer* other,
                        const std::vector<OtherLevel>&) {
                      not_asked += other == nullptr ? 1 : 0;
                      EXPECT_TRUE(logged.command.mode != CommandMode::sit || other == nullptr);
                      if (other == nullptr || logged.command.mode != CommandMode::optimal) return;
                      ++ticks;
                      square += std::pow(other->command.torque[0] - logged.command.torque[0], 2);
                    });
  EXPECT_GT(not_asked, 100);
  EXPECT_EQ(result.not_asked.ticks, not_asked);
  EXPECT_NEAR(result.not_asked.first, 1.02, 0.01);
  EXPECT_EQ(result.logged_unanswered.ticks, not_asked);
  EXPECT_EQ(result.compared, ticks);
  EXPECT_EQ(result.ticks, ticks + not_asked);
  EXPECT_NEAR(result.joints[0].rms, std::sqrt(square / static_cast<double>(ticks)), 1e-12);
  for (const JointComparison& joint : result.joints) EXPECT_LT(joint.time, result.not_asked.first);
  ASSERT_TRUE(result.walk_end.has_value());
  EXPECT_EQ(result.other_stopped.ticks, 0) << "the sensor was lost to the run";
}

TEST(StackComparison, TellsOfLevelsThatCameOrWentInTheRun) {
  const test::TemporaryFolder folder;
  record(folder / "run.mcap", {"duration=1",
                               "stack_switches=[{time: 0.2, remove: [torso_yaw], duration: 0.1}, "
                               "{time: 0.5, add: [torso_yaw], duration: 0.1}]"});
  EXPECT_EQ(compare_stack(folder / "run.mcap", "regular").logged_switches, 2);
}

}  // namespace
}  // namespace surefoot::replay
