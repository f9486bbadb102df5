#include "server/event_finder.hpp"

#include "server/view_tick.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace surefoot::server {
namespace {

/// A force along y on the trunk or the shank [N], from a time to another.
struct Acts {
  double from, to, force;
  std::size_t body = 1;
};

logged::Change change(const std::string& kind, double time, double force, double duration = kNaN,
                      const std::string& body = "trunk") {
  return {.time = time,
          .kind = kind,
          .text = {},
          .stack = {},
          .duration = duration,
          .body = body,
          .force = Vec3(0.0, force, 0.0)};
}

logging::LogHeader header() {
  logging::LogHeader header;
  header.level_names = {"first"};
  return header;
}

/// The events of four seconds in which these forces act, each in the physics' last step before a
/// tick, of which the operator did some; the changes of each second are known before its ticks.
std::vector<nlohmann::json> events_of(const std::vector<Acts>& forces,
                                      const std::vector<logged::Change>& changes) {
  constexpr double kPeriod = 0.0025, kStep = 0.001;
  simulation::GroundTruth truth;
  truth.xfrc_applied.assign(18, 0.0);
  const ViewChannels channels = tick_channels(header(), truth);
  const auto offset = [&](const char* name) {
    return std::ranges::find(channels.channels, name, &ViewChannel::name)->offset;
  };
  EventFinder finder(channels, {"world", "trunk", "LF_SHANK"});
  std::vector<nlohmann::json> parsed;
  for (int tick = 0; tick < 1600; ++tick) {
    const double time = kPeriod * tick;
    for (const logged::Change& one : changes)
      if (tick % 400 == 0 && std::floor(one.time) == std::round(time)) finder.acts(one);
    ViewFrame frame;
    frame.tick = static_cast<std::uint32_t>(tick);
    frame.time = time;
    frame.floats.assign(channels.floats, 0.0F);
    frame.floats[offset("truth.q_SB")] = 1.0F;
    for (const Acts& one : forces) {
      const double share = std::min(time, one.to) - std::max(time - kStep, one.from);
      frame.floats[offset("truth.xfrc_applied") + 6 * one.body + 1] +=
          static_cast<float>(std::max(share, 0.0) / kStep * one.force);
    }
    for (const std::string& event : finder.see(frame))
      parsed.push_back(nlohmann::json::parse(event));
  }
  return parsed;
}

std::vector<std::string> told(const std::vector<Acts>& forces,
                              const std::vector<logged::Change>& changes) {
  std::vector<std::string> texts;
  for (const nlohmann::json& event : events_of(forces, changes)) {
    EXPECT_EQ(event.at("kind"), "force");
    texts.push_back(std::to_string(event.at("time").get<double>()).substr(0, 4) + " " +
                    event.at("text").get<std::string>());
  }
  return texts;
}

const std::vector<std::string> kPush{"1.00 pushed by 50 N, 90° from ahead to the left, on the base",
                                     "2.00 the push on the base ends"};

TEST(EventFinder, ForcesFromOutsideAreToldWhenTheyBeginAndEnd) {
  EXPECT_EQ(told({{1.0, 2.0, 50.0}}, {}), kPush);
}

TEST(EventFinder, WhatTheOperatorDoesIsNotToldTwice) {
  EXPECT_TRUE(told({{1.0, 2.0, 50.0}}, {change("push", 1.0, 50.0, 1.0)}).empty());
  EXPECT_TRUE(told({{1.0, 1.5013, 50.0}}, {change("push", 1.0, 50.0, 0.5013)}).empty())
      << "it acts in a part of its last step";
}

TEST(EventFinder, WhateverTheOperatorDoesAForceOfTheScenarioIsToldAsItIs) {
  const Acts scenario{1.0, 2.0, 50.0};
  const auto expect = [&](std::vector<Acts> forces, const std::vector<logged::Change>& changes) {
    forces.push_back(scenario);
    EXPECT_EQ(told(forces, changes), kPush) << changes.front().time;
  };
  for (const std::string body : {"trunk", "LF_SHANK"}) {
    SCOPED_TRACE(body);
    const std::size_t row = body == "trunk" ? 1 : 2;
    for (const auto& [from, to] : {std::pair(0.5, 3.0), {0.5, 1.5}, {1.5, 3.0}, {1.2, 1.8}}) {
      expect({{from, to, -50.0, row}}, {change("push", from, -50.0, to - from, body)});
      expect({{from, to + 0.0013, 40.0, row}},
             {change("push", from, 40.0, to + 0.0013 - from, body)});
    }
  }
}

TEST(EventFinder, AStopIsToldWithWhatWasWrongThenAndInOlderLogsNow) {
  const ViewChannels channels = tick_channels(header(), simulation::GroundTruth());
  const logged::Hierarchy hierarchy;
  const std::optional<tasks::FrictionCone> cone;
  for (const bool is_older : {false, true}) {
    EventFinder finder(channels);
    ViewFrame frame;
    TickRecord tick;
    to_frame({0, tick, hierarchy, cone}, channels, frame);
    (void)finder.see(frame);
    tick.command.mode = CommandMode::damping;
    tick.command.cause = StopCause::encoders;
    tick.command.fault = is_older ? SampleFault::none : SampleFault::jump;
    tick.health.encoders = {.fault = SampleFault::not_a_number, .joint = 2};
    to_frame({1, tick, hierarchy, cone}, channels, frame);
    const std::vector<std::string>& events = finder.see(frame);
    ASSERT_EQ(events.size(), 1u);
    EXPECT_EQ(nlohmann::json::parse(events[0]).at("text"),
              is_older ? "command mode: damping, as encoder LF_KFE gave no numbers"
                       : "command mode: damping, as encoders of several joints changed too fast");
  }
}

}  // namespace
}  // namespace surefoot::server
