// Robot files that are wrong: each gives one message that names file, line and what would be valid.
#include "surefoot/config/robot_file.hpp"

#include "surefoot/config/data_file.hpp"
#include "tests/config/messages.hpp"
#include "tests/logging/temporary_folder.hpp"

namespace surefoot {
namespace {

using test::holds;
using test::message_of;

/// ANYmal B's files in a folder of their own, to be changed.
class RobotFile : public testing::Test {
 protected:
  RobotFile()
      : text_(test::contents(find_data_file("robots", "anymal_b").string())),
        urdf_(test::contents(load_robot("anymal_b").urdf_path)) {}

  static void change(std::string& text, const std::string& from, const std::string& to) {
    const std::size_t place = text.find(from);
    ASSERT_NE(place, std::string::npos) << from;
    text.replace(place, from.size(), to);
  }

  /// Makes the robot use a URDF of its own, which can be changed.
  void use_own_urdf() {
    const std::size_t begin = text_.find("package://");
    text_.replace(begin, text_.find('\n', begin) - begin, "robot.urdf");
  }

  std::string complaint() {
    test::write_file(folder_ / "robot.yaml", text_);
    test::write_file(folder_ / "robot.urdf", urdf_);
    return message_of([&] { (void)load_robot(folder_ / "robot.yaml"); });
  }

