// Levels of the stack come and go while the robot stands or walks.
#include "tests/scenarios/loop.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace surefoot {
namespace {

using test::Loop;

constexpr double kSwitch = 2.0, kWatched = 0.6;  // [s]

/// Torques commanded from the tick before the switch on.
std::vector<JointVector> torques(const std::vector<std::string>& changes) {
  std::vector<std::string> all = changes;
  all.emplace_back("planner.calibration.duration=0");
  Loop loop(test::scenario("walk_flat", all));
  loop.run_until(kSwitch - 1e-6);
  std::vector<JointVector> commands{loop.record().command.torque};
  while (loop.truth().time < kSwitch + kWatched) {
    loop.tick();
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
  const std::string never = GetParam().earlier + "{time: 90, " + GetParam().change + "}";
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

/// Levels that go at 2 s and are back at 5 s.
struct Absence {
  const char* what;
  const char* stack;
  const char* levels;  // "[…]"
  std::vector<std::string> before;
};

constexpr double kLying = 0.15;  // height of the base's centre [m]
constexpr double kTipped = 0.7;  // [rad]

struct Outcome {
  bool stays_up = true;
  bool is_optimal = true;        // the command of every tick
  double largest_step = 0;       // of a torque, over the whole run [N·m]
  double step_on_the_way = 0.0;  // between two optima
  double step_beside = 0.0;      // at all other ticks
  double tilt = 0.0;             // [rad]
};

Outcome run(const Absence& absence, const std::string& switches) {
  std::vector<std::string> changes = absence.before;
  changes.push_back(std::string("stack=") + absence.stack);
  changes.push_back("planner.calibration.duration=0");
  if (!switches.empty()) changes.push_back("stack_switches=[" + switches + "]");
  Loop loop(test::scenario("walk_flat", changes));
  Outcome outcome;
  JointVector last = JointVector::Constant(kNumLegJoints, kNaN);
  while (loop.truth().time < 8.0) {
    loop.tick();
    const TickRecord& record = loop.record();
    const double step = (record.command.torque - last).cwiseAbs().maxCoeff();
    last = record.command.torque;
    if (step > outcome.largest_step) outcome.largest_step = step;
    double& here =
        record.hierarchy.transition_share < 1.0 ? outcome.step_on_the_way : outcome.step_beside;
    if (step > here) here = step;
    outcome.is_optimal = outcome.is_optimal && record.command.mode == CommandMode::optimal;
    const double tilt = std::acos((loop.truth().q_SB * Vec3::UnitZ()).z());
    outcome.tilt = std::max(outcome.tilt, tilt);
    outcome.stays_up = outcome.stays_up && tilt < kTipped && loop.truth().p_SB.z() > kLying;
  }
  return outcome;
}

class AbsenceOf : public testing::TestWithParam<Absence> {};

/// Away from 2 s on, back from 4.5 s on.
std::string absence(const std::string& levels, double duration) {
  const std::string end = levels + ", duration: " + std::to_string(duration) + "}";
  return "{time: 2, remove: " + end + ", {time: 4.5, add: " + end;
}

// On the way x = (1 − s) x⁻ + s x⁺, so from one tick to the next
//
//     |Δx| ≤ (1 − s) |Δx⁻| + s |Δx⁺| + Δs |x⁺ − x⁻| ,
//
// the steps of the walk with the levels and without them, and the jump from one to the other times
// Δs, at most 3/2 of a tick over the duration for a smooth step.
TEST_P(AbsenceOf, IsSurvivedWithNoLargerTorqueStepThanThoseOfBothWalksAndAShareOfTheJump) {
  constexpr double kDuration = 0.5, kMostOfATick = 1.5 * 0.0025 / kDuration;
  const std::string levels = GetParam().levels;
  const Outcome with = run(GetParam(), absence(levels, kDuration));
  const Outcome at_once = run(GetParam(), absence(levels, 0.0));
  Absence walk = GetParam();
  walk.before.clear();
  EXPECT_TRUE(with.stays_up) << "tilt " << with.tilt;
  EXPECT_TRUE(with.is_optimal);
  EXPECT_GT(with.step_on_the_way, 0.0);
  const double of_both = std::max(with.step_beside, run(walk, "").largest_step);
  EXPECT_LE(with.step_on_the_way, of_both + kMostOfATick * at_once.largest_step);
}

INSTANTIATE_TEST_SUITE_P(
    , AbsenceOf,
    testing::Values(
        Absence{"LimbLimitsWhileWalking", "terrain_adaptation", "[limb_extension_limits]", {}},
        Absence{"YawWhileWalking", "terrain_adaptation", "[torso_yaw]", {}},
        Absence{"ForceMinimisationWhileWalking",
                "terrain_adaptation",
                "[contact_force_minimisation]",
                {}},
        Absence{"HeightWithinBoundsWhileWalking", "torso_in_bounds", "[torso_height]", {}},
        Absence{
            "RollAndPitchWithinBoundsWhileWalking", "torso_in_bounds", "[torso_roll_pitch]", {}},
        Absence{"HeightWhileStanding", "terrain_adaptation", "[torso_height]", kStanding},
        Absence{"HeightWithinBoundsWhileStanding", "torso_in_bounds", "[torso_height]", kStanding},
        Absence{"RollAndPitchWithinBoundsWhileStanding", "torso_in_bounds", "[torso_roll_pitch]",
                kStanding},
        Absence{"YawWhileStanding", "terrain_adaptation", "[torso_yaw]", kStanding}),
    [](const auto& of) { return std::string(of.param.what); });

}  // namespace
}  // namespace surefoot
