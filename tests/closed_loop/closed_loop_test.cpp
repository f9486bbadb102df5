#include "surefoot/closed_loop/closed_loop.hpp"

#include "surefoot/closed_loop/log_terrain.hpp"
#include "surefoot/config/initial_posture.hpp"
#include "surefoot/config/scenario_file.hpp"
#include "surefoot/logging/log_reader.hpp"
#include "surefoot/logging/recorder.hpp"
#include "surefoot/model/body_tree.hpp"
#include "surefoot/model/urdf.hpp"
#include "tests/logging/temporary_folder.hpp"
#include "tests/support/messages.hpp"

#include <Eigen/LU>

#include <cmath>

namespace surefoot::closed_loop {
namespace {

config::Scenario short_walk(const std::vector<std::string>& assignments = {}) {
  std::vector<std::string> all{"duration=0.4"};
  all.insert(all.end(), assignments.begin(), assignments.end());
  return config::load_scenario({"walk_flat_sea", 3, all});
}

/// Height of the nominal stance at which the sum of the legs' manipulabilities |det J| is largest,
/// by trying all.
double best_height(const config::Scenario& scenario) {
  const model::RobotModel model(scenario.robot);
  const model::BodyTree tree =
      model::make_body_tree(scenario.robot, model::read_urdf(scenario.robot.urdf_path));
  gaits::StanceOptions stance = scenario.controller.planner.stance;
  double best = 0.0, best_height = 0.0;
  for (stance.height = 0.30; stance.height < 0.51; stance.height += 1e-4) {
    const JointVector q = config::stance_posture(model, stance);
    double sum = 0.0;
    for (const Leg leg : kLegs) {
      Mat3 J;
      (void)tree.legs[index(leg)].chain.foot_in_base(q.segment<3>(first_joint(leg)), &J);
      sum += std::abs(J.determinant());
    }
    if (sum > best) best_height = stance.height;
    best = std::max(best, sum);
  }
  return best_height;
}

TEST(ClosedLoop, stands_for_the_whole_duration_and_says_so) {
  const RunResult result = run_closed_loop(short_walk(), {});
  EXPECT_EQ(result.ending, Ending::finished);
  EXPECT_NEAR(result.metrics.duration_s, 0.4, 1e-9);
  EXPECT_EQ(result.metrics.seed, 3u);
  EXPECT_FALSE(result.metrics.fell);
  EXPECT_LT(result.metrics.com_error_max_m, 1e-3);
  EXPECT_GT(result.metrics.tick_us.median, 0.0);
  EXPECT_GT(result.metrics.tick_us.median, result.metrics.solve_us.median);
}

TEST(ClosedLoop, the_same_seed_gives_the_same_run) {
  const config::Scenario scenario = short_walk({"duration=2.5"});
  const RunResult first = run_closed_loop(scenario, {});
  const RunResult again = run_closed_loop(scenario, {});
  EXPECT_GT(first.metrics.steps_taken, 0);
  EXPECT_EQ(first.metrics.com_error_max_m, again.metrics.com_error_max_m);
  EXPECT_EQ(first.metrics.torque_step_max_nm, again.metrics.torque_step_max_nm);
}

TEST(ClosedLoop, an_interrupt_ends_the_run_with_a_readable_log_that_does_not_look_whole) {
  const test::TemporaryFolder folder;
  int ticks = 0;
  ClosedLoopOptions options;
  options.record_path = folder / "run.mcap";
  options.interrupted = [&ticks] { return ++ticks > 40; };
  const RunResult result = run_closed_loop(short_walk(), options);
  EXPECT_EQ(result.ending, Ending::interrupted);
  EXPECT_NE(result.metrics.succeeded, true);

  EXPECT_FALSE(std::filesystem::exists(folder / "run.mcap"));
  logging::LogReader log(logging::partial_path(folder / "run.mcap"));
  TickRecord tick;
  int read = 0;
  while (log.next(tick)) ++read;
  EXPECT_EQ(read, 41);
  EXPECT_TRUE(log.complete());
  EXPECT_TRUE(test::holds(log.summary(), "\"reason\":\"interrupted\""));
}

TEST(ClosedLoop, the_log_names_what_the_run_was_made_from) {
  const test::TemporaryFolder folder;
  ClosedLoopOptions options;
  options.record_path = folder / "run.mcap";
  (void)run_closed_loop(short_walk({"stack=terrain_adaptation"}), options);
  const logging::LogHeader header = logging::LogReader(folder / "run.mcap").header();
  EXPECT_EQ(header.scenario, "walk_flat_sea");
  EXPECT_EQ(header.stack, "terrain_adaptation");
  EXPECT_EQ(header.estimation, "truth");
  EXPECT_EQ(header.seed, 3u);
  EXPECT_EQ(header.level_names.size(), 11u);
  EXPECT_EQ(header.robot.joint_names[0], "LF_HAA");
  EXPECT_EQ(header.limb.level, 6);
  EXPECT_EQ(header.limb.form, "radial");
  EXPECT_EQ(header.limb.max, 0.535);
  EXPECT_EQ(header.event_names.at(2), "touchdown");
}

TEST(ClosedLoop, the_log_says_how_to_make_the_run_again) {
  const test::TemporaryFolder folder;
  ClosedLoopOptions options;
  options.record_path = folder / "run.mcap";
  const config::Scenario scenario =
      short_walk({"randomise={initial.yaw: [0.0, 0.1]}", "description=it's me"});
  (void)run_closed_loop(scenario, options);
  const logging::LogHeader header = logging::LogReader(folder / "run.mcap").header();
  EXPECT_TRUE(header.command.starts_with("surefoot run walk_flat_sea --seed 3 --set "));
  EXPECT_TRUE(header.command.ends_with(R"( --set 'description=it'\''s me')")) << header.command;
  EXPECT_EQ(header.description, "it's me");
  ASSERT_EQ(header.drawn.size(), scenario.drawn.size());
  ASSERT_FALSE(header.drawn.empty());
  EXPECT_EQ(header.drawn[0].path, scenario.drawn[0].path);
  EXPECT_EQ(header.drawn[0].value, scenario.drawn[0].value);
}

TEST(ClosedLoop, the_log_holds_the_ground_as_the_plant_has_it) {
  const std::vector<logging::LogTerrain> flat = log_terrain({});
  ASSERT_EQ(flat.size(), 1u);
  EXPECT_EQ(flat[0].shape, "plane");
  simulation::TerrainRandomBoxes boxes;
  boxes.size_x = 0.9;
  boxes.size_y = 0.6;
  boxes.cell = 0.3;
  simulation::TerrainHeightField field;
  field.amplitude = 0.02;
  simulation::TerrainOptions terrain;
  terrain.elements = {boxes, field};
  const std::vector<logging::LogTerrain> rough = log_terrain(terrain);
  ASSERT_EQ(rough.size(), 7u) << "3 × 2 boxes, one field";
  EXPECT_EQ(rough[0].size.x(), 0.3);
  EXPECT_EQ(rough[6].heights.size(), static_cast<std::size_t>(rough[6].columns * rough[6].rows));
}

TEST(ClosedLoop, notes_tell_once_what_was_left_out_and_no_place_on_this_machine) {
  const std::vector<std::string> notes = run_closed_loop(short_walk(), {}).notes;
  ASSERT_EQ(notes.size(), 1u) << "controller and plant say the same of the base's inertia";
  EXPECT_TRUE(test::holds(notes[0], "\"base\"")) << notes[0];
  EXPECT_FALSE(test::holds(notes[0], "/")) << notes[0];
}

TEST(ClosedLoop, a_robot_that_is_knocked_over_ends_the_run_as_fallen) {
  const RunResult result = run_closed_loop(
      short_walk({"duration=6",
                  "disturbances.pushes.hard={time: 0.1, duration: 0.3, force: [0, 900, 0]}"}),
      {});
  EXPECT_EQ(result.ending, Ending::fell);
  EXPECT_TRUE(result.metrics.fell);
  EXPECT_TRUE(test::holds(result.metrics.reason, "fell at")) << result.metrics.reason;
  EXPECT_LT(result.metrics.duration_s, 1.0);
  EXPECT_NE(result.metrics.succeeded, true);
}

TEST(ClosedLoop, a_stop_for_safety_before_a_fall_counts_and_after_it_does_not) {
  const std::string push =
      "disturbances.pushes.hard={time: 0.1, duration: 0.3, force: [0, 900, 0]}";
  const RunResult stopped = run_closed_loop(
      short_walk({"duration=6", "safety.max_tilt=0.1", "guard.consistency.enabled=false",
                  "guard.sure_acceleration_step=1e4", "guard.sure_gyro_step=1e3", push}),
      {});
  EXPECT_TRUE(stopped.metrics.fell);
  EXPECT_TRUE(stopped.safety_stop);
  EXPECT_TRUE(test::holds(stopped.metrics.reason, "the controller stopped for safety at 0."));
  EXPECT_TRUE(test::holds(stopped.metrics.reason, " s: the torso tilted too far, then fell at 0."));
  // By default the controller gives up at about the tilt that is a fall. A robot that is thrown
  // about may be stopped before that, by sensors that no walk would shake so; some pushes throw it
  // over first.
  int falls_alone = 0;
  for (const char* force : {"[0, 120, 0]", "[0, 130, 0]", "[0, 150, 0]", "[0, -140, 0]"}) {
    const RunResult hit = run_closed_loop(
        short_walk({"duration=6", "planner.push.enabled=false", "external_force.enabled=false",
                    "guard.consistency.enabled=false", "guard.max_acceleration_step=1e4",
                    "guard.max_gyro_step=1e3", "guard.sure_acceleration_step=1e4",
                    "guard.sure_gyro_step=1e3",
                    "disturbances.pushes.hard={time: 0.1, duration: 1.5, force: " +
                        std::string(force) + "}"}),
        {});
    if (!hit.metrics.fell) continue;
    EXPECT_EQ(test::holds(hit.metrics.reason, "stopped for safety at"), hit.safety_stop) << force;
    falls_alone += hit.metrics.reason.find("fell at ") == 0 ? 1 : 0;
  }
  EXPECT_GT(falls_alone, 0);
}

TEST(ClosedLoop, standing_finds_the_height_of_best_manipulability) {
  const config::Scenario scenario = config::load_scenario({"manipulability_standing", 0, {}});
  const double best = best_height(scenario);
  const RunResult result = run_closed_loop(scenario, {});
  EXPECT_NEAR(result.metrics.base_height_end_m, best, 5e-4);
  // The scenario's own criterion is about this optimum.
  const auto criterion =
      std::ranges::find(scenario.criteria, "base_height_end_m", &evaluation::Criterion::metric);
  ASSERT_NE(criterion, scenario.criteria.end());
  EXPECT_NEAR((criterion->min.value() + criterion->max.value()) / 2.0, best, 1e-4);
}

TEST(ClosedLoop, options_that_make_no_sense_are_told_before_the_run) {
  config::Scenario scenario = short_walk();
  scenario.plant.control_period = 0.0007;
  EXPECT_TRUE(test::holds(test::message_of([&] { check_setup(scenario); }), "control_period"));
}

}  // namespace
}  // namespace surefoot::closed_loop
