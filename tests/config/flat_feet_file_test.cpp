// Robot files with two legs that are wrong: each gives one message with file and line.
#include "surefoot/config/data_file.hpp"
#include "surefoot/config/robot_file.hpp"
#include "tests/logging/temporary_folder.hpp"
#include "tests/support/messages.hpp"

#include <string>
#include <vector>

namespace surefoot::config {
namespace {

using test::holds;

struct BadBiped {
  std::string text, becomes;
  std::vector<std::string> told;
};

class BadBipedFile : public testing::TestWithParam<BadBiped> {};

TEST_P(BadBipedFile, says_where_and_what_is_wrong) {
  const BadBiped& bad = GetParam();
  std::string text = test::contents(find_data_file("robots", "g1").string());
  const std::size_t place = text.find(bad.text);
  ASSERT_NE(place, std::string::npos) << bad.text;
  text.replace(place, bad.text.size(), bad.becomes);
  const test::TemporaryFolder folder;
  test::write_file(folder / "robot.yaml", text);
  const std::string message = test::message_of([&] { (void)load_robot(folder / "robot.yaml"); });
  EXPECT_TRUE(holds(message, "robot.yaml:"));
  for (const std::string& part : bad.told) EXPECT_TRUE(holds(message, part));
}

INSTANTIATE_TEST_SUITE_P(
    FlatFeet, BadBipedFile,
    testing::Values(
        BadBiped{"size: [0.17, 0.05]", "size: [0.17, -0.05]", {"foot.size", "-0.05", "above 0"}},
        BadBiped{"size: [0.17, 0.05]", "size: [0.0, 0.05]", {"foot.size"}},
        BadBiped{"size: [0.17, 0.05]", "radius: 0.03", {"foot", "radius", "size"}},
        BadBiped{"foot: left_ankle_roll_link",
                 "foot: pelvis",
                 {"legs.L.foot", "no joint moves between the base and \"pelvis\""}},
        BadBiped{"foot: right_ankle_roll_link",
                 "foot: left_ankle_roll_link",
                 {"legs.R.foot: \"left_ankle_roll_link\" is the foot of legs.L already"}},
        BadBiped{"tip: torso_link",
                 "tip: left_ankle_roll_link",
                 {"arms.waist.tip", "moves with joint \"left_ankle_roll_joint\" of leg L"}},
        BadBiped{"[-0.26, 0.0, 0.0, 0.60, -0.34, 0.0]",
                 "[-0.26, 0.0, 0.0, 0.60, -0.34]",
                 {"legs.L.posture", "has 5 numbers, but the leg has 6 joints"}},
        BadBiped{"[-0.26, 0.0, 0.0, 0.60, -0.34, 0.0]",
                 "[-0.26, 0.0, 0.0, 0.60, -0.24, 0.0]",
                 {"legs.L", "its sole leans by 0.1 rad"}},
        BadBiped{"[-0.26, 0.0, 0.0, 0.60, -0.34, 0.0]",
                 "[-0.36, 0.0, 0.0, 0.80, -0.44, 0.0]",
                 {"legs.R", "m lower than that of L; valid is up to 0.011"}},
        BadBiped{"[-0.26, 0.0, 0.0, 0.60, -0.34, 0.0]",
                 "[-0.26, 0.0, 0.0, 3.60, -0.34, 0.0]",
                 {"legs.L.posture", "left_knee_joint", "3.6"}},
        BadBiped{"posture: [-0.26, 0.0, 0.0, 0.60, -0.34, 0.0]}",
                 "joints: [left_hip_pitch_joint, left_knee_joint]}",
                 {"robot.yaml:"}},
        BadBiped{"  R: {", "  RF: {", {"legs", "valid are", "of two with flat feet L, R"}},
        BadBiped{"foot: left_ankle_roll_link, posture: [-0.26, 0.0, 0.0, 0.60, -0.34, 0.0]",
                 "foot: left_rubber_hand",
                 {"legs.L", "has 10 joints; valid are at most 8"}}));

}  // namespace
}  // namespace surefoot::config
