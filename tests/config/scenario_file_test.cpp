#include "surefoot/config/scenario_file.hpp"

#include "surefoot/config/data_directory.hpp"
#include "surefoot/config/data_file.hpp"
#include "surefoot/gaits/parts/com_planner.hpp"
#include "tests/config/trial_scenario.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace surefoot::config {
namespace {

using test::holds;
using test::message_of;

class ScenarioFile : public test::TrialScenario {};

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
  for (const evaluation::Criterion& criterion : scenario.criteria)
    metrics.push_back(criterion.metric);
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
  EXPECT_TRUE(read("criteria:\n  fell:\n").criteria.empty()) << "naming nothing takes it away";
  EXPECT_EQ(criteria_of(read("criteria: {speed_mps: {min: 2, max: 2}}\n")),
            (std::vector<std::string>{"fell", "speed_mps"}));
}

TEST_F(ScenarioFile, shows_no_figures_of_the_paper_beside_another_experiment) {
  EXPECT_FALSE(load_scenario({"walk_flat", 0, {"tasks.com_xy.kp=150"}}).paper.empty());
  for (const char* other : {"terrain.friction=0.5", "stack=terrain_adaptation",
                            "user=[{time: 0, walk: true, velocity: [0.1, 0]}]"}) {
    EXPECT_TRUE(load_scenario({"walk_flat", 0, {other}}).paper.empty()) << other;
  }
}

TEST_F(ScenarioFile, that_is_wrong_says_where_and_what_would_be_valid) {
  struct Case {
    const char *text, *told;
  };
  for (const Case& one : std::vector<Case>{
           {"planner:\n  swing:\n    apx: 0.1\n",
            "trial.yaml:4: planner.swing.apx: unknown key; did you mean \"apex\"?"},
           {"duratoin: 3\n", "trial.yaml:2: duratoin: unknown key; did you mean \"duration\"?"},
           {"duration: -1\n", "trial.yaml:2: duration: \"-1\" is not a number above 0"},
           {"terrain:\n  friction: .nan\n", "trial.yaml:3: terrain.friction: \".nan\""},
           {"stack: wallk\n",
            "trial.yaml:2: stack: unknown stack \"wallk\"; did you mean \"walk\"? valid are:"},
           {"robot: octopod\n", "trial.yaml:2: robot: unknown robot \"octopod\""},
           {"criteria: {goal_reached: true}\n",
            "trial.yaml:2: criteria.goal_reached: the scenario has no goal"},
           {"criteria: {speed_mps: {min: 2, max: 1}}\n",
            "trial.yaml:2: criteria.speed_mps.max: 1 must not be below min, which is 2"},
           {"criteria:\n  com_eror_max_m: {max: 1}\n",
            "trial.yaml:3: criteria.com_eror_max_m: unknown metric"},
           {"criteria: {com_eror_max_m: {max: 1}}\n", "did you mean \"com_error_max_m\"?"},
           {"paper: {tick: fast}\n", "paper.tick: unknown metric"},
           {"criteria: {fell: {max: 1}}\n", "criteria.fell"},
           {"criteria: {com_error_max_m: {mx: 1}}\n", "did you mean \"max\"?"},
           {"user:\n  - {time: 2, walk: true}\n  - {time: 1}\n", "trial.yaml:4: user.time"},
           {"randomise:\n  terrain.fricton: [0, 1]\n", "terrain.fricton: unknown key"},
           {"randomise:\n  terrain.friction: [1, 0]\n", "trial.yaml:3: randomise.terrain.friction"},
           {"randomise:\n  terrain.friction: 1\n", "[min, max]"},
           {"planner: {stance: {height: 0.9}}\n", "planner.stance"},
           {"planner: {gait: {order: [LF, LF, RF, RH]}}\n", "leg LF comes twice"},
           {"tasks: {torque_limits: {speed_line: nine}}\n", "nine"},
           {"solver: {method: simplex}\n", "trial.yaml:2: solver.method"},
           {"contact_force: {use_foot_sensor: true}\n",
            "trial.yaml:2: contact_force.use_foot_sensor"},
           {"guard: {repeats: 0}\n", "guard.repeats"},
           {"guard: {consistency: {imu: {window: 0}}}\n", "guard.consistency.imu.window"},
           {"guard: {consistency: {torque: {}}}\n", "guard.consistency.torque: unknown key"},
           {"guard: {max_giro: 1}\n", "guard.max_giro: unknown key"}}) {
    EXPECT_TRUE(holds(complaint(one.text), one.told));
  }
}

