#include "app/live_view.hpp"
#include "surefoot/evaluation/truth_fields.hpp"
#include "surefoot/logging/log_reader.hpp"
#include "tests/app/live_test_run.hpp"
#include "tests/app/logged_changes.hpp"
#include "tests/config/messages.hpp"
#include "tests/logging/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

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
