#include "app/closed_loop.hpp"
#include "surefoot/config/scenario_file.hpp"
#include "surefoot/logging/log_reader.hpp"
#include "tests/logging/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <bit>

namespace surefoot {
namespace {

/// Gives the states that it is handed, whatever the readings.
class PlaybackEstimator final : public StateEstimator {
 public:
  explicit PlaybackEstimator(const RobotState& state) : state_(state) {}
  const RobotState& update(const SensorReading&) noexcept override { return state_; }

 private:
  const RobotState& state_;
};

std::string attachment(const LogHeader& header, const std::string& name) {
  for (const LogAttachment& file : header.attachments) {
    if (file.name == name) return file.data;
  }
  ADD_FAILURE() << "no attachment " << name;
  return "";
}

/// The scenario as the log has it: what was set, its stack, its robot and the robot's URDF. JSON is
/// YAML, so the options are a scenario file.
Scenario scenario_of(const LogHeader& header, const test::TemporaryFolder& folder) {
  test::write_file(folder / "scenario.yaml", header.options);
  test::write_file(folder / "stack.yaml", attachment(header, "resolved_stack.yaml"));
  test::write_file(folder / "robot.urdf", attachment(header, "robot.urdf"));
  std::string robot = attachment(header, "robot.yaml");
  const std::size_t urdf = robot.find("\nurdf:") + 1;
  robot.replace(urdf, robot.find('\n', urdf) - urdf, "urdf: robot.urdf");
  test::write_file(folder / "robot.yaml", robot);
  return load_scenario({folder / "scenario.yaml",
                        0,
                        {"stack=" + (folder / "stack.yaml"), "robot=" + (folder / "robot.yaml")}});
}

/// Ticks of a log whose torques a controller made from it alone does not give bit for bit, and all.
std::pair<int, int> replay(const std::string& path) {
  const test::TemporaryFolder folder;
  LogReader log(path);
  const Scenario scenario = scenario_of(log.header(), folder);
  TickRecord tick;
  Controller controller(scenario.robot, scenario.controller,
                        std::make_unique<PlaybackEstimator>(tick.state));
  int different = 0, ticks = 0;
  for (; log.next(tick); ++ticks) {
    const JointCommand& command = controller.step(tick.reading, tick.user);
    const auto same_bits = [](double a, double b) {
      return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
    };
    const bool same = command.mode == tick.command.mode &&
                      std::equal(command.torque.begin(), command.torque.end(),
                                 tick.command.torque.begin(), same_bits);
    if (!same) ++different;
  }
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
  expect_replayed({"step_down", 3, {"duration=4"}});
}

TEST(LogReplay, also_of_a_stack_over_another_with_gains_from_the_command_line) {
  expect_replayed({"step_down",
                   0,
                   {"duration=4", "stack=terrain_without_limits", "tasks.swing_foot.kp=700",
                    "user=[{time: 0.2, walk: true, velocity: [0.05, 0.0]}]"}});
}

}  // namespace
}  // namespace surefoot