TEST_F(ScenarioFile, has_levels_that_come_and_go) {
  const std::vector<control::LevelSwitch> switches =
      read(
          "stack: terrain_adaptation\nstack_switches:\n"
          "  - {time: 0, remove: [torso_yaw, com_xy], duration: 0}\n"
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
    const std::string text =
        complaint("stack: terrain_adaptation\nstack_switches:\n  - " + item + "\n");
    EXPECT_TRUE(holds(text, "trial.yaml:4: stack_switches")) << text;
    EXPECT_TRUE(holds(text, what)) << text;
  };
  says("{time: 1, remove: [com]}",
       "unknown level \"com\"; the stack \"terrain_adaptation\" can switch: com_xy swing_foot");
  says("{time: 1, remove: [friction_cone]}", "keeps the physics and is always there");
  says("{time: 1, remove: [com_xy], duration: -1}", "\"-1\" is not a number of at least 0");
  says("{time: -1, remove: [com_xy]}", "\"-1\" is not a number of at least 0");
  says("{remove: [com_xy]}", "time: this key is missing");
  says("{time: 1, remove: com_xy}", "must be a list of names of levels");
  says("{time: 1}", "adds and removes nothing");
  says("{time: 1, level: com_xy}", "unknown key");
  EXPECT_TRUE(holds(complaint("stack: terrain_adaptation\nstack_switches:\n"
                              "  - {time: 1, remove: [com_xy], duration: 2}\n"
                              "  - {time: 2, add: [com_xy]}\n"),
                    "trial.yaml:5: stack_switches: the level switch at 2 s begins before"));
}

TEST_F(ScenarioFile, of_a_robot_that_its_joints_can_not_bear_says_so) {
  std::ifstream file(data_directory() / "robots/anymal_b.yaml");
  std::string robot(std::istreambuf_iterator<char>(file), {});
  const std::string given = "torque: 40.0 ";
  robot.replace(robot.find(given), given.size(), "torque: 4.0 ");
  test::write_file(folder_ / "weak.yaml", robot);
  const std::string said = complaint("robot: weak.yaml\n");
  EXPECT_TRUE(holds(said, "trial.yaml:2: robot: it can't stand")) << said;
  EXPECT_TRUE(holds(said, "limits.torque is 4 N·m")) << said;
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
                    "there is no file \"nowhere/walk.yaml\" in " +
                        std::filesystem::current_path().string() + " or "));
  const std::string beside = complaint("stack: mine.yaml\n");
  EXPECT_TRUE(holds(beside, "there is no file \"mine.yaml\" in ")) << beside;
  EXPECT_TRUE(holds(beside, ", " + folder_.path() + " or ")) << beside;
  EXPECT_TRUE(holds(beside, "/stacks; ")) << beside;
}

