#include "surefoot/config/scenario_file.hpp"
#include "tests/support/messages.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace surefoot::config {
namespace {

using test::holds;
using test::message_of;

Scenario load(std::uint64_t seed, const std::vector<std::string>& changes = {}) {
  std::vector<std::string> assignments{
      "duration=40",
      "random_commands={from: 20, period: 0.5, velocity_min: [-0.1, -0.2],"
      " velocity_max: [0.3, 0.0], yaw_rate: 0.4, gaits: true}",
      "gaits=[trot, pace, stand]",
      "user=[{time: 1, walk: true, velocity: [0.5, 0.0]}, {time: 30, walk: false}]"};
  assignments.insert(assignments.end(), changes.begin(), changes.end());
  return load_scenario({.name_or_path = "trot", .seed = seed, .assignments = assignments});
}

TEST(RandomCommands, TakeThePlaceOfTheUsersInTheirRanges) {
  const Scenario scenario = load(3);
  EXPECT_EQ(scenario.user(19.9).velocity.x(), 0.5);
  Vec2 lowest = Vec2::Constant(9.0), highest = -lowest;
  double left = 0.0, right = 0.0;
  std::array<int, 3> gaits{};
  for (int k = 0; k < 40; ++k) {
    const UserCommand& user = scenario.user(20.1 + 0.5 * k);
    EXPECT_TRUE(user.walk) << k;
    lowest = lowest.cwiseMin(user.velocity);
    highest = highest.cwiseMax(user.velocity);
    left = std::max(left, user.yaw_rate);
    right = std::min(right, user.yaw_rate);
    ++gaits.at(static_cast<std::size_t>(user.gait));
  }
  const Vec2 min(-0.1, -0.2), max(0.3, 0.0);
  EXPECT_TRUE((lowest.array() >= min.array()).all() && (highest.array() <= max.array()).all());
  EXPECT_TRUE(((lowest - min).array() < 0.05).all() && ((max - highest).array() < 0.05).all());
  EXPECT_TRUE(left > 0.3 && left <= 0.4 && right < -0.3 && right >= -0.4);
  EXPECT_TRUE(std::ranges::all_of(gaits, [](int count) { return count > 5; }));
  EXPECT_EQ(scenario.commands.size(), 2 + 40u);
}

TEST(RandomCommands, AreTheSeedsOwn) {
  EXPECT_EQ(load(3).user(25.0).velocity, load(3).user(25.0).velocity);
  EXPECT_NE(load(3).user(25.0).velocity, load(4).user(25.0).velocity);
}

TEST(RandomCommands, KeepTheGaitWithoutOthers) {
  for (const TimedCommand& command : load(3, {"random_commands.gaits=false"}).commands)
    EXPECT_EQ(command.user.gait, UserCommand::kOwnGait);
}

TEST(RandomCommands, NeedARange) {
  const std::string message =
      message_of([] { (void)load(1, {"random_commands.velocity_max.x=-0.2"}); });
  EXPECT_TRUE(holds(message, "velocity_min")) << message;
  EXPECT_TRUE(holds(message, "must not be above velocity_max")) << message;
}

}  // namespace
}  // namespace surefoot::config
