// Levels of the stack come and go while the robot stands or walks.
#include "tests/scenarios/loop.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace surefoot {
namespace {

using test::Loop;

constexpr double kSwitch = 2.0, kWatched = 0.6;  // [s]

/// Torques commanded from the tick before the switch on.
std::vector<JointVector> torques(const std::vector<std::string>& changes) {
  Loop loop(test::scenario("walk_flat", changes));
  loop.run_until(kSwitch - 1e-6);
  std::vector<JointVector> commands{loop.record().command.torque};
  while (loop.truth().time < kSwitch + kWatched) {
    (void)loop.tick();
    commands.push_back(loop.record().command.torque);
    EXPECT_EQ(loop.record().command.mode, CommandMode::optimal);
  }
  return commands;
}

/// Largest change of a torque from one tick to the next [N·m].
double largest_step(const std::vector<JointVector>& commands) {
  double largest = 0.0;
  for (std::size_t i = 1; i < commands.size(); ++i) {
    largest = std::max(largest, (commands[i] - commands[i - 1]).cwiseAbs().maxCoeff());
  }
  return largest;
}

struct Case {
  const char* what;
  std::vector<std::string> before;  // what else is changed in the scenario
  std::string earlier;              // switches before the one that is watched
  std::string change;               // "add: [...]"
};

class LevelSwitchOf : public testing::TestWithParam<Case> {
 protected:
  static std::vector<std::string> with(const std::string& switches) {
    std::vector<std::string> changes = GetParam().before;
    changes.push_back("stack_switches=[" + switches + "]");
    return changes;
  }
  static std::string change(double duration) {
    return GetParam().earlier + "{time: 2, " + GetParam().change +
           ", duration: " + std::to_string(duration) + "}";
  }
};

TEST_P(LevelSwitchOf, MakesTheTorquesStepHardlyMoreThanTheyDoAnyway) {
  const std::string never = GetParam().earlier + "{time: 90, remove: [torso_yaw]}";
  const std::vector<JointVector> as_ever = torques(with(never));
  const std::vector<JointVector> at_once = torques(with(change(0.0)));
  const std::vector<JointVector> slowly = torques(with(change(0.5)));
  // Up to the switch all three are the same: what differs at its tick is the jump.
  double jump = 0.0;
  for (std::size_t i = 0; i < 3; ++i)
    jump = std::max(jump, (at_once[i] - as_ever[i]).cwiseAbs().maxCoeff());
  EXPECT_GT(jump, 0.5) << "nothing to smooth";
  EXPECT_LE(largest_step(slowly), 1.1 * largest_step(as_ever) + 0.05 * jump);
}

const std::vector<std::string> kStanding{"user=[{time: 0, walk: false}]"};

INSTANTIATE_TEST_SUITE_P(, LevelSwitchOf,
                         testing::Values(Case{"StandingWithoutForceMinimisation", kStanding, "",
                                              "remove: [contact_force_minimisation]"},
                                         Case{"WalkingWithoutForceMinimisation",
                                              {},
                                              "",
                                              "remove: [contact_force_minimisation]"}),
                         [](const auto& of) { return std::string(of.param.what); });

}  // namespace
}  // namespace surefoot
