#include "surefoot/config/scenario_file.hpp"

#include "surefoot/config/data_file.hpp"
#include "surefoot/planning/com_planner.hpp"
#include "tests/config/messages.hpp"
#include "tests/logging/temporary_folder.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot {
namespace {

using test::holds;
using test::message_of;

/// walk_flat with some keys laid over it.
class ScenarioFile : public testing::Test {
 protected:
  Scenario read(const std::string& text, std::uint64_t seed = 0,
                const std::vector<std::string>& assignments = {}) {
    test::write_file(folder_ / "trial.yaml", "base: walk_flat\n" + text);
    return load_scenario({folder_ / "trial.yaml", seed, assignments});
  }

  std::string complaint(const std::string& text, const std::vector<std::string>& assignments = {}) {
    return message_of([&] { (void)read(text, 0, assignments); });
  }

  test::TemporaryFolder folder_;
};

/// Draws the friction and nothing of what walk_flat draws.
const char* const kRandomFriction =
    "randomise:\n  initial.yaw:\n  planner.gait.start_duration:\n  terrain.friction: [0.4, 1.0]\n";

TEST_F(ScenarioFile, of_every_experiment_is_read_with_and_without_a_seed) {
  ASSERT_GE(list_data("scenarios").size(), 12u);
  for (const std::string& name : list_data("scenarios")) {
    for (const std::uint64_t seed : {0u, 1u, 2u}) {
      const Scenario scenario = load_scenario({name, seed, {}});
      EXPECT_EQ(scenario.name, name);
      EXPECT_FALSE(scenario.description.empty()) << name;
      EXPECT_FALSE(scenario.criteria.empty()) << name;
      EXPECT_EQ(scenario.sources.front().name, "scenario.yaml");
      EXPECT_EQ(scenario.plant.control_period, scenario.controller.period);
    }
  }
}

TEST_F(ScenarioFile, keeps_what_its_base_says_and_changes_what_it_names) {
  const Scenario base = load_scenario({"walk_flat", 0, {}});
  const Scenario scenario = read("duration: 3.5\nplanner: {swing: {apex: 0.12}}\n");
  EXPECT_EQ(scenario.duration, 3.5);
  EXPECT_EQ(scenario.controller.planner.swing.apex, 0.12);
  EXPECT_EQ(scenario.controller.planner.stance.half_length,
            base.controller.planner.stance.half_length);
}

std::vector<std::string> criteria_of(const Scenario& scenario) {
  std::vector<std::string> metrics;
  for (const Criterion& criterion : scenario.criteria) metrics.push_back(criterion.metric);
  return metrics;
}

TEST_F(ScenarioFile, does_not_take_over_what_its_base_says_of_its_own_experiment) {
  const Scenario base = load_scenario({"step_down", 0, {}});
  EXPECT_FALSE(base.paper.empty());
  test::write_file(folder_ / "stairs.yaml", "base: step_down\n");
  const Scenario scenario = load_scenario({folder_ / "stairs.yaml", 0, {}});
  EXPECT_EQ(scenario.description, "");
  EXPECT_TRUE(scenario.paper.empty());
  EXPECT_EQ(scenario.success_rate, 1.0);
  EXPECT_EQ(scenario.goal.feet_beyond_x, base.goal.feet_beyond_x);
  // A walk of another speed is not judged by the base's.
  EXPECT_EQ(criteria_of(read("user: [{time: 0, walk: true, velocity: [0.0, 0.08]}]\n")),
            std::vector<std::string>{"fell"});
}

TEST_F(ScenarioFile, asks_by_default_not_to_fall_and_to_reach_the_goal_that_there_is) {
  EXPECT_EQ(criteria_of(read("")), std::vector<std::string>{"fell"});
  EXPECT_EQ(criteria_of(read("goal: {feet_beyond_x: 1}\ncriteria: {speed_mps: {min: 0}}\n")),
            (std::vector<std::string>{"fell", "goal_reached", "speed_mps"}));
  const Scenario scenario = read("goal: {feet_beyond_x: 1}\ncriteria: {goal_reached: false}\n");
  EXPECT_EQ(criteria_of(scenario), (std::vector<std::string>{"fell", "goal_reached"}));
  EXPECT_EQ(scenario.criteria.back().equals, false);
}

TEST_F(ScenarioFile, takes_a_criterion_away_by_naming_nothing) {
  EXPECT_TRUE(read("criteria:\n  fell:\n").criteria.empty());
}

TEST_F(ScenarioFile, that_asks_for_a_goal_which_it_has_not_says_so) {
  EXPECT_TRUE(holds(complaint("criteria: {goal_reached: true}\n"),
                    "trial.yaml:2: criteria.goal_reached: the scenario has no goal"));
}

TEST_F(ScenarioFile, shows_no_figures_of_the_paper_beside_another_experiment) {
  EXPECT_FALSE(load_scenario({"walk_flat", 0, {"tasks.com_xy.kp=150"}}).paper.empty());
  for (const char* other : {"terrain.friction=0.5", "stack=terrain_adaptation",
                            "user=[{time: 0, walk: true, velocity: [0.1, 0]}]"}) {
    EXPECT_TRUE(load_scenario({"walk_flat", 0, {other}}).paper.empty()) << other;
  }
}

TEST_F(ScenarioFile, with_a_misspelt_key_names_line_path_and_the_nearest) {
  EXPECT_TRUE(holds(complaint("planner:\n  swing:\n    apx: 0.1\n"),
                    "trial.yaml:4: planner.swing.apx: unknown key; did you mean \"apex\"?"));
  EXPECT_TRUE(holds(complaint("duratoin: 3\n"),
                    "trial.yaml:2: duratoin: unknown key; did you mean \"duration\"?"));
}

TEST_F(ScenarioFile, with_a_negative_duration_says_what_would_be_valid) {
  EXPECT_TRUE(
      holds(complaint("duration: -1\n"), "trial.yaml:2: duration: \"-1\" is not a number above 0"));
}

TEST_F(ScenarioFile, has_levels_that_come_and_go) {
  const std::vector<LevelSwitch> switches =
      read(
          "stack_switches:\n  - {time: 0, remove: [torso_yaw, com_xy], duration: 0}\n"
          "  - {time: 2, add: [com_xy], remove: [torso_height]}\n")
          .controller.level_switches;
  ASSERT_EQ(switches.size(), 2u);
  EXPECT_EQ(switches[0].remove, (std::vector<std::string>{"torso_yaw", "com_xy"}));
  EXPECT_EQ(switches[0].duration, 0.0);
  EXPECT_EQ(switches[1].time, 2.0);
  EXPECT_EQ(switches[1].add, std::vector<std::string>{"com_xy"});
  EXPECT_EQ(switches[1].duration, 0.5) << "by default";
}

TEST_F(ScenarioFile, with_a_switch_of_levels_that_makes_no_sense_names_line_and_reason) {
  const auto says = [&](const std::string& item, const char* what) {
    const std::string text = complaint("stack_switches:\n  - " + item + "\n");
    EXPECT_TRUE(holds(text, "trial.yaml:3: stack_switches")) << text;
    EXPECT_TRUE(holds(text, what)) << text;
  };
  says("{time: 1, remove: [com]}",
       "unknown level \"com\"; the stack \"walk\" can switch: torso_roll_pitch com_xy");
  says("{time: 1, remove: [friction_cone]}", "keeps the physics and is always there");
  says("{time: 1, remove: [com_xy], duration: -1}", "\"-1\" is not a number of at least 0");
  says("{time: -1, remove: [com_xy]}", "\"-1\" is not a number of at least 0");
  says("{remove: [com_xy]}", "time: this key is missing");
  says("{time: 1, remove: com_xy}", "must be a list of names of levels");
  says("{time: 1}", "adds and removes nothing");
  says("{time: 1, level: com_xy}", "unknown key");
  EXPECT_TRUE(holds(complaint("stack_switches:\n  - {time: 1, remove: [com_xy], duration: 2}\n"
                              "  - {time: 2, add: [com_xy]}\n"),
                    "trial.yaml:4: stack_switches: the level switch at 2 s begins before"));
}

TEST_F(ScenarioFile, with_nan_names_the_key) {
  EXPECT_TRUE(
      holds(complaint("terrain:\n  friction: .nan\n"), "trial.yaml:3: terrain.friction: \".nan\""));
}

TEST_F(ScenarioFile, with_an_unknown_stack_or_robot_lists_those_that_exist) {
  EXPECT_TRUE(
      holds(complaint("stack: wallk\n"),
            "trial.yaml:2: stack: unknown stack \"wallk\"; did you mean \"walk\"? valid are:"));
  EXPECT_TRUE(
      holds(complaint("robot: hexapod\n"), "trial.yaml:2: robot: unknown robot \"hexapod\""));
}

TEST_F(ScenarioFile, that_is_not_yaml_says_so) {
  test::write_file(folder_ / "trial.yaml", "a: [1, 2\nb: }{");
  EXPECT_TRUE(
      holds(message_of([&] { (void)load_scenario({folder_ / "trial.yaml", 0, {}}); }), "not YAML"));
}

TEST_F(ScenarioFile, that_does_not_exist_lists_those_that_do) {
  EXPECT_TRUE(holds(message_of([] { (void)load_scenario({"walk_flt", 0, {}}); }),
                    "unknown scenario \"walk_flt\"; did you mean \"walk_flat\"?"));
  EXPECT_TRUE(holds(message_of([] { (void)load_scenario({"nowhere/walk.yaml", 0, {}}); }),
                    "there is no file \"nowhere/walk.yaml\""));
}

TEST_F(ScenarioFile, whose_bases_lead_to_each_other_ends_in_an_error) {
  test::write_file(folder_ / "a.yaml", "base: b.yaml\n");
  test::write_file(folder_ / "b.yaml", "base: a.yaml\n");
  EXPECT_TRUE(holds(message_of([&] { (void)load_scenario({folder_ / "a.yaml", 0, {}}); }), "base"));
}

TEST_F(ScenarioFile, with_a_criterion_on_an_unknown_metric_lists_the_metrics) {
  const std::string message = complaint("criteria:\n  com_eror_max_m: {max: 1}\n");
  EXPECT_TRUE(holds(message, "trial.yaml:3: criteria.com_eror_max_m: unknown metric"));
  EXPECT_TRUE(holds(message, "did you mean \"com_error_max_m\"?"));
  EXPECT_TRUE(holds(complaint("paper: {tick: fast}\n"), "paper.tick: unknown metric"));
}

TEST_F(ScenarioFile, with_a_criterion_of_the_wrong_kind_says_what_would_be_valid) {
  EXPECT_TRUE(holds(complaint("criteria: {fell: {max: 1}}\n"), "criteria.fell"));
  EXPECT_TRUE(holds(complaint("criteria: {com_error_max_m: {mx: 1}}\n"), "did you mean \"max\"?"));
}

TEST_F(ScenarioFile, gives_the_operators_command_of_the_time) {
  const Scenario scenario = read(
      "user:\n  - {time: 1, walk: true, velocity: [0.1, -0.02]}\n  - {time: 2.5, yaw_rate: 0.1}\n");
  EXPECT_FALSE(scenario.user(0.0).walk);
  EXPECT_FALSE(scenario.user(0.9999).walk);
  EXPECT_TRUE(scenario.user(1.0).walk);
  EXPECT_EQ(scenario.user(2.0).velocity, Vec2(0.1, -0.02));
  EXPECT_EQ(scenario.user(99.0).yaw_rate, 0.1);
  EXPECT_FALSE(scenario.user(99.0).walk);
}

TEST_F(ScenarioFile, whose_commands_go_back_in_time_is_an_error) {
  EXPECT_TRUE(holds(complaint("user:\n  - {time: 2, walk: true}\n  - {time: 1}\n"),
                    "trial.yaml:4: user.time"));
}

TEST_F(ScenarioFile, takes_assignments_of_the_command_line_over_everything) {
  const Scenario scenario =
      read("duration: 3\n", 0, {"duration=4", "actuators.model=sea", "tasks.com_xy.kp=150"});
  EXPECT_EQ(scenario.duration, 4.0);
  EXPECT_EQ(scenario.plant.actuators.model, ActuatorModel::sea);
  EXPECT_EQ(scenario.controller.stack.levels[5].tasks[0].numbers.at("kp"), 150.0);
}

TEST_F(ScenarioFile, names_the_assignment_that_is_wrong) {
  EXPECT_TRUE(holds(complaint("", {"planner.swing.apx=0.1"}),
                    "--set planner.swing.apx=0.1: planner.swing.apx: unknown key"));
  EXPECT_TRUE(holds(complaint("", {"duration=nan"}), "--set duration=nan: duration"));
}

TEST_F(ScenarioFile, refuses_a_switch_of_sides_shorter_than_its_ramps) {
  EXPECT_TRUE(holds(complaint("", {"planner.gait.switch_duration=0.05"}),
                    "switch_duration is 0.05 s; it must last as long as force.ramp_up and "
                    "force.ramp_down, 0.13 s"));
  EXPECT_NO_THROW((void)read("", 0, {"planner.gait.switch_duration=0.13"}));
  EXPECT_NO_THROW(
      (void)read("", 0, {"planner.gait.switch_duration=0.05", "planner.force.ramps=false"}));
}

TEST_F(ScenarioFile, refuses_a_control_period_that_no_walk_bears) {
  EXPECT_TRUE(holds(complaint("", {"period=0.1"}), "above 0 and at most 0.01 s"));
}

TEST_F(ScenarioFile, draws_nothing_for_seed_zero) {
  const Scenario scenario = read(kRandomFriction, 0);
  EXPECT_TRUE(scenario.drawn.empty());
  EXPECT_EQ(scenario.plant.terrain.friction, 0.8);
}

TEST_F(ScenarioFile, draws_the_same_values_for_the_same_seed_and_others_for_another) {
  const double first = read(kRandomFriction, 1).plant.terrain.friction;
  EXPECT_EQ(read(kRandomFriction, 1).plant.terrain.friction, first);
  EXPECT_NE(read(kRandomFriction, 2).plant.terrain.friction, first);
  EXPECT_EQ(read(kRandomFriction, 1).drawn.at(0).value, first);
}

TEST_F(ScenarioFile, draws_a_path_independently_of_what_else_is_drawn) {
  const std::string more = std::string(kRandomFriction) + "  initial.x: [0, 1]\n";
  EXPECT_EQ(read(more, 3).plant.terrain.friction, read(kRandomFriction, 3).plant.terrain.friction);
}

TEST_F(ScenarioFile, pairs_the_seeds_of_the_step_down_variants) {
  const Scenario full = load_scenario({"step_down", 5, {}});
  const Scenario regular = load_scenario({"step_down_regular_stack", 5, {}});
  ASSERT_EQ(full.drawn.size(), regular.drawn.size());
  for (std::size_t i = 0; i < full.drawn.size(); ++i) {
    EXPECT_EQ(full.drawn[i].path, regular.drawn[i].path);
    EXPECT_EQ(full.drawn[i].value, regular.drawn[i].value);
  }
}

TEST_F(ScenarioFile, lets_an_assignment_win_over_a_draw) {
  const Scenario scenario = read(kRandomFriction, 1, {"terrain.friction=0.77"});
  EXPECT_EQ(scenario.plant.terrain.friction, 0.77);
  EXPECT_TRUE(scenario.drawn.empty());
}

TEST_F(ScenarioFile, checks_a_random_path_also_in_the_nominal_run) {
  EXPECT_TRUE(
      holds(complaint("randomise:\n  terrain.fricton: [0, 1]\n"), "terrain.fricton: unknown key"));
  EXPECT_TRUE(holds(complaint("randomise:\n  terrain.friction: [1, 0]\n"),
                    "trial.yaml:3: randomise.terrain.friction"));
  EXPECT_TRUE(holds(complaint("randomise:\n  terrain.friction: 1\n"), "[min, max]"));
}

TEST_F(ScenarioFile, draws_every_mismatch_of_the_plant_and_nothing_of_the_controller) {
  const auto load = [](std::uint64_t seed) {
    return load_scenario({"walk_flat_sea", seed, {"randomise.include=mismatch"}});
  };
  const Scenario nominal = load(0), first = load(1), second = load(2);
  EXPECT_TRUE(nominal.drawn.empty());
  EXPECT_EQ(nominal.plant.sensors.encoders.offset, JointVector::Zero());
  EXPECT_EQ(nominal.plant.disturbances.link_mass_scale, JointVector::Ones());
  EXPECT_NE(first.plant.sensors.encoders.offset, second.plant.sensors.encoders.offset);
  EXPECT_NE(first.plant.disturbances.link_mass_scale, second.plant.disturbances.link_mass_scale);
  EXPECT_NE(first.plant.disturbances.thigh_length_offset, PerLeg<double>{});
  EXPECT_NE(first.plant.disturbances.shank_length_offset, PerLeg<double>{});
  EXPECT_NE(first.plant.disturbances.base_com_offset, second.plant.disturbances.base_com_offset);
  EXPECT_NE(first.plant.actuators.joint_torque_gain, JointVector::Ones());
  EXPECT_NE(first.plant.sensors.imu.tilt, Vec3::Zero());
  EXPECT_GT(first.plant.disturbances.payload.mass, 0.0);
  EXPECT_EQ(std::ranges::count(first.sources, "randomise1.yaml", &SourceFile::name), 1);
  EXPECT_EQ(first.controller.planner.force.friction, nominal.controller.planner.force.friction);
}

TEST_F(ScenarioFile, names_the_file_of_an_included_range_whose_path_is_unknown) {
  test::write_file(folder_ / "worn.yaml", "terrain.friction: [0, 1]\nterrain.fricton: [0, 1]\n");
  EXPECT_TRUE(holds(complaint("randomise: {include: worn.yaml}\n"), "worn.yaml:2: randomise"));
}

TEST_F(ScenarioFile, takes_the_numbers_of_a_vector_by_name) {
  const Scenario scenario =
      read("sensors: {encoders: {offset: {LF_KFE: 0.005}}}\n", 0,
           {"sensors.encoders.offset.RH_HAA=-0.002", "disturbances.base_com_offset.x=0.01",
            "disturbances.thigh_length_offset=[0.01, 0, 0, -0.01]"});
  EXPECT_EQ(scenario.plant.sensors.encoders.offset[2], 0.005);
  EXPECT_EQ(scenario.plant.sensors.encoders.offset[9], -0.002);
  EXPECT_EQ(scenario.plant.disturbances.base_com_offset, Vec3(0.01, 0.0, 0.0));
  EXPECT_EQ(scenario.plant.disturbances.thigh_length_offset[3], -0.01);
  EXPECT_TRUE(holds(complaint("sensors: {encoders: {offset: {LF_KFF: 1}}}\n"),
                    "trial.yaml:2: sensors.encoders.offset.LF_KFF: unknown key; did you mean"));
  EXPECT_TRUE(holds(complaint("sensors: {encoders: {offset: [1, 2]}}\n"),
                    "a list of 2 is not a list of 12 numbers, nor a map from LF_HAA … RH_KFE"));
  EXPECT_TRUE(holds(complaint("disturbances: {shank_length_offset: {LF: 0.3}}\n"),
                    "shank_length_offset.LF: \"0.3\" is not a number between -0.1 and 0.1 m"));
  EXPECT_TRUE(holds(complaint("disturbances: {link_mass_scale: {LF_HIP: 0}}\n"), "above 0"));
}

TEST_F(ScenarioFile, has_actuators_of_two_levels) {
  EXPECT_EQ(read("").plant.actuators.level, 1);
  const ActuatorOptions actuators =
      read(
          "actuators: {model: sea, level: 2, spring: {stiffness: 150}, rotor: {inertia: 3e-5, "
          "coulomb: 0.5}, torque_loop: {damping: 1}}\n")
          .plant.actuators;
  EXPECT_EQ(actuators.level, 2);
  EXPECT_EQ(actuators.spring.stiffness, 150.0);
  EXPECT_EQ(actuators.rotor.inertia, 3e-5);
  EXPECT_EQ(actuators.rotor.coulomb, 0.5);
  EXPECT_EQ(actuators.torque_loop.damping, 1.0);
  EXPECT_TRUE(holds(complaint("actuators: {level: 3}\n"),
                    "trial.yaml:2: actuators.level: \"3\" is more than 2"));
  EXPECT_TRUE(holds(complaint("actuators: {rotor: {inertia: 0}}\n"), "actuators.rotor.inertia"));
  EXPECT_TRUE(holds(complaint("actuators: {spring: {stifness: 1}}\n"), "mean \"stiffness\"?"));
}

TEST_F(ScenarioFile, has_sensors_that_fail) {
  const std::vector<SensorFault> faults =
      read(
          "sensors: {faults: {a: {sensor: imu, kind: stops, time: 3}, b: {sensor: encoders, kind: "
          "late, time: 1, duration: 0.5, size: 4, joint: RF_HFE}, c: }}\n")
          .plant.sensors.faults;
  ASSERT_EQ(faults.size(), 2u);
  EXPECT_EQ(faults[0].kind, FaultKind::stops);
  EXPECT_EQ(faults[0].time, 3.0);
  EXPECT_TRUE(std::isinf(faults[0].duration));
  EXPECT_EQ(faults[1].sensor, FaultySensor::encoders);
  EXPECT_EQ(faults[1].size, 4.0);
  EXPECT_EQ(faults[1].joint, 4);
}

TEST_F(ScenarioFile, with_a_fault_that_makes_no_sense_names_key_and_reason) {
  const auto says = [&](const std::string& fault, const char* what) {
    const std::string text = complaint("sensors: {faults: {a: {" + fault + "}}}\n");
    EXPECT_TRUE(holds(text, "trial.yaml:2: sensors.faults.a")) << text;
    EXPECT_TRUE(holds(text, what)) << text;
  };
  says("kind: stops, time: 1", "sensor: this key is missing");
  says("sensor: gps, kind: stops, time: 1", "unknown choice \"gps\"");
  says("sensor: imu, kind: stop, time: 1", "did you mean \"stops\"?");
  says("sensor: imu, kind: stops, time: -1", "at least 0");
  says("sensor: imu, kind: stops, time: 1, duration: 0", "above 0");
  says("sensor: imu, kind: stops, time: 1, size: 2", "only jump, spike and late have one");
  says("sensor: gyro, kind: jump, time: 1", "size: this key is missing");
  says("sensor: imu, kind: jump, time: 1, size: 1", "have different units");
  says("sensor: gyro, kind: late, time: 1, size: 2.5", "a whole number of ticks from 1 to 1000");
  says("sensor: gyro, kind: spike, time: 1, size: 2, duration: 1", "a spike is one sample");
  says("sensor: gyro, kind: nan, time: 1, joint: LF_HAA", "only encoders and joint_torques");
  says("sensor: encoders, kind: nan, time: 1, joint: LF_HIP", "unknown joint \"LF_HIP\"");
}

TEST_F(ScenarioFile, whose_stance_is_out_of_reach_says_so) {
  EXPECT_TRUE(holds(complaint("planner: {stance: {height: 0.9}}\n"), "planner.stance"));
}

TEST_F(ScenarioFile, that_is_no_yaml_file_is_not_called_unknown) {
  test::write_file(folder_ / "bad.txt", "hello");
  const auto complaint_of = [](const std::string& name) {
    return message_of([&] { (void)load_scenario({name, 0, {}}); });
  };
  EXPECT_TRUE(holds(complaint_of(folder_ / "bad.txt"), "bad.txt\" is not a YAML file"));
  EXPECT_TRUE(holds(complaint_of(folder_.path()), "is a folder"));
  std::filesystem::create_directories(folder_ / "folder.yaml");
  EXPECT_TRUE(holds(complaint_of(folder_ / "folder.yaml"), "is a folder"));
  EXPECT_TRUE(holds(complaint("stack: bad.txt\n"), "trial.yaml:2: stack: \"bad.txt\" is not"));
}

TEST_F(ScenarioFile, whose_period_is_not_made_of_timesteps_names_the_key) {
  EXPECT_TRUE(holds(complaint("period: 0.0023\n"),
                    "trial.yaml:2: period: 0.0023 s is not a whole multiple of the timestep"));
}

TEST_F(ScenarioFile, with_a_push_on_an_unknown_link_names_the_push_and_the_nearest) {
  const std::string message =
      complaint("disturbances:\n  pushes:\n    kick: {time: 1, force: [0, 9, 0], body: LF_TIGH}\n");
  EXPECT_TRUE(holds(message, "trial.yaml:4: disturbances.pushes.kick.body"));
  EXPECT_TRUE(holds(message, "did you mean \"LF_THIGH\"?"));
}

TEST_F(ScenarioFile, says_what_a_shape_or_payload_needs) {
  const auto element = [&](const std::string& text) {
    return complaint("terrain: {elements: {a: {" + text + "}}}\n");
  };
  EXPECT_TRUE(holds(element("shape: box"), "trial.yaml:2: terrain.elements.a.size: this key is"));
  EXPECT_TRUE(holds(element("shape: height_field"), "either heights, with columns and rows, or"));
  EXPECT_TRUE(holds(element("shape: height_field, amplitude: 0.02"), "terrain.elements.a.size_x"));
  EXPECT_TRUE(holds(element("shape: height_field, size_x: 1, size_y: 1, columns: 2, rows: 2, "
                            "heights: [0, 0, 0]"),
                    "3 numbers are not columns × rows = 4"));
  EXPECT_TRUE(holds(element("shape: random_boxes, size_x: 1, size_y: 1"), "a.max_height"));
  EXPECT_TRUE(holds(element("shape: steps"), "a.height: this key is missing"));
  EXPECT_TRUE(holds(element("shape: slope"), "a pitch, a roll or both"));
  EXPECT_TRUE(holds(element("shape: slope, pitch: 0.1, incline: 0.1"), "or instead of them"));
  EXPECT_TRUE(holds(complaint("disturbances: {payload: {}}\n"),
                    "trial.yaml:2: disturbances.payload.mass: this key is missing"));
  EXPECT_EQ(read("disturbances: {payload: }\n").plant.disturbances.payload.mass, 0.0);
}

TEST_F(ScenarioFile, whose_foot_contact_is_too_stiff_for_the_timestep_names_the_key) {
  EXPECT_TRUE(holds(complaint("foot_contact: {solref_time: 0.0001}\n"),
                    "trial.yaml:2: foot_contact.solref_time: must be at least two timesteps"));
}

TEST_F(ScenarioFile, reads_a_push_as_force_or_as_impulse) {
  const Scenario scenario = read(
      "disturbances: {pushes: {a: {time: 1, force: [0, 9, 0]}, b: {time: 2, duration: 0.5, "
      "impulse: [0, 0, 3]}}}\n");
  ASSERT_EQ(scenario.plant.disturbances.pushes.size(), 2u);
  EXPECT_EQ(scenario.plant.disturbances.pushes[0].force, Vec3(0, 9, 0));
  EXPECT_EQ(scenario.plant.disturbances.pushes[1].force, Vec3(0, 0, 6));
  EXPECT_TRUE(
      holds(complaint("disturbances: {pushes: {a: {time: 1}}}\n"), "either a force, an impulse"));
}

TEST_F(ScenarioFile, reads_a_push_along_the_ground_by_magnitude_and_direction) {
  const Scenario scenario = read(
      "disturbances: {pushes: {a: {time: 1, magnitude: 50, direction: 2.5}}}\n"
      "randomise: {disturbances.pushes.a.direction: [-3, 3]}\n");
  const Vec3& force = scenario.plant.disturbances.pushes.at(0).force;
  EXPECT_LT((force - 50.0 * Vec3(std::cos(2.5), std::sin(2.5), 0.0)).norm(), 1e-12);
  const auto push = [&](const std::string& text) {
    return complaint("disturbances: {pushes: {a: {time: 1, " + text + "}}}\n");
  };
  EXPECT_TRUE(holds(push("magnitude: 5"), "pushes.a.direction: this key is missing"));
  EXPECT_TRUE(holds(push("magnitude: -5, direction: 0"), "pushes.a.magnitude"));
  EXPECT_TRUE(holds(push("magnitude: 5, direction: 0, force: [1, 0, 0]"), "either a force, an"));
  EXPECT_TRUE(holds(push("force: [1, 0, 0], direction: 0"), "only a push with a magnitude has"));
}

TEST_F(ScenarioFile, chooses_the_solver) {
  EXPECT_EQ(read("").controller.solver.method, SolverMethod::lexicographic);
  EXPECT_EQ(read("solver: {method: cascade}\n").controller.solver.method, SolverMethod::cascade);
  EXPECT_TRUE(read("").controller.solver.structure);
  EXPECT_FALSE(read("solver: {structure: false}\n").controller.solver.structure);
  EXPECT_TRUE(holds(complaint("solver: {method: simplex}\n"), "trial.yaml:2: solver.method"));
}

TEST_F(ScenarioFile, that_uses_foot_sensors_must_give_them_to_the_robot) {
  EXPECT_TRUE(holds(complaint("contact_force: {use_foot_sensor: true}\n"),
                    "trial.yaml:2: contact_force.use_foot_sensor"));
  EXPECT_TRUE(
      read("contact_force: {use_foot_sensor: true}\nsensors: {foot_force: {present: true}}\n")
          .plant.sensors.foot_force.present);
}

TEST_F(ScenarioFile, that_looks_further_ahead_than_the_com_planner_can_says_so) {
  const auto text = [](int steps) {
    return "planner: {com: {horizon_steps: " + std::to_string(steps) + "}}\n";
  };
  const int most = ComPlanner::kMaxSteps;
  EXPECT_EQ(read(text(most)).controller.planner.com.horizon_steps, most);
  EXPECT_TRUE(holds(complaint(text(most + 1)), "trial.yaml:2: planner.com.horizon_steps: \"" +
                                                   std::to_string(most + 1) + "\" is more than " +
                                                   std::to_string(most)));
}

TEST_F(ScenarioFile, with_a_leg_twice_in_the_gait_says_so) {
  EXPECT_TRUE(
      holds(complaint("planner: {gait: {order: [LF, LF, RF, RH]}}\n"), "leg LF comes twice"));
}

}  // namespace
}  // namespace surefoot
