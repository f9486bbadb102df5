#include "app/live_view.hpp"
#include "app/log_content.hpp"
#include "app/tick_explanation.hpp"
#include "surefoot/base/formatted.hpp"
#include "surefoot/evaluation/truth_fields.hpp"
#include "surefoot/logging/log_reader.hpp"
#include "tests/app/live_test_run.hpp"
#include "tests/app/logged_changes.hpp"
#include "tests/config/messages.hpp"
#include "tests/logging/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>
#include <functional>
#include <thread>

namespace surefoot {
namespace {

using test::changes_of;
using test::LiveTestRun;
using Type = ViewCommandType;

constexpr double kPeriod = 0.0025;

TEST(LiveForces, a_push_moves_the_robot_by_its_impulse_and_stands_in_the_log) {
  const test::TemporaryFolder folder;
  LiveTestRun still({"duration=1"}), pushed({"duration=1"});
  still.run();
  pushed.at(
      200,
      ViewCommand{
          .type = Type::push, .body = "base", .impulse = Vec3(0.0, 12.0, 0.0), .duration = 0.1});
  pushed.run(folder / "run.mcap");
  EXPECT_EQ(pushed.errors, std::vector<std::string>{""});
  const std::vector<double> before = still.of("truth.v_WCom", 1),
                            after = pushed.of("truth.v_WCom", 1);
  double fastest = 0.0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    fastest = std::max(fastest, after[i] - before[i]);
    if (i < 200) {
      ASSERT_EQ(after[i], before[i]);
    }
  }
  EXPECT_GT(fastest, 0.05);
  const std::vector<logged::Change> changes = changes_of(folder / "run.mcap");
  ASSERT_EQ(changes.size(), 1u);
  EXPECT_EQ(changes[0].kind, "push");
  EXPECT_EQ(changes[0].body, "base");
  EXPECT_NEAR(changes[0].time, 200 * kPeriod, 2 * kPeriod);
  EXPECT_NEAR(changes[0].force.y() * changes[0].duration, 12.0, 1e-9);
  EXPECT_TRUE(test::holds(pushed.messages.at(0), "push of 12 N·s at base"));
}

TEST(LiveForces, a_pull_at_a_point_turns_the_robot_and_ends_when_it_is_not_renewed) {
  LiveTestRun run({"duration=6"});
  for (long tick = 100; tick < 300; tick += 10) {
    run.at(tick, ViewCommand{.type = Type::pull,
                             .body = "base",
                             .point = Vec3(0.3, 0.0, 0.0),
                             .force = Vec3(0.0, 40.0, 0.0)});
  }
  run.run();
  EXPECT_EQ(run.errors, std::vector<std::string>(20));
  double most = 0.0;
  for (const double rate : run.of("truth.w_WB_B", 2)) most = std::max(most, rate);
  EXPECT_GT(most, 0.02);
  ASSERT_EQ(run.messages.size(), 2u);
  EXPECT_TRUE(test::holds(run.messages[0], "pull at base"));
  EXPECT_TRUE(test::holds(run.messages[1], "the pull ends"));
}

TEST(LiveForces, a_pull_that_still_acts_ends_with_the_run) {
  const test::TemporaryFolder folder;
  LiveTestRun run({"duration=0.5"});
  for (long tick = 100; tick < 200; tick += 10) {
    run.at(tick, ViewCommand{.type = Type::pull, .body = "base", .force = Vec3(0.0, 40.0, 0.0)});
  }
  run.run(folder / "run.mcap");
  const std::vector<logged::Change> changes = changes_of(folder / "run.mcap");
  ASSERT_FALSE(changes.empty());
  EXPECT_EQ(changes.back().kind, "pull");
  EXPECT_TRUE(changes.back().force.isZero());
  EXPECT_NEAR(changes.back().time, 200 * kPeriod, 1e-9) << "the last tick's force has acted";
  ASSERT_EQ(run.messages.size(), 2u);
  EXPECT_TRUE(test::holds(run.messages[1], "the pull ends after"));
  EXPECT_TRUE(test::holds(run.feed.status(1), R"("pull":{)"));
  run.feed.set_ended("fell");
  (void)run.feed.blocks();
  EXPECT_TRUE(test::holds(run.feed.status(1), R"("pull":null)"));
}

/// What a page is told of a run, in the order of time; what pulls gave is not compared.
std::vector<nlohmann::json> told_by(WebContent& content) {
  std::vector<nlohmann::json> events;
  for (nlohmann::json event : nlohmann::json::parse(content.get("/api/events", {}).body)) {
    if (!event.is_object()) continue;
    if (event.contains("force")) event["force"].erase("given");
    events.push_back(std::move(event));
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
  for (const NearbyEvent& event : read_tick(path, time).events)
    if (event.by == whose) texts.push_back(event.text);
  return texts;
}

TEST(LiveForces, a_log_tells_of_forces_what_the_live_page_was_told) {
  const test::TemporaryFolder folder;
  LiveTestRun run({"duration=1.2", "disturbances.pushes.a.time=0.412",
                   "disturbances.pushes.a.duration=0.3", "disturbances.pushes.a.force.y=35"});
  for (long tick = 100; tick < 280; tick += 10) {  // the mouse moves
    const Vec3 force(0.0, 20.0 + 0.1 * static_cast<double>(tick), 0.0);
    run.at(tick, ViewCommand{.type = Type::pull, .body = "base", .force = force});
  }
  run.run(folder / "run.mcap");
  const std::vector<nlohmann::json> live = told_by(run.feed);
  EXPECT_EQ(live, told_by_log(folder / "run.mcap"));
  std::vector<nlohmann::json> scenario, pulls;
  for (const nlohmann::json& event : live) {
    if (event.at("kind") == "mode") continue;
    (event.at("kind") == "force" ? scenario : pulls).push_back(event);
  }
  ASSERT_EQ(scenario.size(), 2u);
  EXPECT_TRUE(scenario[0].at("text").get<std::string>().starts_with("pushed by 35 N, "));
  EXPECT_NEAR(scenario[0].at("time").get<double>(), 0.412, kPeriod);
  EXPECT_EQ(scenario[1].at("text"), "the push on the base ends");
  EXPECT_NEAR(scenario[1].at("time").get<double>(), 0.712, kPeriod);
  ASSERT_EQ(pulls.size(), 2u) << "begin and end";
  const std::vector<std::string> explained = told_by_explain(folder / "run.mcap", 0.6, "outside");
  ASSERT_EQ(explained.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(explained[i], scenario[i].at("text"));
}

TEST(LiveForces, of_a_pull_that_began_long_before_a_tick_explain_tells_the_end_once) {
  const test::TemporaryFolder folder;
  LiveTestRun run({"duration=1.8"});
  run.at(100, ViewCommand{.type = Type::pull, .body = "base", .force = Vec3(0.0, 40.0, 0.0)});
  run.at(500, ViewCommand{.type = Type::pull, .body = "base", .force = Vec3::Zero()});
  run.run(folder / "run.mcap");
  EXPECT_EQ(told_by_explain(folder / "run.mcap", 1.6, "operator").size(), 1u);
  EXPECT_TRUE(told_by_explain(folder / "run.mcap", 1.6, "outside").empty());
}

TEST(LiveForces, what_the_operator_began_long_before_a_tick_is_no_force_of_the_scenario) {
  const test::TemporaryFolder folder;
  LiveTestRun run({"duration=2.4", "disturbances.pushes.a.time=1.9",
                   "disturbances.pushes.a.duration=0.2", "disturbances.pushes.a.force.y=35"});
  run.at(100,
         ViewCommand{
             .type = Type::push, .body = "base", .impulse = Vec3(0.0, 9.0, 0.0), .duration = 1.0});
  for (long tick = 120; tick < 760; tick += 10)  // the mouse stays
    run.at(tick, ViewCommand{.type = Type::pull, .body = "base", .force = Vec3(0.0, 5.0, 0.0)});
  run.run(folder / "run.mcap");
  EXPECT_EQ(run.errors, std::vector<std::string>(65));
  const std::vector<std::string> explained = told_by_explain(folder / "run.mcap", 2.2, "outside");
  ASSERT_EQ(explained.size(), 2u);
  EXPECT_TRUE(explained[0].starts_with("pushed by 35 N, ")) << explained[0];
  EXPECT_EQ(explained[1], "the push on the base ends");
  EXPECT_EQ(told_by_explain(folder / "run.mcap", 2.2, "operator").size(), 1u) << "the pull's end";
}

TEST(LiveForces, a_pull_that_ends_says_what_it_gave) {
  const test::TemporaryFolder folder;
  LiveTestRun run({"duration=0.5"});
  for (const long tick : {100, 150}) {
    const Vec3 force(0.0, tick == 100 ? 60.0 : 20.0, 0.0);
    run.at(tick, ViewCommand{.type = Type::pull, .body = "base", .force = force});
  }
  run.run(folder / "run.mcap");
  ASSERT_EQ(run.messages.size(), 2u);
  const auto end = nlohmann::json::parse(run.messages[1]);
  const double given = end.at("force").at("given");
  EXPECT_NEAR(given, 40.0 * 100 * kPeriod, 40.0 * 2 * kPeriod);
  EXPECT_EQ(end.at("text"), formatted("the pull ends after %.1f N·s", given));
  EXPECT_EQ(end.at("force").at("begins"), false);
}

/// The forces of a log on the robot: those that its truth has at each tick, and those that a plant
/// has which gets the log's torques and changes and nothing else.
struct ForcesOfLog {
  std::vector<std::vector<double>> logged, again;
  std::size_t other_states = 0;  // ticks at which that plant's robot is elsewhere
};

ForcesOfLog forces_of(const std::string& path, const Scenario& scenario) {
  std::vector<GroundTruth> truths;
  std::vector<logged::Change> changes;
  std::vector<JointCommand> commands;
  LogReader log(path, [&](const McapMessage& message) {
    if (message.channel->topic == "/truth")
      logged::Decoder::decode(message.data, truths.emplace_back());
    if (message.channel->topic == "/changes")
      logged::Decoder::decode(message.data, changes.emplace_back());
  });
  for (TickRecord tick; log.next(tick);) commands.push_back(tick.command);
  ForcesOfLog forces;
  Plant plant(scenario.robot, scenario.plant);
  auto next = changes.begin();
  for (std::size_t i = 0; i < std::min(truths.size(), commands.size()); ++i) {
    for (; next != changes.end() && next->time <= plant.time() + 1e-9; ++next) {
      if (next->kind == "push")
        plant.push({.body = next->body,
                    .time = next->time,
                    .duration = next->duration,
                    .force = next->force});
      if (next->kind == "pull")
        plant.pull({.body = next->body, .point = next->point, .force = next->force});
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

ViewCommand push_of(double newton_seconds, double duration) {
  return {.type = Type::push,
          .body = "base",
          .impulse = Vec3(0.0, newton_seconds, 0.0),
          .duration = duration};
}

TEST(LiveForces,
     a_plant_that_gets_the_logged_torques_pushes_and_pulls_goes_the_same_way_to_the_bit) {
  const test::TemporaryFolder folder;
  LiveTestRun run({"duration=1"});
  for (long tick = 40; tick < 240; ++tick) {
    run.at(tick, {.type = Type::pull,
                  .body = "base",
                  .point = Vec3(0.2, 0.0, 0.1),
                  .force = Vec3(0, 20 + 0.1 * double(tick), 3.0 * std::sin(0.1 * double(tick)))});
  }
  run.at(100, push_of(5.0, 0.13));
  run.at(240, {.type = Type::pull, .body = "base", .force = Vec3::Zero()});
  run.run(folder / "run.mcap");
  const ForcesOfLog forces = forces_of(folder / "run.mcap", run.scenario);
  ASSERT_EQ(forces.logged.size(), 400u);
  EXPECT_EQ(forces.logged, forces.again);
  EXPECT_EQ(forces.other_states, 0u);
  const auto changes = changes_of(folder / "run.mcap");
  EXPECT_LE(changes.size(), 15u) << "a pull is another one at most 20 times a second";
  EXPECT_TRUE(changes.back().force.isZero()) << "its end is one of them";
  double impulse = 0.0;  // of what the log says
  for (std::size_t i = 0; i + 1 < changes.size(); ++i) {
    if (changes[i].kind != "pull") continue;
    const auto until = std::find_if(changes.begin() + static_cast<long>(i) + 1, changes.end(),
                                    [](const logged::Change& one) { return one.kind == "pull"; });
    impulse += changes[i].force.norm() * (until->time - changes[i].time);
  }
  const std::string end = "the pull ends after ";
  ASSERT_TRUE(changes.back().text.starts_with(end)) << changes.back().text;
  EXPECT_NEAR(std::stod(changes.back().text.substr(end.size())), impulse, 0.01 * impulse);
  EXPECT_EQ(run.messages.size(), 3u) << "pages hear of the pull's begin and end, and of the push";
}

TEST(LiveForces, pushes_that_are_pressed_while_it_is_paused_do_not_add_up_beyond_the_limits) {
  const test::TemporaryFolder folder;
  LiveTestRun run({"duration=0.6"});
  run.at(100, {.type = Type::pause});
  for (int i = 0; i < 8; ++i) run.at(100, push_of(30.0, 0.2));
  run.at(100, {.type = Type::resume});
  run.at(104, push_of(50.0, 0.2));
  run.run(folder / "run.mcap");
  double most = 0.0;
  for (const std::vector<double>& applied : forces_of(folder / "run.mcap", run.scenario).logged)
    most = std::max(most, force_in(applied));
  EXPECT_NEAR(most, 300.0, 1e-6);
  const auto changes = changes_of(folder / "run.mcap");
  EXPECT_EQ(changes.size(), 2u) << "two of 30 N·s; what is left out is no change";
  const auto left_out = std::ranges::count_if(run.messages, [](const std::string& text) {
    return text.find("is left out") != std::string::npos;
  });
  EXPECT_EQ(left_out, 7);
}

TEST(LiveForces, pushes_that_wait_are_told_and_counted_before_a_tick_has_them) {
  LiveTestRun run({"duration=0.6"});
  std::vector<nlohmann::json> told;
  std::size_t heard = 0;
  std::deque<ViewCommand> commands{push_of(15.0, 0.2), push_of(45.0, 0.2), push_of(15.0, 0.2)};
  std::function<void()> go_on = [&] {
    told.push_back(nlohmann::json::parse(run.feed.status(1)));
    heard = run.messages.size();
    if (commands.empty()) commands.push_back({.type = Type::resume});
    EXPECT_EQ(run.wishes.command(commands.front()), "");
    const bool is_last = commands.front().type == Type::resume;
    commands.pop_front();
    if (!is_last) run.at(100, go_on);
  };
  run.at(100, {.type = Type::pause});
  run.at(100, go_on);
  run.at(102, [&] { told.push_back(nlohmann::json::parse(run.feed.status(1))); });
  run.run();
  ASSERT_EQ(told.size(), 5u);
  std::vector<double> left;
  std::vector<std::string> pending;
  for (const nlohmann::json& status : told) {
    left.push_back(std::round(status.at("newton_seconds_left").get<double>()));
    pending.push_back(status.at("pending"));
  }
  EXPECT_EQ(left, (std::vector<double>{60, 45, 0, 0, 0}));
  EXPECT_EQ(pending,
            (std::vector<std::string>{"", "push of 15 N·s at base", "2 pushes, 60 N·s together",
                                      "2 pushes, 60 N·s together", ""}));
  ASSERT_EQ(heard, 1u) << "of pushes that wait nothing is told as done";
  EXPECT_TRUE(test::holds(run.messages[0], "300 N act already or wait for the next tick"));
  EXPECT_EQ(run.messages.size(), 3u) << "both, once they act";
}

TEST(LiveForces, a_pull_fades_towards_what_may_be_given_each_second) {
  LiveTestRun run({"duration=3"});
  std::string status;
  for (long tick = 40; tick < 1200; tick += 10)
    run.at(tick, {.type = Type::pull, .body = "base", .force = Vec3(0, 0, 300)});
  run.at(1190, [&] { status = run.feed.status(1); });
  run.run();
  const std::vector<double> height = run.of("truth.xfrc_applied", 6 + 2);  // of the base
  EXPECT_NEAR(*std::ranges::max_element(height), 300.0, 1e-6);
  EXPECT_NEAR(height[1195], 60.0, 1.0);
  double given = 0.0;
  for (std::size_t i = 0; i < height.size(); ++i) {
    given += kPeriod * height[i];
    const std::size_t from = i >= 400 ? i - 400 : 0;
    double second = 0.0;
    for (std::size_t k = from; k < i; ++k) second += kPeriod * height[k];
    ASSERT_LE(second, 120.0) << "what the store had and what filled it";
  }
  EXPECT_GT(given, 180.0);
  EXPECT_TRUE(test::holds(status, R"("pull_is_weaker":true)")) << status;
  EXPECT_TRUE(test::holds(status, R"("push":null)"));
}

}  // namespace
}  // namespace surefoot
