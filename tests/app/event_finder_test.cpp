#include "app/event_finder.hpp"

#include "app/view_tick.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace surefoot {
namespace {

/// What is told of a force of 50 N on the base from 1 s to 2 s, and what the operator did.
std::vector<std::string> told(const std::vector<logged::Change>& changes) {
  GroundTruth truth;
  truth.xfrc_applied.assign(12, 0.0);
  const ViewChannels channels = tick_channels({"first"}, truth);
  const auto offset = [&](const char* name) {
    return std::ranges::find(channels.channels, name, &ViewChannel::name)->offset;
  };
  EventFinder finder(channels, {"world", "trunk"});
  for (const logged::Change& change : changes) finder.acts(change);
  std::vector<std::string> events, texts;
  for (int tick = 0; tick < 1200; ++tick) {
    ViewFrame frame;
    frame.tick = static_cast<std::uint32_t>(tick);
    frame.time = 0.0025 * tick;
    frame.floats.assign(channels.floats, 0.0F);
    frame.floats[offset("truth.q_WB")] = 1.0F;
    const bool acts = tick > 400 && tick <= 800;
    frame.floats[offset("truth.xfrc_applied") + 6] = acts ? 50.0F : 0.0F;
    finder.see(frame, events);
  }
  for (const std::string& event : events) {
    const auto json = nlohmann::json::parse(event);
    EXPECT_EQ(json.at("kind"), "force");
    texts.push_back(std::to_string(json.at("time").get<double>()).substr(0, 4) + " " +
                    json.at("text").get<std::string>());
  }
  return texts;
}

TEST(EventFinder, ForcesFromOutsideAreToldWhenTheyBeginAndEnd) {
  EXPECT_EQ(told({}), (std::vector<std::string>{"1.00 pushed by 50 N, 0° from ahead, on the base",
                                                "2.00 the push on the base ends"}));
}

TEST(EventFinder, WhatTheOperatorDoesIsNotToldTwice) {
  logged::Change push;
  push.kind = "push";
  push.time = 1.0;
  push.duration = 1.0;
  EXPECT_TRUE(told({push}).empty());
  push.time = 0.5;
  push.duration = 0.2;
  EXPECT_EQ(told({push}).size(), 2U);
}

}  // namespace
}  // namespace surefoot