  test::TemporaryFolder folder_;
  std::string text_, urdf_;
};

TEST_F(RobotFile, of_anymal_b_is_read) {
  const RobotDescription robot = load_robot("anymal_b");
  EXPECT_EQ(robot.legs[index(Leg::RH)].foot_frame, "RH_FOOT");
  EXPECT_EQ(robot.legs[index(Leg::LF)].joints[2], "LF_KFE");
  EXPECT_EQ(robot.torque_limit, JointVector::Constant(40.0));
  EXPECT_EQ(robot.q_nominal.segment<3>(first_joint(Leg::LH)), Vec3(0.0, -0.4, 0.8));
}

TEST_F(RobotFile, with_a_urdf_beside_it_is_read) {
  use_own_urdf();
  test::write_file(folder_ / "robot.yaml", text_);
  test::write_file(folder_ / "robot.urdf", urdf_);
  EXPECT_EQ(load_robot(folder_ / "robot.yaml").urdf_path, folder_ / "robot.urdf");
}

TEST_F(RobotFile, with_an_unknown_frame_names_the_line_and_the_nearest) {
  change(text_, "foot: LF_FOOT", "foot: LF_FOT");
  const std::string message = complaint();
  EXPECT_TRUE(holds(message, "robot.yaml:6: legs.LF.foot: unknown frame \"LF_FOT\""));
  EXPECT_TRUE(holds(message, "did you mean \"LF_FOOT\"?"));
  EXPECT_TRUE(holds(message, "RH_SHANK"));
}

TEST_F(RobotFile, with_an_unknown_joint_names_it) {
  change(text_, "RH_KFE", "RH_KNEE");
  EXPECT_TRUE(holds(complaint(), "unknown joint \"RH_KNEE\""));
}

TEST_F(RobotFile, with_a_missing_leg_names_it) {
  text_.erase(text_.find("  RH:"), text_.find("foot:\n") - text_.find("  RH:"));
  EXPECT_TRUE(holds(complaint(), "legs.RH"));
}

TEST_F(RobotFile, with_a_missing_urdf_names_both_files) {
  change(text_, "anymal.urdf", "anymal_x.urdf");
  const std::string message = complaint();
  EXPECT_TRUE(holds(message, "robot.yaml:3: urdf"));
  EXPECT_TRUE(holds(message, "anymal_x.urdf"));
}

TEST_F(RobotFile, with_a_broken_urdf_names_its_line) {
  use_own_urdf();
  urdf_.resize(urdf_.size() / 2);
  EXPECT_TRUE(holds(complaint(), "robot.urdf:"));
}

TEST_F(RobotFile, with_a_negative_mass_names_link_and_line) {
  use_own_urdf();
  change(urdf_, "<mass value=\"1.634976467\"", "<mass value=\"-1.634976467\"");
  const std::string message = complaint();
  EXPECT_TRUE(holds(message, "robot.urdf:"));
  EXPECT_TRUE(holds(message, "mass"));
  EXPECT_TRUE(holds(message, "-1.634976467"));
}

TEST_F(RobotFile, with_a_misspelt_key_says_so) {
  change(text_, "limits:", "limit:");
  EXPECT_TRUE(holds(complaint(), "did you mean \"limits\"?"));
}

TEST_F(RobotFile, may_have_drives_that_differ_along_a_leg) {
  change(text_, "torque: 40.0", "torque: [30, 35.5, 50]");
  change(text_, "velocity: ", "velocity: {KFE: 9, HAA: 12, HFE: 11}  # ");
  test::write_file(folder_ / "robot.yaml", text_);
  const RobotDescription robot = load_robot(folder_ / "robot.yaml");
  EXPECT_EQ(robot.torque_limit, Vec3(30.0, 35.5, 50.0).replicate(4, 1));
  EXPECT_EQ(robot.velocity_limit, Vec3(12.0, 11.0, 9.0).replicate(4, 1));
}

TEST_F(RobotFile, whose_drives_are_told_in_part_says_so) {
  for (const char* limits :
       {"torque: {HAA: 40, KFE: 40}", "torque: [40, 40]", "torque: [40, -1, 40]"}) {
    const std::string before = text_;
    change(text_, "torque: 40.0", limits);
    EXPECT_TRUE(holds(complaint(), "limits.torque")) << limits;
    text_ = before;
  }
}

TEST_F(RobotFile, with_limits_upside_down_says_so) {
  change(text_, "position_max: [1.2", "position_max: [-1.3");
  EXPECT_TRUE(holds(complaint(), "limits.position_max"));
}

TEST_F(RobotFile, whose_moving_link_has_no_mass_names_the_urdfs_line) {
  use_own_urdf();
  change(urdf_, "<mass value=\"1.634976467\"", "<mass value=\"0\"");
  const std::string message = complaint();
  EXPECT_TRUE(holds(message, "robot.yaml:3: urdf: "));
  EXPECT_TRUE(holds(message, "robot.urdf:194: link \"LF_THIGH\" moves"));
  EXPECT_TRUE(holds(message, "no mass"));
}

TEST_F(RobotFile, with_an_inertia_that_no_body_can_have_names_the_urdfs_line) {
  use_own_urdf();
  const std::size_t thigh = urdf_.find("<link name=\"LF_THIGH\"");
  urdf_.replace(urdf_.find("ixx=\"", thigh), 5, "ixx=\"-");
  EXPECT_TRUE(holds(complaint(), "robot.urdf:194: link \"LF_THIGH\": its inertia"));
}

TEST_F(RobotFile, that_names_a_joint_for_two_places_gives_the_second_ones_line) {
  change(text_, "[RF_HAA, RF_HFE", "[LF_HAA, RF_HFE");
  EXPECT_TRUE(holds(complaint(),
                    "robot.yaml:7: legs.RF.joints: joint \"LF_HAA\" stands at two places, also in "
                    "legs.LF.joints"));
}

TEST_F(RobotFile, whose_joint_is_no_hinge_gives_both_lines) {
  use_own_urdf();
  change(urdf_, "<joint name=\"LF_HAA\" type=\"revolute\"",
         "<joint name=\"LF_HAA\" type=\"spherical\"");
  const std::string message = complaint();
  EXPECT_TRUE(holds(message, "robot.yaml:6: legs.LF.joints: joint \"LF_HAA\" is spherical"));
  EXPECT_TRUE(holds(message, "robot.urdf:154"));
}

TEST_F(RobotFile, with_legs_that_were_exchanged_says_so) {
  change(text_, "  LH:", "  XX:");
  change(text_, "  RH:", "  LH:");
  change(text_, "  XX:", "  RH:");
  const std::string message = complaint();
  EXPECT_TRUE(holds(message, "robot.yaml:9: legs.LH: in the nominal posture its foot is at x = -"));
  EXPECT_TRUE(holds(message, "y > 0; are two legs exchanged"));
}

TEST_F(RobotFile, with_a_foot_on_another_leg_names_the_robot_file) {
  change(text_, "foot: LF_FOOT", "foot: RF_FOOT");
  EXPECT_TRUE(holds(complaint(), "robot.yaml:5: legs: frame \"RF_FOOT\" is not on"));
}

TEST_F(RobotFile, whose_nominal_posture_bends_no_knee_says_so) {
  for (const char* straight : {"0.0, -0.8]", "0.4, 0.8]", "0.4, 0.0]"}) {
    const std::string before = text_;
    change(text_, "0.4, -0.8]", straight);
    EXPECT_TRUE(holds(complaint(), "posture.nominal: HFE and KFE must bend the knee")) << straight;
    text_ = before;
  }
}

TEST_F(RobotFile, whose_nominal_posture_is_outside_the_limits_names_the_joint) {
  change(text_, "position_max: [1.2, 2.6", "position_max: [1.2, 0.3");
  EXPECT_TRUE(holds(complaint(),
                    "posture.nominal: HFE at 0.4 rad lies outside "
                    "limits.position_min and position_max, -2.6 to 0.3 rad"));
}

TEST_F(RobotFile, whose_knees_bend_backward_alone_has_hind_legs_like_the_front_ones) {
  change(text_, "2.6, 2.9]", "2.6, -0.1]");
  test::write_file(folder_ / "robot.yaml", text_);
  const RobotDescription robot = load_robot(folder_ / "robot.yaml");
  for (const Leg leg : kLegs)
    EXPECT_EQ(robot.q_nominal.segment<3>(first_joint(leg)), Vec3(0.0, 0.4, -0.8));
}

TEST_F(RobotFile, whose_joint_mimics_another_gives_both_lines) {
  use_own_urdf();
  change(urdf_, "<joint name=\"LF_HFE\" type=\"revolute\">",
         "<joint name=\"LF_HFE\" type=\"revolute\"><mimic joint=\"LF_HAA\"/>");
  const std::string message = complaint();
  EXPECT_TRUE(holds(message, "robot.yaml:6: legs.LF.joints: joint \"LF_HFE\" mimics \"LF_HAA\""));
  EXPECT_TRUE(holds(message, "robot.urdf:"));
}

TEST_F(RobotFile, may_lie_in_a_package_of_ones_own) {
  std::filesystem::create_directories(folder_ / "mine/robots");
  test::write_file(folder_ / "mine/robots/robot.urdf", urdf_);
  const std::size_t begin = text_.find("package://");
  text_.replace(begin, text_.find('\n', begin) - begin, "package://mine/robots/robot.urdf");
  test::write_file(folder_ / "robot.yaml", text_);
  setenv("ROS_PACKAGE_PATH", ("/nowhere:" + folder_.path() + "/").c_str(), 1);
  const RobotDescription robot = load_robot(folder_ / "robot.yaml");
  unsetenv("ROS_PACKAGE_PATH");
  EXPECT_EQ(robot.urdf_path, folder_ / "mine/robots/robot.urdf");
}

TEST_F(RobotFile, that_does_not_exist_lists_those_that_do) {
  EXPECT_TRUE(holds(message_of([] { (void)load_robot("anymal_x"); }),
                    "unknown robot \"anymal_x\"; did you mean \"anymal_b\"?"));
}

}  // namespace
}  // namespace surefoot
