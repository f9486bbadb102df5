#include "cli/results_json.hpp"
#include "cli/results_table.hpp"
#include "surefoot/base/text_table.hpp"
#include "surefoot/evaluation/metric_table.hpp"
#include "tests/support/messages.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace surefoot::cli {
namespace {

using config::Scenario;
using test::holds;
using Json = nlohmann::ordered_json;

TEST(RunJson, holds_every_metric_the_criteria_and_what_was_drawn) {
  Scenario scenario;
  scenario.name = "trial";
  closed_loop::RunResult result;
  result.metrics.com_error_max_m = 0.5;
  result.criteria = {{{"com_error_max_m", {}, 1.0, {}}, 0.5, true}};
  result.drawn = {{"terrain.friction", 0.7}};
  const Json json = run_json(scenario, result);
  EXPECT_EQ(json.at("scenario"), "trial");
  for (const auto& [name, value] : evaluation::values(evaluation::Metrics()))
    EXPECT_TRUE(json.contains(std::string(name))) << name;
  EXPECT_EQ(json.at("com_error_max_m"), 0.5);
  EXPECT_EQ(json.at("criteria")[0].at("max"), 1.0);
  EXPECT_EQ(json.at("criteria")[0].at("passed"), true);
  EXPECT_EQ(json.at("drawn").at("terrain.friction"), 0.7);
  EXPECT_TRUE(json.at("solve_us").contains("p99"));
}

/// A run in which a foot found no ground.
closed_loop::RunResult with_event(int count) {
  closed_loop::RunResult result;
  result.events = {{PlanEvent::no_ground, Leg::LF, count, 5.25}};
  return result;
}

TEST(RunTable, beside_the_verdict_stands_how_often_the_run_was_changed_by_hand) {
  closed_loop::RunResult result = with_event(3);
  const auto table = [&] { return run_table(Scenario{}, run_json(Scenario{}, result)); };
  EXPECT_FALSE(run_json(Scenario{}, result).contains("changes_by_hand"));
  EXPECT_FALSE(holds(table(), "by hand"));
  result.changes = 0;
  EXPECT_EQ(run_json(Scenario{}, result).at("changes_by_hand"), 0);
  EXPECT_FALSE(holds(table(), "by hand"));
  result.changes = 46;
  EXPECT_EQ(run_json(Scenario{}, result).at("changes_by_hand"), 46);
  EXPECT_TRUE(holds(table(),
                    "\nsteered by hand: 46 changes and pushes while it ran, so this is no "
                    "verdict on the scenario alone\n\n"));
}

TEST(Pretty, says_units_after_the_metrics_name) {
  EXPECT_EQ(pretty("com_error_max_m", 0.00012), "0.12 mm");
  EXPECT_EQ(pretty("distance_m", 1.85), "1.85 m");
  EXPECT_EQ(pretty("torque_max_nm", 40), "40 N·m");
  EXPECT_EQ(pretty("speed_mps", 0.08), "0.08 m/s");
  EXPECT_EQ(pretty("duration_s", 24), "24 s");
  EXPECT_EQ(pretty("touchdown_latency_p95_s", 0.012), "12 ms");
  EXPECT_EQ(pretty("max_tilt_rad", 0.1), "5.73°");
  EXPECT_EQ(pretty("steps_taken", 30), "30");
  EXPECT_EQ(pretty("fell", false), "no");
  EXPECT_EQ(pretty("com_error_max_m", nullptr), "–");
}

TEST(Pretty, says_a_metric_in_one_unit_whatever_its_value) {
  EXPECT_EQ(pretty("com_lateral_sway_m", 0.139), "139 mm");
  EXPECT_EQ(pretty("com_lateral_sway_m", 0.0317), "31.7 mm");
  EXPECT_EQ(pretty("distance_m", 0.0317), "0.0317 m");
  EXPECT_EQ(pretty("base_height_end_m", 0.468), "0.468 m");
}

TEST(RunJson, tells_the_events_in_words_with_leg_count_and_first_time) {
  const Json json = run_json(Scenario{}, with_event(3));
  ASSERT_EQ(json.at("events").size(), 1u);
  EXPECT_EQ(json.at("events")[0].at("event"), "no ground within reach: foot taken back");
  EXPECT_EQ(json.at("events")[0].at("leg"), "LF");
  EXPECT_EQ(json.at("events")[0].at("count"), 3);
  EXPECT_EQ(json.at("events")[0].at("first_s"), 5.25);
  const std::string table = run_table(Scenario{}, json);
  EXPECT_TRUE(
      holds(table, "no ground within reach: foot taken back   LF   3 times   first at 5.2500 s"));
}

TEST(RunJson, of_a_scenario_without_a_goal_says_nothing_of_one) {
  const Json run = run_json(Scenario{}, closed_loop::RunResult{});
  EXPECT_TRUE(run.at("goal_reached").is_null());
  EXPECT_FALSE(check_json(Scenario{}).at("has_goal"));
  Scenario scenario;
  scenario.goal.feet_beyond_x = 1.0;
  EXPECT_TRUE(check_json(scenario).at("has_goal"));
}

TEST(RunJson, tells_of_sensors_among_the_events_in_the_order_of_time) {
  closed_loop::RunResult result = with_event(3);
  result.troubles = {{"IMU stopped", 2, 4.5}, {"command mode: sit", 1, 6.0}};
  const Json events = run_json(Scenario{}, result).at("events");
  ASSERT_EQ(events.size(), 3u);
  EXPECT_EQ(events[0].at("event"), "IMU stopped");
  EXPECT_TRUE(events[0].at("leg").is_null());
  EXPECT_EQ(events[0].at("count"), 2);
  EXPECT_EQ(events[1].at("leg"), "LF");
  EXPECT_EQ(events[2].at("event"), "command mode: sit");
}

TEST(Aligned, columns_start_together_whatever_the_letters_bytes) {
  EXPECT_EQ(aligned({{"µ", "x"}, {"abc", "y"}}), "µ     x\nabc   y\n");
}

TEST(RunTable, says_what_the_seed_drew_or_that_it_drew_nothing) {
  closed_loop::RunResult result;
  result.drawn = {{"terrain.friction", 0.5}};
  result.metrics.seed = 3;
  const auto table = [&] { return run_table(Scenario{}, run_json(Scenario{}, result)); };
  EXPECT_TRUE(holds(table(), "seed 3: terrain.friction 0.5\n"));
  result.metrics.seed = 0;
  result.drawn.clear();
  EXPECT_TRUE(holds(table(), "seed 0: nothing of `randomise:` is drawn"));
}

TEST(RunTable, counts_the_drawn_values_of_a_vector) {
  closed_loop::RunResult result;
  result.metrics.seed = 3;
  result.drawn = {{"initial.x", 0.2}, {"initial.yaw", 0.1}, {"disturbances.base_mass_scale", 0.9}};
  for (const char* joint : {"LF_HAA", "LF_HFE", "RH_KFE"})
    result.drawn.push_back({std::string("sensors.encoders.offset.") + joint, 0.001});
  for (const char* axis : {"x", "z"})
    result.drawn.push_back({std::string("disturbances.base_com_offset.") + axis, 0.01});
  const std::string table = run_table(Scenario{}, run_json(Scenario{}, result));
  EXPECT_TRUE(holds(table,
                    "seed 3: initial.x 0.2, initial.yaw 0.1, disturbances.base_mass_scale 0.9, "
                    "sensors.encoders.offset (3 values),\n"
                    "  disturbances.base_com_offset (2 values)\n"));
}

TEST(RunTable, shows_a_metric_beside_its_limit_and_the_papers_figure) {
  Scenario scenario;
  scenario.name = "trial";
  scenario.paper = {{"com_error_max_m", "≤ 3.4 mm"}};
  closed_loop::RunResult result;
  result.metrics.com_error_max_m = 0.0006;
  result.criteria = {{{"com_error_max_m", {}, 0.0005, {}}, 0.0006, false}};
  result.metrics.succeeded = false;
  const std::string table = run_table(scenario, run_json(scenario, result));
  EXPECT_TRUE(holds(table, "; missed: com_error_max_m\n"));
  std::string line = table.substr(table.find("com_error_max_m   "));
  line = line.substr(0, line.find('\n'));
  EXPECT_TRUE(holds(line, "0.6 mm"));
  EXPECT_TRUE(holds(line, "≤ 0.5 mm ✗"));
  EXPECT_TRUE(holds(line, "≤ 3.4 mm"));
}

TEST(RunTable, of_a_run_too_short_for_its_criteria_says_not_judged) {
  Scenario scenario;
  scenario.judged_after = 30.0;
  closed_loop::RunResult result;
  result.metrics.reason = "ran to its end";
  result.metrics.duration_s = 2.0;
  result.criteria = {{{"com_error_max_m", {}, 0.0005, {}}, 0.0001, std::nullopt}};
  const Json run = run_json(scenario, result);
  EXPECT_TRUE(run.at("succeeded").is_null());
  EXPECT_TRUE(run.at("criteria")[0].at("passed").is_null());
  const std::string table = run_table(scenario, run);
  EXPECT_TRUE(
      holds(table, "not judged: ran to its end after 2 of the 30 s that its criteria need\n"));
  EXPECT_TRUE(holds(table, "≤ 0.5 mm, not judged"));
  EXPECT_FALSE(holds(table, "did not succeed"));
}

std::size_t num_metrics(const std::string& table) {
  const auto is_told = [&](const evaluation::Metric& metric) {
    return metric.place != evaluation::Place::in_the_title &&
           holds(table, "\n" + std::string(metric.name) + " ");
  };
  return static_cast<std::size_t>(std::ranges::count_if(evaluation::metric_table(), is_told));
}

TEST(RunTable, shows_the_ten_that_matter_and_the_compared_ones_or_all) {
  Scenario scenario;
  scenario.paper = {{"penetration_max_m", "none"}};
  closed_loop::RunResult result;
  EXPECT_EQ(num_metrics(run_table({}, run_json({}, result))), 10u);
  result.criteria = {{{"edge_landings", {}, 3.0, {}}, 0.0, true},
                     {{"solve_us.p99", {}, 3.0, {}}, 0.0, true}};
  const Json run = run_json(scenario, result);
  EXPECT_EQ(num_metrics(run_table(scenario, run)), 13u);
  const std::size_t all = evaluation::metric_table().size() - 4;  // in the title
  EXPECT_EQ(num_metrics(run_table(scenario, run, true)), all);
  EXPECT_TRUE(holds(run_table(scenario, run), "--all shows the other " + std::to_string(all - 13)));
}

}  // namespace
}  // namespace surefoot::cli
