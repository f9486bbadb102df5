#include "app/stop_text.hpp"

#include "app/event_finder.hpp"
#include "app/view_tick.hpp"
#include "surefoot/logging/message_codec.hpp"
#include "tests/support/source_file.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <fstream>
#include <string_view>

namespace surefoot {
namespace {

/// What the program, the page and films say of each cause and fault, and of one of LF_KFE.
nlohmann::json table() {
  return nlohmann::json::parse(std::ifstream(test::source_file("tests/support/stop_words.json")));
}

template <typename Value>
Value value_of(const auto& names, const nlohmann::json& name) {
  return static_cast<Value>(std::ranges::find(names, name.get<std::string>()) - names.begin());
}

TEST(StopText, IsThatOfTheTableForEveryCauseAndFault) {
  const nlohmann::json rows = table();
  EXPECT_EQ(rows.size(), logged::kCauseNames.size() * logged::kFaultNames.size());
  for (const auto& row : rows) {
    const auto cause = value_of<StopCause>(logged::kCauseNames, row[0]);
    const auto fault = value_of<SampleFault>(logged::kFaultNames, row[1]);
    EXPECT_EQ(text_of_stop(cause, fault, -1), row[2]) << row;
    EXPECT_EQ(text_of_stop(cause, fault, 2), row[3]) << row;
    for (const int joint : {kNumJoints, 99})  // no joint of the robot
      EXPECT_EQ(text_of_stop(cause, fault, joint), row[2]) << row;
  }
}

constexpr std::array<std::string_view, 3> kGroups{"encoders", "joint_torques", "imu"};

TEST(StopText, StandsBesideTheChangeOfTheCommandsMode) {
  const ViewChannels channels = tick_channels({"first"}, GroundTruth());
  const auto offset = [&](const std::string& name) {
    return std::ranges::find(channels.channels, name, &ViewChannel::name)->offset;
  };
  for (const auto& row : table()) {
    EventFinder finder(channels);
    ViewFrame frame;
    frame.floats.assign(channels.floats, 0.0F);
    (void)finder.see(frame);
    frame.floats[offset("command.mode")] = 4.0F;
    const std::string group = row[0];
    frame.floats[offset("command.cause")] =
        static_cast<float>(value_of<int>(logged::kCauseNames, row[0]));
    if (std::ranges::find(kGroups, group) != kGroups.end()) {
      frame.floats[offset("health." + group + ".fault")] =
          static_cast<float>(value_of<int>(logged::kFaultNames, row[1]));
      frame.floats[offset("health." + group + ".joint")] = 2.0F;
    }
    const std::vector<FoundEvent>& events = finder.see(frame);
    ASSERT_EQ(events.size(), 1u);
    const std::string why = row[3];
    EXPECT_EQ(nlohmann::json::parse(events[0].text).at("text"),
              "command mode: damping" + (why.empty() ? "" : ", as " + why));
  }
}

}  // namespace
}  // namespace surefoot
