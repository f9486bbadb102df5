#include "server/live_view.hpp"
#include "server/log_content.hpp"
#include "surefoot/evaluation/truth_fields.hpp"
#include "surefoot/explain/tick_explanation.hpp"
#include "surefoot/logging/log_reader.hpp"
#include "tests/server/live_test_run.hpp"
#include "tests/server/logged_changes.hpp"
#include "tests/support/messages.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <thread>

namespace surefoot::server {
namespace {

using test::changes_of;
using test::LiveTestRun;
using Type = ViewCommandType;

constexpr double kPeriod = 0.0025;

ViewCommand push_of(double newton_seconds, double duration) {
  return {.type = Type::push,
          .body = "base",
          .impulse = Vec3(0.0, newton_seconds, 0.0),
          .duration = duration};
}

TEST(LiveForces, a_push_moves_the_robot_by_its_impulse_and_stands_in_the_log) {
  LiveTestRun still({"duration=1"}), pushed({"duration=1"});
  still.run();
  pushed.at(200, push_of(12.0, 0.1));
  pushed.record();
  EXPECT_EQ(pushed.errors, std::vector<std::string>{""});
  const std::vector<double> before = still.of("truth.v_SCom", 1),
                            after = pushed.of("truth.v_SCom", 1);
  double fastest = 0.0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    fastest = std::max(fastest, after[i] - before[i]);
    if (i < 200) {
      ASSERT_EQ(after[i], before[i]);
    }
  }
  EXPECT_GT(fastest, 0.05);
  const std::vector<logged::Change> changes = changes_of(pushed.log);
  ASSERT_EQ(changes.size(), 1u);
  EXPECT_EQ(changes[0].kind, "push");
  EXPECT_EQ(changes[0].body, "base");
  EXPECT_NEAR(changes[0].time, 200 * kPeriod, 2 * kPeriod);
  EXPECT_NEAR(changes[0].force.y() * changes[0].duration, 12.0, 1e-9);
  EXPECT_TRUE(test::holds(pushed.changes.at(0), "push of 12 N·s at base"));
}

/// What a page is told of a run, in the order of time.
std::vector<nlohmann::json> told_by(WebContent& content) {
  std::vector<nlohmann::json> events;
  for (nlohmann::json event : nlohmann::json::parse(content.get("/api/events", {}).body)) {
    if (event.is_object()) events.push_back(std::move(event));
  }
  std::ranges::stable_sort(
      events, {}, [](const nlohmann::json& event) { return event.at("time").get<double>(); });
  return events;
}

std::vector<nlohmann::json> told_by_log(const std::string& path) {
  LogContent content(path);
  const auto is_read = [&] {
    const auto session = nlohmann::json::parse(content.get("/api/session", {}).body);
    return session.at("summarised") == session.at("ticks");
  };
  while (!is_read()) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  return told_by(content);
}

/// Of the events around a tick those that are told as whose.
std::vector<std::string> told_by_explain(const std::string& path, double time,
                                         const std::string& whose) {
  std::vector<std::string> texts;
  for (const explain::NearbyEvent& event : explain::read_tick(path, time).events)
    if (event.by == whose) texts.push_back(event.text);
  return texts;
}

TEST(LiveForces, a_log_tells_of_forces_what_the_live_page_was_told) {
  LiveTestRun run({"duration=1.2", "disturbances.pushes.a.time=0.412",
                   "disturbances.pushes.a.duration=0.3", "disturbances.pushes.a.force.y=35"});
  for (const long tick : {100, 160}) run.at(tick, push_of(4.0, 0.4));
  run.record();
  const std::vector<nlohmann::json> live = told_by(run.feed);
  EXPECT_EQ(live, told_by_log(run.log));
  std::vector<nlohmann::json> scenario, pushes;
  for (const nlohmann::json& event : live) {
    if (event.at("kind") == "mode") continue;
    (event.at("kind") == "force" ? scenario : pushes).push_back(event);
  }
  ASSERT_EQ(scenario.size(), 2u);
  EXPECT_TRUE(scenario[0].at("text").get<std::string>().starts_with("pushed by 35 N, "));
  EXPECT_NEAR(scenario[0].at("time").get<double>(), 0.412, kPeriod);
  EXPECT_EQ(scenario[1].at("text"), "the push on the base ends");
  EXPECT_NEAR(scenario[1].at("time").get<double>(), 0.712, kPeriod);
  ASSERT_EQ(pushes.size(), 2u);
  const std::vector<std::string> explained = told_by_explain(run.log, 0.6, "outside");
  ASSERT_EQ(explained.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(explained[i], scenario[i].at("text"));
}

TEST(LiveForces, what_the_operator_began_long_before_a_tick_is_no_force_of_the_scenario) {
  LiveTestRun run({"duration=2.4", "disturbances.pushes.a.time=1.9",
                   "disturbances.pushes.a.duration=0.2", "disturbances.pushes.a.force.y=35"});
  run.at(100, push_of(9.0, 1.0));
  run.record();
  EXPECT_EQ(run.errors, std::vector<std::string>(1));
  const std::vector<std::string> explained = told_by_explain(run.log, 2.2, "outside");
  ASSERT_EQ(explained.size(), 2u);
  EXPECT_TRUE(explained[0].starts_with("pushed by 35 N, ")) << explained[0];
  EXPECT_EQ(explained[1], "the push on the base ends");
}

/// The forces of a log on the robot: those that its truth has at each tick, and those that a plant
/// has which gets the log's torques and changes and nothing else.
struct ForcesOfLog {
  std::vector<std::vector<double>> logged, again;
  std::size_t other_states = 0;  // ticks at which that plant's robot is elsewhere
};

ForcesOfLog forces_of(const std::string& path, const config::Scenario& scenario) {
  std::vector<simulation::GroundTruth> truths;
  std::vector<logged::Change> changes;
  std::vector<JointCommand> commands;
  logging::LogReader log(path, [&](const logging::McapMessage& message) {
    if (message.channel->topic == "/truth")
      logged::Decoder::decode(message.data, truths.emplace_back());
    if (message.channel->topic == "/changes")
      logged::Decoder::decode(message.data, changes.emplace_back());
  });
  for (TickRecord tick; log.next(tick);) commands.push_back(tick.command);
  ForcesOfLog forces;
  simulation::Plant plant(scenario.robot, scenario.plant);
  auto next = changes.begin();
  for (std::size_t i = 0; i < std::min(truths.size(), commands.size()); ++i) {
    for (; next != changes.end() && next->time <= plant.time() + 1e-9; ++next) {
      if (next->kind == "push")
        plant.push({.body = next->body,
                    .time = next->time,
                    .duration = next->duration,
                    .force = next->force});
    }
    forces.logged.push_back(truths[i].xfrc_applied);
    forces.again.push_back(plant.truth().xfrc_applied);
    forces.other_states += plant.truth().qpos == truths[i].qpos ? 0 : 1;
    (void)plant.read();
    plant.write(commands[i]);
  }
  return forces;
}

double force_in(const std::vector<double>& applied) {
  double sum = 0.0;
  for (std::size_t i = 0; i + 6 <= applied.size(); i += 6)
    sum = std::max(sum, Eigen::Map<const Vec3>(&applied[i]).norm());
  return sum;
}

TEST(LiveForces, a_plant_that_gets_the_logged_torques_and_pushes_goes_the_same_way_to_the_bit) {
  LiveTestRun run({"duration=1"});
  run.at(100, push_of(5.0, 0.13));
  run.at(120, push_of(3.0, 0.0513));
  run.record();
  const ForcesOfLog forces = forces_of(run.log, run.scenario);
  ASSERT_EQ(forces.logged.size(), 400u);
  EXPECT_EQ(forces.logged, forces.again);
  EXPECT_EQ(forces.other_states, 0u);
  EXPECT_EQ(changes_of(run.log).size(), 2u);
  EXPECT_EQ(run.changes.size(), 2u) << "pages hear of both";
}

TEST(LiveForces, pushes_that_are_pressed_while_it_is_paused_do_not_add_up_beyond_the_limits) {
  LiveTestRun run({"duration=0.6"});
  run.at(100, {.type = Type::pause});
  for (int i = 0; i < 8; ++i) run.at(100, push_of(30.0, 0.2));
  run.at(100, {.type = Type::resume});
  run.at(104, push_of(50.0, 0.2));
  run.record();
  double most = 0.0;
  for (const std::vector<double>& applied : forces_of(run.log, run.scenario).logged)
    most = std::max(most, force_in(applied));
  EXPECT_NEAR(most, 300.0, 1e-6);
  const auto changes = changes_of(run.log);
  EXPECT_EQ(changes.size(), 2u) << "two of 30 N·s; what is left out is no change";
  const auto left_out = std::ranges::count_if(run.messages, [](const std::string& text) {
    return text.find("is left out") != std::string::npos;
  });
  EXPECT_EQ(left_out, 7);
}

}  // namespace
}  // namespace surefoot::server
