#include "server/live_view.hpp"
#include "surefoot/config/stack_text.hpp"
#include "surefoot/explain/explanation_json.hpp"
#include "surefoot/logging/log_reader.hpp"
#include "surefoot/logging/message_decoder.hpp"
#include "surefoot/replay/log_replay.hpp"
#include "tests/server/live_test_run.hpp"
#include "tests/server/logged_changes.hpp"
#include "tests/support/messages.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace surefoot::server {
namespace {

using test::changes_of;
using test::LiveTestRun;
using Type = ViewCommandType;

ViewCommand gain(const std::string& level, const std::string& name, double value) {
  return {.type = Type::gain, .level = level, .task = level, .name = name, .value = value};
}

/// The levels of a run with the torso's yaw one place higher.
std::vector<std::string> with_yaw_higher(const LiveTestRun& run) {
  std::vector<std::string> order = config::level_names(run.scenario.controller.stack);
  const auto yaw = std::ranges::find(order, "torso_yaw");
  std::iter_swap(yaw, yaw - 1);
  return order;
}

TEST(LiveControl, a_run_whose_control_was_changed_is_replayed_to_the_bit) {
  LiveTestRun run({"duration=4"});
  run.at(300, gain("com_xy", "kp", 60.0));
  run.at(310, gain("swing_foot", "kp", 300.0));
  run.at(600, ViewCommand{.type = Type::order, .levels = with_yaw_higher(run)});
  run.at(900, ViewCommand{.type = Type::friction, .value = 0.3});
  run.at(1200, ViewCommand{.type = Type::friction, .value = 0.5});
  run.at(1210, gain("com_xy", "kp", 80.0));
  EXPECT_EQ(run.record().changes, 6) << "as many as the log has";
  EXPECT_EQ(run.errors, std::vector<std::string>(6));

  std::vector<std::string> kinds;
  for (const logged::Change& change : changes_of(run.log)) kinds.push_back(change.kind);
  EXPECT_EQ(kinds,
            (std::vector<std::string>{"stack", "stack", "stack", "friction", "friction", "stack"}));
  EXPECT_TRUE(test::holds(run.changes[0], "com_xy kp "));
  EXPECT_EQ(run.changes[4], "friction 0.3 → 0.5");

  replay::LogReplay replay(run.log);
  int different = 0, ticks = 0, going_on = 0;
  for (; replay.step(); ++ticks) {
    different += replay.is_same() ? 0 : 1;
    going_on += replay.logged().hierarchy.transition_share < 1.0 ? 1 : 0;
  }
  EXPECT_EQ(ticks, 1600);
  EXPECT_EQ(different, 0);
  EXPECT_NEAR(going_on, 4 * 120, 8);
}

TEST(LiveControl, levels_keep_their_names_and_numbers_when_their_order_is_changed) {
  LiveTestRun run({"duration=1.2"});
  const std::vector<std::string> names = config::level_names(run.scenario.controller.stack);
  const std::vector<std::string> order = with_yaw_higher(run);
  run.at(100, ViewCommand{.type = Type::order, .levels = order});
  run.record();
  std::vector<std::string> last;
  logging::McapReader file(run.log);
  for (logging::McapMessage message; file.next(message);) {
    if (message.channel->topic != "/hierarchy") continue;
    logged::Hierarchy hierarchy;
    logged::Decoder::decode(message.data, hierarchy);
    last.clear();
    for (const logged::Level& level : hierarchy.levels) last.push_back(level.name);
    for (const logged::Row& row : hierarchy.active) EXPECT_NE(row.row, "?");
  }
  EXPECT_EQ(last, order) << "as they stand above each other";
  logging::LogReader log(run.log);
  TickRecord tick;
  const auto number =
      static_cast<std::size_t>(std::ranges::find(names, "torso_yaw") - names.begin());
  const std::vector<double> residual = run.of("hierarchy.level.torso_yaw.residual");
  for (std::size_t i = 0; log.next(tick); ++i) {
    ASSERT_EQ(residual[i], static_cast<float>(tick.hierarchy.levels[number].residual));
  }
}

TEST(LiveControl, an_explained_tick_has_the_order_that_its_levels_had) {
  LiveTestRun run({"duration=0.5"});
  std::vector<std::string> order = config::level_names(run.scenario.controller.stack);
  std::swap(order[order.size() - 1], order[order.size() - 2]);
  run.at(100, {.type = Type::order, .levels = order});
  run.record();
  const auto names = [&](double time) {
    const explain::TickExplanation tick = explain::read_tick(run.log, time);
    std::vector<std::string> list;
    for (const std::int16_t level : tick.order) {
      list.push_back(tick.header.level_names.at(static_cast<std::size_t>(level)));
    }
    return list;
  };
  EXPECT_EQ(names(0.1), config::level_names(run.scenario.controller.stack));
  EXPECT_EQ(names(0.49), order);
  const std::string text = explain::read_tick(run.log, 0.49).text();
  EXPECT_LT(text.find(" " + order[order.size() - 2]), text.find(" " + order.back()));
}

TEST(LiveControl, an_explained_tick_between_two_orders_says_so_and_what_those_beside_it_gave) {
  LiveTestRun run({"duration=1.5"});
  run.at(100, {.type = Type::order, .levels = with_yaw_higher(run)});
  run.record();
  const auto at = [&](double time) { return explain::read_tick(run.log, time); };
  for (const double time : {0.1, 0.2475, 0.55, 1.45}) {
    EXPECT_FALSE(at(time).blend) << time;
    EXPECT_FALSE(test::holds(at(time).sentence(), "blended")) << time;
    EXPECT_TRUE(explain::explanation_json(at(time)).at("blend").is_null());
  }
  for (const double time : {0.25, 0.4, 0.5475}) {
    const explain::TickExplanation tick = at(time);
    ASSERT_TRUE(tick.blend && tick.blend->before && tick.blend->after) << time;
    const std::string text = tick.sentence();
    EXPECT_TRUE(text.starts_with("Two hierarchies are blended until 0.5500 s (order: ")) << text;
    EXPECT_FALSE(test::holds(text, "not known")) << text;
    const std::string before = at(0.2475).sentence(), behind = at(0.55).sentence();
    EXPECT_TRUE(
        text.ends_with(" Before it, at 0.2475 s: " + before + " Behind it, at 0.5500 s: " + behind))
        << text;
    EXPECT_EQ(explain::explanation_json(tick).at("blend").at("until"), 0.55);
  }
}

TEST(LiveControl, of_a_blend_that_the_log_ends_in_it_is_not_said_until_when) {
  LiveTestRun run({"duration=0.4"});
  run.at(100, gain("com_xy", "kp", 60.0));
  run.record();
  const std::string text = explain::read_tick(run.log, 0.39).sentence();
  EXPECT_TRUE(text.starts_with("Two hierarchies are blended (com_xy kp ")) << text;
  EXPECT_TRUE(test::holds(text, "Before it, at 0.2475 s: ")) << text;
  EXPECT_FALSE(test::holds(text, "Behind")) << text;
}

TEST(LiveControl, torques_do_not_jump_when_a_gain_does) {
  const auto largest_step = [](bool change) {
    LiveTestRun run({"duration=3"});
    if (change) run.at(800, gain("torso_height", "kp", 5.0));
    run.run();
    double largest = 0.0;
    for (std::size_t joint = 0; joint < kNumLegJoints; ++joint) {
      const std::vector<double> torque = run.of("command.torque", joint);
      for (std::size_t i = 795; i < 830; ++i) {
        largest = std::max(largest, std::abs(torque[i + 1] - torque[i]));
      }
    }
    return largest;
  };
  EXPECT_LT(largest_step(true), largest_step(false) + 0.5);
}

}  // namespace
}  // namespace surefoot::server
