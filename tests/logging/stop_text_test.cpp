#include "surefoot/logging/stop_text.hpp"

#include "surefoot/logging/message_codec.hpp"
#include "surefoot/signals/joint_name.hpp"
#include "tests/support/source_file.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>

namespace surefoot::logging {
namespace {

/// What the program and films say of each cause and fault, and of one of LF_KFE.
nlohmann::json table() {
  return nlohmann::json::parse(std::ifstream(test::source_file("tests/support/stop_words.json")));
}

const std::vector<std::string> kJoints =
    told_joints(std::vector<std::string>(kNumLegJoints), kNumLegs);

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
    EXPECT_EQ(text_of_stop(cause, fault, -1, kJoints), row[2]) << row;
    EXPECT_EQ(text_of_stop(cause, fault, 2, kJoints), row[3]) << row;
    for (const int joint : {kMaxJoints, 99})  // no joint of the robot
      EXPECT_EQ(text_of_stop(cause, fault, joint, kJoints), row[2]) << row;
  }
}

TEST(StopText, NamesTheJointsOfTheRobotsLegs) {
  const auto text = [](int joint, const std::vector<std::string>& joints) {
    return text_of_stop(StopCause::encoders, SampleFault::jump, joint, joints);
  };
  EXPECT_EQ(text(6, kJoints), "encoder LH_HAA changed too fast");
  EXPECT_EQ(text(6, told_joints(std::vector<std::string>(18), 6)),
            "encoder LM_HAA changed too fast");
}

TEST(StopText, IsOneOfTheTextsThatThePageKnowsByTheirNumbers) {
  const std::vector<std::string> all = stop_texts(kJoints);
  EXPECT_EQ(all.front(), "");
  for (const auto& row : table()) {
    for (const std::size_t text : {2, 3})
      EXPECT_EQ(std::ranges::count(all, row[text].get<std::string>()), 1) << row;
  }
}

TEST(StopText, NamesAJointOfAnArmAsTheUrdfDoes) {
  std::vector<std::string> joints = kJoints;
  joints.emplace_back("shoulder");
  joints.emplace_back("wrist");
  const std::string text = text_of_stop(StopCause::encoders, SampleFault::jump, 13, joints);
  EXPECT_EQ(text, "encoder wrist changed too fast");
  EXPECT_EQ(std::ranges::count(stop_texts(joints), text), 1);
}

}  // namespace
}  // namespace surefoot::logging
