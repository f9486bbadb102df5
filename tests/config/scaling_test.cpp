// Numbers that are written for ANYmal B become those of another robot.
#include "surefoot/config/robot_file.hpp"
#include "surefoot/config/scenario_file.hpp"
#include "surefoot/config/stack_file.hpp"
#include "surefoot/model/proportions.hpp"
#include "tests/logging/temporary_folder.hpp"
#include "tests/support/messages.hpp"

#include <array>
#include <cmath>

namespace surefoot::config {
namespace {

class Scaling : public testing::Test {
 protected:
  Scenario load(const std::string& text, const std::vector<std::string>& assignments = {}) {
    test::write_file(folder_ / "scenario.yaml", "robot: go1\nstack: walk\n" + text);
    return load_scenario({folder_ / "scenario.yaml", 0, assignments});
  }

  test::TemporaryFolder folder_;
  const Scale go1_ = load_robot("go1").scale;
};

TEST_F(Scaling, OfAnymalBIsOneForAll) {
  const Scale scale = load_robot("anymal_b").scale;
  for (const double ratio :
       {scale.length, scale.mass, scale.half_length, scale.half_width, scale.stride})
    EXPECT_EQ(ratio, 1.0);
  EXPECT_EQ(scale.hip_height, 0.0);
}

TEST_F(Scaling, OfGo1IsThatOfItsLegsAndMass) {
  EXPECT_NEAR(go1_.length, 0.385 / 0.5643, 2e-3);
  EXPECT_NEAR(go1_.mass, 13.1 / 30.475, 2e-3);
  EXPECT_NEAR(go1_.stride, 0.81, 0.02);
}

// Margins go with its legs, so its feet stand no closer than these ask.
TEST_F(Scaling, OfFeetBelowCloseHipsIsThatOfItsLegs) {
  for (const char* name : {"hyq", "aliengo", "spot"}) {
    const Scale scale = load_robot(name).scale;
    EXPECT_DOUBLE_EQ(scale.half_width, 0.85 * scale.length) << name;
  }
  const Scale wide = load_robot("solo12").scale;
  EXPECT_GT(wide.half_width, wide.length);
}

// A wider stance needs more of the knees.
TEST(FeetBelowCloseHips, StandAsCloseAsWeakKneesAsk) {
  model::Proportions robot{.leg = 0.5, .mass = 20.0, .half_length = 0.3, .half_width = 0.1};
  const double torque = 20.0 * kGravity * 0.5;
  robot.knee_torque = 0.25 * torque;
  const Scale strong = model::scale_of(robot);
  EXPECT_DOUBLE_EQ(strong.half_width, 0.85 * strong.length);
  robot.knee_torque = 0.14 * torque;
  EXPECT_DOUBLE_EQ(model::scale_of(robot).half_width, 0.1 / 0.246);
  robot.knee_torque = 0.19 * torque;
  EXPECT_NEAR(model::scale_of(robot).half_width, 0.8 * strong.half_width, 1e-12);
}

// Its thighs stop 15° behind the vertical.
TEST_F(Scaling, OfAStrideIsWhatTheThighsStopsAllow) {
  EXPECT_NEAR(load_robot("hyqreal").scale.stride, 0.75, 0.05);
}

TEST_F(Scaling, NumbersOfAScaledFileGoWithTheRobot) {
  const Scenario scaled = load(
      "scaled: true\nplanner: {swing: {apex: 0.1}, gait: {swing_duration: 0.4}}\n"
      "terrain: {elements: {ground: {shape: steps, height: -0.14}}}\n"
      "user: [{time: 1, walk: true, velocity: [0.2, 0]}]\n"
      "criteria: {com_error_max_m: {max: 0.01}}\n");
  const gaits::PlannerOptions& planner = scaled.controller.planner;
  EXPECT_DOUBLE_EQ(planner.swing.apex, 0.1 * go1_.length);
  EXPECT_DOUBLE_EQ(planner.gait.swing_duration, 0.4 * go1_.time());
  EXPECT_DOUBLE_EQ(scaled.commands[1].time, go1_.time());
  EXPECT_DOUBLE_EQ(scaled.commands[1].user.velocity.x(), 0.2 * go1_.speed() * go1_.stride);
  const auto& box = std::get<simulation::TerrainBox>(scaled.plant.terrain.elements.back());
  EXPECT_NEAR(box.position.z() + 0.5 * box.size.z(), -0.14 * go1_.length, 1e-12);
  EXPECT_DOUBLE_EQ(*scaled.criteria.back().max, 0.01 * go1_.length);
}

TEST_F(Scaling, NumbersOfAnyOtherFileAndOfTheCommandLineStayAsTheyAre) {
  EXPECT_EQ(load("planner: {swing: {apex: 0.1}}\n").controller.planner.swing.apex, 0.1);
  const Scenario assigned = load("scaled: true\n", {"planner.swing.apex=0.1"});
  EXPECT_EQ(assigned.controller.planner.swing.apex, 0.1);
}

TEST_F(Scaling, ABaseIsScaledThoughTheFileOverItIsNot) {
  const Scenario scenario = load("base: walk_flat.yaml\nplanner: {swing: {apex: 0.05}}\n");
  EXPECT_EQ(scenario.controller.planner.swing.apex, 0.05);
  EXPECT_DOUBLE_EQ(scenario.controller.planner.com.zmp_margin, 0.055 * go1_.length);
}

TEST_F(Scaling, DefaultsGoWithTheRobotButThoseOfSensorsDrivesAndClocks) {
  const Scenario scenario = load("");
  const gaits::PlannerOptions& planner = scenario.controller.planner;
  EXPECT_DOUBLE_EQ(planner.reflex.force, 4.0 * go1_.mass);
  EXPECT_DOUBLE_EQ(planner.stance.half_length, 0.36 * go1_.half_length);
  EXPECT_DOUBLE_EQ(planner.stance.half_width, 0.22 * go1_.half_width);
  EXPECT_DOUBLE_EQ(planner.stance.height, 0.46 * go1_.length - go1_.hip_height);
  EXPECT_EQ(scenario.controller.period, 0.0025);
  EXPECT_EQ(scenario.plant.timestep, 0.0005);
  EXPECT_EQ(scenario.plant.sensors.imu.gyro_noise, 2.5e-3);
  EXPECT_EQ(scenario.plant.actuators.bandwidth_hz, 70.0);
  EXPECT_DOUBLE_EQ(scenario.plant.sensors.joint_torques.noise, 0.2 * go1_.torque());
}

TEST_F(Scaling, DrivesAreTheRobots) {
  const Scenario scenario = load("");
  EXPECT_EQ(scenario.plant.actuators.stall_torque, scenario.robot.torque_limit);
  EXPECT_EQ(scenario.plant.actuators.no_load_speed, scenario.robot.velocity_limit);
  EXPECT_EQ(load("actuators: {stall_torque: 7}\n").plant.actuators.stall_torque[4], 7.0);
}

TEST_F(Scaling, DefaultsOfEntriesGoWithTheRobot) {
  const Scenario scenario = load("disturbances: {lifts: {a: {time: 1}}}\n");
  EXPECT_DOUBLE_EQ(scenario.plant.disturbances.lifts[0].point.z(), 0.3 * go1_.length);
}

TEST_F(Scaling, RangesOfTasksGoWithTheRobot) {
  test::write_file(folder_ / "scenario.yaml",
                   "robot: go1\nstack: walk\nscaled: true\n"
                   "randomise: {tasks.com_xy.kp: [400, 400]}\n");
  const Scenario scenario = load_scenario({folder_ / "scenario.yaml", 7, {}});
  EXPECT_DOUBLE_EQ(scenario.drawn.at(0).value, 400.0 / go1_.length);
}

TEST_F(Scaling, RangesGoWithTheRobot) {
  test::write_file(folder_ / "ranges.yaml", "scaled: true\ndisturbances.payload.mass: [1, 1]\n");
  test::write_file(folder_ / "scenario.yaml",
                   "robot: go1\nstack: walk\nscaled: true\n"
                   "randomise: {include: ranges.yaml, initial.x: [0.5, 0.5]}\n");
  const Scenario scenario = load_scenario({folder_ / "scenario.yaml", 7, {}});
  EXPECT_DOUBLE_EQ(scenario.plant.disturbances.payload.mass, go1_.mass);
  EXPECT_DOUBLE_EQ(scenario.plant.initial.position.x(), 0.5 * go1_.length);
}

TEST_F(Scaling, KneesPointWhereTheRobotCanBendThem) {
  using gaits::KneeConfiguration;
  const auto knees = [](const Scenario& scenario) {
    return scenario.controller.planner.stance.knees;
  };
  EXPECT_EQ(knees(load("")), KneeConfiguration::backward);
  EXPECT_EQ(knees(load("scaled: true\nplanner: {stance: {knees: forward}}\n")),
            KneeConfiguration::backward);
  EXPECT_TRUE(
      test::holds(test::message_of([&] { (void)load("planner: {stance: {knees: forward}}\n"); }),
                  "knees: backward would fit"));
}

TEST_F(Scaling, TasksGoWithTheRobot) {
  const auto first = [](const control::StackOptions& stack, const std::string& task) {
    for (const control::LevelSpec& level : stack.levels) {
      for (const control::TaskSpec& spec : level.tasks) {
        if (spec.task == task) return spec;
      }
    }
    return control::TaskSpec{};
  };
  const control::StackOptions stack = load_stack("terrain_adaptation", {}, go1_);
  EXPECT_DOUBLE_EQ(first(stack, "com_xy").numbers.at("kp"), 500.0 / go1_.length);
  EXPECT_DOUBLE_EQ(first(stack, "com_xy").numbers.at("max_error"), 0.02 * go1_.length);
  EXPECT_DOUBLE_EQ(first(stack, "limb_extension_limits").numbers.at("max"), 0.535 * go1_.length);
  const control::StackOptions own =
      parse_stack("name: own\nlevels: [{task: com_xy, kp: 400}]", "own", go1_);
  EXPECT_EQ(first(own, "com_xy").numbers.at("kp"), 400.0);
  EXPECT_DOUBLE_EQ(first(own, "com_xy").numbers.at("kd"), 45.0 / go1_.time());
  const control::StackOptions mixed = parse_stack(
      "name: m\nscaled: true\n"
      "levels: [{name: motion, tasks: [{task: torso_yaw}, {task: swing_foot}]}]",
      "m", go1_);
  EXPECT_DOUBLE_EQ(mixed.levels[0].tasks[0].weight, go1_.length);
  EXPECT_EQ(mixed.levels[0].tasks[1].weight, 1.0);
}

TEST_F(Scaling, HeightsOfTheBaseAreThoseOfTheHipsLessTheirsOverTheBase) {
  test::write_file(folder_ / "high.yaml",
                   "name: high\nscaled: true\nbase: terrain_adaptation\nlevels:\n"
                   "  [equations_of_motion, {task: body_height_limits, max: 0.5}]\n");
  const Scenario scenario =
      load("scaled: true\ninitial: {z: 0.5}\ncriteria: {base_height_end_m: {max: 0.48}}\n",
           {"robot=hyq", "stack=high.yaml"});
  const Scale& hyq = scenario.robot.scale;
  EXPECT_NEAR(hyq.hip_height, -0.08, 1e-9);
  const auto height = [&](double number) { return hyq.length * number + 0.08; };
  EXPECT_NEAR(scenario.controller.planner.stance.height, height(0.46), 1e-9);
  EXPECT_NEAR(scenario.plant.initial.position.z(), height(0.5), 1e-9);
  EXPECT_NEAR(*scenario.criteria.back().max, height(0.48), 1e-9);
  const control::TaskSpec& limits = scenario.controller.stack.levels.back().tasks.front();
  EXPECT_NEAR(limits.numbers.at("max"), height(0.5), 1e-9);
  EXPECT_NEAR(limits.numbers.at("min"), height(0.25), 1e-9);
}

TEST_F(Scaling, RunsLastAsLongAsTheSameWayTakesAtTheRobotsSpeed) {
  const auto way = [](const Scenario& scenario) {
    const TimedCommand& walk = scenario.commands.back();
    return walk.user.velocity.x() * scenario.duration;
  };
  const Scenario one = load_scenario({"walk_flat", 0, {}});
  for (const char* robot : {"go1", "laikago", "hyq", "solo12"}) {
    const Scenario other = load_scenario({"walk_flat", 0, {std::string("robot=") + robot}});
    EXPECT_NEAR(way(other), other.robot.scale.length * way(one), 1e-9) << robot;
    EXPECT_DOUBLE_EQ(other.commands.back().time, 0.5 * other.robot.scale.time()) << robot;
  }
}

TEST_F(Scaling, WeightsGoWithUnitsWhereAScaledStackMakesOneLevelOfMany) {
  const auto weights = [&](const std::string& scaled) {
    return parse_stack("name: w\n" + scaled +
                           "levels: [{task: torso_yaw}, {task: swing_foot}, {name: both, tasks: "
                           "[{task: torso_height}, {task: torso_roll_pitch}]}]\n"
                           "weights: {torso_yaw: 3}\nweighted_from: torso_yaw\n",
                       "w", go1_)
        .levels.back()
        .tasks;
  };
  const std::vector<control::TaskSpec> fitted = weights("scaled: true\n"), own = weights("");
  EXPECT_DOUBLE_EQ(fitted[0].weight, 3.0 * go1_.length);
  EXPECT_DOUBLE_EQ(fitted[1].weight, 1.0);
  EXPECT_DOUBLE_EQ(fitted[2].weight, 1.0);
  EXPECT_DOUBLE_EQ(fitted[3].weight, go1_.length);
  EXPECT_EQ(own[0].weight, 3.0);
  EXPECT_EQ(own[3].weight, 1.0);
}

TEST_F(Scaling, JointsAtTheStartTurnWithTheKneesAndEndAtTheLimits) {
  for (const char* robot : {"a1", "go1", "hyq", "solo12"}) {
    for (const std::uint64_t seed : {0U, 1U, 2U}) {
      const Scenario scenario =
          load_scenario({"lying_start", seed, {std::string("robot=") + robot}});
      const model::RobotDescription& limits = scenario.robot;
      const JointVector& q = scenario.plant.initial.q;
      EXPECT_TRUE((q.array() >= limits.q_min.array()).all()) << robot;
      EXPECT_TRUE((q.array() <= limits.q_max.array()).all()) << robot;
      for (const Leg leg : kLegs) {
        const Eigen::Index hip = first_joint(leg) + 1, knee = hip + 1;
        EXPECT_LT(q[hip] * q[knee], 0.0) << robot;  // folded
        EXPECT_GT(std::abs(q[knee]), 2.4) << robot;
        EXPECT_GT(q[knee] * limits.q_nominal[knee], 0.0) << robot;
      }
    }
  }
  EXPECT_TRUE(test::holds(
      test::message_of([&] { (void)load("initial: {joints: {LH: {HFE: -1.45, KFE: 2.8}}}\n"); }),
      "initial.joints.LH: HFE is -1.45 rad; valid is -0.686 to 4.501 rad"));
}

TEST_F(Scaling, DampingOfASmallRobotActsNoFasterThanANYmalBs) {
  for (const char* name : {"a1", "go1", "laikago", "solo12", "hyq"}) {
    const model::RobotDescription robot = load_robot(name);
    const double inertia = robot.scale.mass * std::pow(robot.scale.length, 2.0);
    EXPECT_LT(robot.hold_kd[0] / inertia, 4.0 + 1e-9) << name;
    EXPECT_LT(robot.damping_kd[0] / inertia, 6.0 + 1e-9) << name;
  }
}

TEST_F(Scaling, StandsInAFileAlone) {
  EXPECT_TRUE(test::holds(test::message_of([&] { (void)load("", {"scaled=true"}); }),
                          "scaled: stands in a file alone"));
}

TEST_F(Scaling, SoDoesABase) {
  EXPECT_TRUE(test::holds(test::message_of([&] { (void)load("", {"base=step_down"}); }),
                          "base: stands in a file alone"));
}

TEST_F(Scaling, ANumberMayHaveAPlus) {
  EXPECT_DOUBLE_EQ(
      load("scaled: true\nplanner: {swing: {apex: +0.1}}\n").controller.planner.swing.apex,
      0.1 * go1_.length);
}

TEST_F(Scaling, ScaledIsTrueOrFalse) {
  EXPECT_TRUE(test::holds(test::message_of([&] { (void)load("scaled: yes please\n"); }),
                          "scaled: must be true or false"));
}

}  // namespace
}  // namespace surefoot::config