TEST_F(ScenarioFile, whose_bases_lead_to_each_other_ends_in_an_error) {
  test::write_file(folder_ / "a.yaml", "base: b.yaml\n");
  test::write_file(folder_ / "b.yaml", "base: a.yaml\n");
  EXPECT_TRUE(holds(message_of([&] { (void)load_scenario({folder_ / "a.yaml", 0, {}}); }), "base"));
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

TEST_F(ScenarioFile, takes_assignments_of_the_command_line_over_everything) {
  const Scenario scenario =
      read("duration: 3\n", 0, {"duration=4", "actuators.model=sea", "tasks.com_xy.kp=150"});
  EXPECT_EQ(scenario.duration, 4.0);
  EXPECT_EQ(scenario.plant.actuators.model, simulation::ActuatorModel::sea);
  EXPECT_EQ(scenario.controller.stack.levels[4].tasks[0].numbers.at("kp"), 150.0);
}

TEST_F(ScenarioFile, refuses_options_that_make_no_sense_by_themselves_or_together) {
  struct Case {
    std::vector<std::string> assignments;
    const char* told;
  };
  const std::string count =
      "terrain.elements={stairs: {shape: steps, height: 0.1, count: 2000000000}}";
  const std::vector<Case> cases{
      {{"safety.bridge_time=0.1"},
       "safety.bridge_time: 0.1 s must not be above guard.patience, 0.02 s"},
      {{"guard.patience=0.1"}, "at most 0.02 s"},
      {{"guard.patience=0.01", "safety.bridge_time=0.015"},
       "safety.bridge_time: 0.015 s must not be above"},
      {{"guard.patience=0.01"}, "guard.patience: 0.01 s must not be below safety.bridge_time"},
      {{"duration=1e12"}, "is not a number above 0, at most 1e6 s"},
      {{"timestep=1e-9"}, "is not a number of at least 1e-5 s"},
      {{count}, "terrain.elements.stairs.count: \"2000000000\" is more than 1000"},
      {{"planner.swing.hip_height_min=0.5"},
       "planner.swing: hip_height_min is 0.5 m; it must be below stance.height"},
      {{"planner.gait.switch_duration=0.05"},
       "switch_duration is 0.05 s; it must last as long as force.ramp_up and force.ramp_down, "
       "0.13 s"},
      {{"planner.gait.same_side_duration=0"},
       "planner.gait: same_side_duration is 0 s; it must last as long as"},
      {{"planner.calibration.duration=0.1"},
       "planner.calibration.duration: 0.1 s is too short for a turn by these angles; expected at "
       "least 1.22 s, or 0 for none"},
      {{"planner.calibration.duration=1", "planner.calibration.pitch=0.3"},
       "expected at least 1.73 s, or 0 for none"},
      {{"planner.torso.frequency=2000"}, "from 0.1 to 100 rad/s"},
      {{"planner.torso.max_tilt=1.6"}, "from 0 to 1.5 rad"},
      {{"external_force.time_constant=0.0005"}, "from 0.01 to 10 s"},
      {{"external_force.load_time_constant=0.0005"}, "from 0.01 to 10 s"},
      {{"guard.consistency.torques.time_constant=0.0005"}, "from 0.01 to 10 s"},
      {{"slip.end_speed=0.1"}, "slip.end_speed: is 0.1 m/s; it must not be above begin_speed"},
      {{"period=0.1"}, "above 0 and at most 0.01 s"},
      {{"planner.swing.apx=0.1"}, "--set planner.swing.apx=0.1: planner.swing.apx: unknown key"},
      {{"duration=nan"}, "--set duration=nan: duration"}};
  for (const Case& one : cases) EXPECT_TRUE(holds(complaint("", one.assignments), one.told));
  for (const std::vector<std::string>& valid : std::vector<std::vector<std::string>>{
           {"planner.gait.switch_duration=0.13"},
           {"planner.gait.switch_duration=0.05", "planner.force.ramps=false"},
           {"planner.calibration.duration=0"},
           {"planner.calibration.duration=1.3"}})
    EXPECT_NO_THROW((void)read("", 0, valid)) << valid[0];
}

TEST_F(ScenarioFile, notes_what_begins_after_the_end) {
  const std::string push = "disturbances: {pushes: {kick: {time: 5, force: [1, 0, 0]}}}\n";
  const std::string fault = "sensors: {faults: {one: {sensor: imu, kind: nan, time: 2}}}\n";
  EXPECT_TRUE(read("duration: 10\n" + push + fault).notes.empty());
  EXPECT_EQ(read("duration: 2\n" + push + fault).notes,
            (std::vector<std::string>{"disturbances.pushes.kick begins at 5 s; the run ends at 2 s",
                                      "sensors.faults.one begins at 2 s; the run ends at 2 s"}));
}

TEST_F(ScenarioFile, notes_assignments_that_nothing_comes_of) {
  const std::string range = "randomise.terrain.friction=[0.5, 0.6]";
  EXPECT_TRUE(read("", 1, {range}).notes.empty());
  EXPECT_EQ(read("", 1, {range, "terrain.friction=0.7"}).notes,
            (std::vector<std::string>{
                "randomise.terrain.friction draws nothing, as terrain.friction is set"}));

  const std::string spring = "actuators.spring.stiffness=200";
  EXPECT_TRUE(read("", 0, {"actuators.model=sea", "actuators.level=2", spring}).notes.empty());
  EXPECT_EQ(read("", 0, {"actuators.model=sea", spring}).notes,
            (std::vector<std::string>{"actuators.spring.stiffness changes nothing, as "
                                      "actuators.level is 1; level 2 has motor and spring"}));
  EXPECT_EQ(
      read("", 0, {"actuators.model=ideal", "actuators.level=2"}).notes,
      (std::vector<std::string>{"actuators.level changes nothing, as actuators.model is ideal"}));
}

TEST_F(ScenarioFile, takes_none_for_nothing_and_for_a_choice_of_that_name) {
  EXPECT_TRUE(std::isnan(read("goal: {feet_beyond_x: 1}\n", 0, {"goal=none"}).goal.feet_beyond_x));
  EXPECT_EQ(read("", 1, {"randomise.initial.yaw=none"}).drawn.size(), 1u);
  EXPECT_NO_THROW((void)read("tasks: {torque_limits: {speed_line: none}}\n"));
}

TEST_F(ScenarioFile, with_a_bound_beyond_reach_is_told_where_the_number_stands) {
  test::write_file(folder_ / "far.yaml",
                   "name: far\nbase: terrain_adaptation\n"
                   "levels:\n"
                   "  - equations_of_motion\n"
                   "  - com_xy\n"
                   "  - {name: far, task: body_height_limits, max: 5.2}\n");
  const std::string far = "body_height_limits: max is 5.2";
  for (const std::string other :
       {"", "tasks: {com_xy: {kp: 400}}\n", "tasks: {body_height_limits: {min: 0.2}}\n"}) {
    const std::string told = complaint("duration: 2\nstack: far.yaml\n" + other);
    EXPECT_TRUE(holds(told, "trial.yaml:3: stack: far, " + far)) << told;
  }
  const std::string own =
      complaint("stack: terrain_adaptation\ntasks:\n  limb_extension_limits:\n    max: 5.2\n");
  EXPECT_TRUE(holds(own, "trial.yaml:5: tasks: limb_extension_limits: max is 5.2")) << own;
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

TEST_F(ScenarioFile, chooses_the_solver) {
  EXPECT_EQ(read("").controller.solver.method, control::SolverMethod::lexicographic);
  EXPECT_EQ(read("solver: {method: cascade}\n").controller.solver.method,
            control::SolverMethod::cascade);
  EXPECT_TRUE(read("").controller.solver.structure);
  EXPECT_FALSE(read("solver: {structure: false}\n").controller.solver.structure);
}

TEST_F(ScenarioFile, says_which_samples_are_believed) {
  const Scenario scenario = read(
      "guard: {max_gyro_step: 1.5, max_imu_delay: 0.02, consistency: {imu: {rate_margin: 0.2}, "
      "frozen: {motion: 1}, torques: {max_force: 900}}}\n");
  EXPECT_EQ(scenario.controller.guard.max_gyro_step, 1.5);
  EXPECT_EQ(scenario.controller.guard.max_imu_delay, 0.02);
  EXPECT_EQ(scenario.controller.guard.patience, estimation::ReadingGuardOptions{}.patience);
  EXPECT_EQ(scenario.controller.consistency.imu.rate_margin, 0.2);
  EXPECT_EQ(scenario.controller.consistency.imu.window, estimation::ImuCheckOptions{}.window);
  EXPECT_EQ(scenario.controller.consistency.frozen.motion, 1.0);
  EXPECT_EQ(scenario.controller.consistency.torques.max_force, 900.0);
  EXPECT_FALSE(read("guard: {consistency: {enabled: false}}\n").controller.consistency.enabled);
  EXPECT_NO_THROW((void)read(
      "contact_force: {use_foot_sensor: true}\nsensors: {foot_force: {present: true}}\n"));
}

TEST_F(ScenarioFile, that_looks_further_ahead_than_the_com_planner_can_says_so) {
  const auto text = [](int steps) {
    return "planner: {com: {horizon_steps: " + std::to_string(steps) + "}}\n";
  };
  const int most = gaits::ComPlanner::kMaxSteps;
  EXPECT_EQ(read(text(most)).controller.planner.com.horizon_steps, most);
  EXPECT_TRUE(holds(complaint(text(most + 1)), "trial.yaml:2: planner.com.horizon_steps: \"" +
                                                   std::to_string(most + 1) + "\" is more than " +
                                                   std::to_string(most)));
}

}  // namespace
}  // namespace surefoot::config
