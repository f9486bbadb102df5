// Robot files that are wrong: each gives one message that names file, line and what would be valid.
#include "surefoot/config/robot_file.hpp"

#include "surefoot/config/data_file.hpp"
#include "tests/logging/temporary_folder.hpp"
#include "tests/support/messages.hpp"

#include <vector>

namespace surefoot::config {
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
  const model::RobotDescription robot = load_robot("anymal_b");
  EXPECT_EQ(robot.legs[index(Leg::RH)].foot_frame, "RH_FOOT");
  EXPECT_EQ(robot.legs[index(Leg::LF)].joints[2], "LF_KFE");
  EXPECT_EQ(robot.torque_limit, JointVector::Constant(kNumLegJoints, 40.0));
  EXPECT_EQ(robot.q_nominal.segment<3>(first_joint(Leg::LH)), Vec3(0.0, -0.4, 0.8));
}

TEST_F(RobotFile, with_a_urdf_beside_it_is_read) {
  use_own_urdf();
  test::write_file(folder_ / "robot.yaml", text_);
  test::write_file(folder_ / "robot.urdf", urdf_);
  EXPECT_EQ(load_robot(folder_ / "robot.yaml").urdf_path, folder_ / "robot.urdf");
}

/// What is changed in the robot's file or in its URDF, and what is said of it.
struct BadFile {
  bool is_urdf;
  const char *text, *becomes;
  std::vector<const char*> told;
};

class BadRobotFile : public RobotFile, public testing::WithParamInterface<BadFile> {};

TEST_P(BadRobotFile, says_where_and_what_is_wrong) {
  const BadFile& bad = GetParam();
  if (bad.is_urdf) use_own_urdf();
  change(bad.is_urdf ? urdf_ : text_, bad.text, bad.becomes);
  const std::string message = complaint();
  for (const char* part : bad.told) EXPECT_TRUE(holds(message, part));
}

constexpr bool kFile = false, kUrdf = true;
constexpr const char* kThigh = "<mass value=\"1.634976467\"";

INSTANTIATE_TEST_SUITE_P(
    Each, BadRobotFile,
    testing::Values(
        BadFile{kFile,
                "foot: LF_FOOT",
                "foot: LF_FOT",
                {"robot.yaml:6: legs.LF.foot: unknown frame \"LF_FOT\"",
                 "did you mean \"LF_FOOT\"?", "RH_SHANK"}},
        BadFile{kFile,
                "foot: LF_FOOT",
                "foot: LF_foot",
                {"legs.LF.foot: unknown frame \"LF_foot\"", "did you mean \"LF_FOOT\"?"}},
        BadFile{kFile,
                "base: base",
                "base: LF_HIP",
                {"robot.yaml:", "base: \"LF_HIP\" is not the root of the URDF", "\"base\""}},
        BadFile{kFile, "RH_KFE", "RH_KNEE", {"unknown joint \"RH_KNEE\""}},
        BadFile{kFile, "anymal.urdf", "anymal_x.urdf", {"robot.yaml:3: urdf", "anymal_x.urdf"}},
        BadFile{kUrdf, "</robot>", "", {"robot.urdf:"}},
        BadFile{
            kUrdf, kThigh, "<mass value=\"-1.634976467\"", {"robot.urdf:", "mass", "-1.634976467"}},
        BadFile{kUrdf,
                kThigh,
                "<mass value=\"0\"",
                {"robot.yaml:3: urdf: ", "robot.urdf:194: link \"LF_THIGH\": its mass is 0"}},
        BadFile{kFile, "limits:", "limit:", {"did you mean \"limits\"?"}},
        BadFile{kFile, "torque: 40.0", "torque: {HAA: 40, KFE: 40}", {"limits.torque"}},
        BadFile{kFile, "torque: 40.0", "torque: [40, 40]", {"limits.torque"}},
        BadFile{kFile, "torque: 40.0", "torque: [40, -1, 40]", {"limits.torque"}},
        BadFile{kFile, "position_max: [1.2", "position_max: [-1.3", {"limits.position_max"}},
        BadFile{kFile,
                "[RF_HAA, RF_HFE",
                "[LF_HAA, RF_HFE",
                {"robot.yaml:7: legs.RF.joints: joint \"LF_HAA\" stands at two places, also in "
                 "legs.LF.joints"}},
        BadFile{kUrdf,
                "<joint name=\"LF_HAA\" type=\"revolute\"",
                "<joint name=\"LF_HAA\" type=\"spherical\"",
                {"robot.yaml:6: legs.LF.joints: joint \"LF_HAA\" is spherical", "robot.urdf:154"}},
        BadFile{
            kUrdf,
            "<joint name=\"LF_HFE\" type=\"revolute\">",
            "<joint name=\"LF_HFE\" type=\"revolute\"><mimic joint=\"LF_HAA\"/>",
            {"robot.yaml:6: legs.LF.joints: joint \"LF_HFE\" mimics \"LF_HAA\"", "robot.urdf:"}},
        BadFile{kFile,
                "foot: LF_FOOT",
                "foot: RF_FOOT",
                {"robot.yaml:7: legs.RF.foot: \"RF_FOOT\" is the foot of legs.LF already"}},
        BadFile{
            kFile, "0.4, -0.8]", "0.0, -0.8]", {"posture.nominal: HFE and KFE must bend the knee"}},
        BadFile{
            kFile, "0.4, -0.8]", "0.4, 0.8]", {"posture.nominal: HFE and KFE must bend the knee"}},
        BadFile{
            kFile, "0.4, -0.8]", "0.4, 0.0]", {"posture.nominal: HFE and KFE must bend the knee"}},
        BadFile{kFile,
                "position_max: [1.2, 2.6",
                "position_max: [1.2, 0.3",
                {"posture.nominal: HFE at 0.4 rad lies outside limits.position_min and "
                 "position_max, -2.6 to 0.3 rad"}}));

TEST_F(RobotFile, with_a_missing_leg_names_it) {
  text_.erase(text_.find("  RH:"), text_.find("foot:\n") - text_.find("  RH:"));
  EXPECT_TRUE(holds(complaint(), "legs: has "));
}

TEST_F(RobotFile, may_have_drives_that_differ_along_a_leg) {
  change(text_, "torque: 40.0", "torque: [30, 35.5, 50]");
  change(text_, "velocity: ", "velocity: {KFE: 9, HAA: 12, HFE: 11}  # ");
  test::write_file(folder_ / "robot.yaml", text_);
  const model::RobotDescription robot = load_robot(folder_ / "robot.yaml");
  EXPECT_EQ(robot.torque_limit, Vec3(30.0, 35.5, 50.0).replicate(4, 1));
  EXPECT_EQ(robot.velocity_limit, Vec3(12.0, 11.0, 9.0).replicate(4, 1));
}

TEST_F(RobotFile, with_an_inertia_that_no_body_can_have_names_the_urdfs_line) {
  use_own_urdf();
  const std::size_t thigh = urdf_.find("<link name=\"LF_THIGH\"");
  urdf_.replace(urdf_.find("ixx=\"", thigh), 5, "ixx=\"-");
  EXPECT_TRUE(holds(complaint(), "robot.urdf:194: link \"LF_THIGH\": its inertia"));
}

TEST_F(RobotFile, with_legs_that_were_exchanged_says_so) {
  change(text_, "  LH:", "  XX:");
  change(text_, "  RH:", "  LH:");
  change(text_, "  XX:", "  RH:");
  const std::string message = complaint();
  EXPECT_TRUE(holds(message, "robot.yaml:9: legs.LH: in the nominal posture its foot is at x = -"));
  EXPECT_TRUE(holds(message, "y > 0; are two legs exchanged"));
}

TEST_F(RobotFile, whose_knees_bend_backward_alone_has_hind_legs_like_the_front_ones) {
  change(text_, "2.6, 2.9]", "2.6, -0.1]");
  test::write_file(folder_ / "robot.yaml", text_);
  const model::RobotDescription robot = load_robot(folder_ / "robot.yaml");
  for (const Leg leg : kLegs)
    EXPECT_EQ(robot.q_nominal.segment<3>(first_joint(leg)), Vec3(0.0, 0.4, -0.8));
}

TEST_F(RobotFile, may_lie_in_a_package_of_ones_own) {
  std::filesystem::create_directories(folder_ / "mine/robots");
  test::write_file(folder_ / "mine/robots/robot.urdf", urdf_);
  const std::size_t begin = text_.find("package://");
  text_.replace(begin, text_.find('\n', begin) - begin, "package://mine/robots/robot.urdf");
  test::write_file(folder_ / "robot.yaml", text_);
  setenv("ROS_PACKAGE_PATH", ("/nowhere:" + folder_.path() + "/").c_str(), 1);
  const model::RobotDescription robot = load_robot(folder_ / "robot.yaml");
  unsetenv("ROS_PACKAGE_PATH");
  EXPECT_EQ(robot.urdf_path, folder_ / "mine/robots/robot.urdf");
}

/// A file that says only what no URDF can tell.
class ShortRobotFile : public RobotFile {
 protected:
  ShortRobotFile() {
    text_ =
        "name: r\nurdf: robot.urdf\nlegs: {LF: {foot: LF_FOOT}, RF: {foot: RF_FOOT}, LH: {foot: "
        "LH_FOOT}, RH: {foot: RH_FOOT}}\nfoot: {radius: 0.031, center: [0, 0, 0.02325]}\n";
  }
  model::RobotDescription loaded() {
    test::write_file(folder_ / "robot.yaml", text_);
    test::write_file(folder_ / "robot.urdf", urdf_);
    return load_robot(folder_ / "robot.yaml");
  }
};

TEST_F(ShortRobotFile, takes_legs_limits_and_gains_from_the_urdf) {
  const model::RobotDescription robot = loaded(), full = load_robot("anymal_b");
  EXPECT_EQ(robot.base_link, "base");
  for (const Leg leg : kLegs) {
    EXPECT_EQ(robot.legs[index(leg)].joints, full.legs[index(leg)].joints);
    EXPECT_EQ(robot.legs[index(leg)].hip_frame, full.legs[index(leg)].hip_frame);
    EXPECT_EQ(robot.legs[index(leg)].shank_link, full.legs[index(leg)].shank_link);
  }
  EXPECT_EQ(robot.torque_limit, JointVector::Constant(kNumLegJoints, 80.0));
  EXPECT_EQ(robot.stall_torque, robot.torque_limit);
  EXPECT_EQ(robot.q_nominal, full.q_nominal);
  EXPECT_EQ(robot.hold_kp, JointVector::Constant(kNumLegJoints, 80.0));
}

TEST_F(ShortRobotFile, has_limits_of_each_joint_alone) {
  const std::size_t limit = urdf_.find("<limit", urdf_.find("<joint name=\"RH_KFE\""));
  urdf_.replace(limit, urdf_.find("/>", limit) - limit,
                R"(<limit effort="33" velocity="9" lower="0.2" upper="2.5")");
  const model::RobotDescription robot = loaded();
  EXPECT_EQ(robot.torque_limit[11], 33.0);
  EXPECT_EQ(robot.velocity_limit[11], 9.0);
  EXPECT_EQ(robot.q_min[11], 0.2);
  EXPECT_EQ(robot.q_max[11], 2.5);
  EXPECT_EQ(robot.torque_limit[8], 80.0);
}

TEST_F(ShortRobotFile, may_have_limits_and_a_posture_of_single_legs) {
  change(text_, "LF: {foot: LF_FOOT}",
         "LF: {foot: LF_FOOT, limits: {torque: {KFE: 30}, position_max: [1, 2, 3]}, "
         "posture: {nominal: [0.1, 0.5, -0.9]}}");
  const model::RobotDescription robot = loaded();
  EXPECT_EQ(robot.torque_limit[2], 30.0);
  EXPECT_EQ(robot.torque_limit[1], 80.0);
  EXPECT_EQ(robot.torque_limit[5], 80.0);
  EXPECT_EQ(robot.q_max.segment<3>(0), Vec3(1.0, 2.0, 3.0));
  EXPECT_EQ(robot.q_nominal.segment<3>(0), Vec3(0.1, 0.5, -0.9));
  EXPECT_EQ(robot.q_nominal.segment<3>(3), Vec3(0.0, 0.4, -0.8));
}

TEST_F(ShortRobotFile, may_have_gains_of_each_joint_and_of_single_legs) {
  text_ += "gains: {hold: {kp: [50, 60, 70], kd: 3}, damping: 5}\n";
  change(text_, "RF: {foot: RF_FOOT}", "RF: {foot: RF_FOOT, gains: {hold: {kp: {KFE: 90}}}}");
  const model::RobotDescription robot = loaded();
  EXPECT_EQ(robot.hold_kp.segment<3>(0), Vec3(50.0, 60.0, 70.0));
  EXPECT_EQ(robot.hold_kp.segment<3>(3), Vec3(50.0, 60.0, 90.0));
  EXPECT_EQ(robot.hold_kd, JointVector::Constant(kNumLegJoints, 3.0));
  EXPECT_EQ(robot.damping_kd, JointVector::Constant(kNumLegJoints, 5.0));
}

TEST_F(ShortRobotFile, may_have_a_foot_of_a_single_leg) {
  change(text_, "RH: {foot: RH_FOOT}",
         "RH: {foot: RH_FOOT, foot_radius: 0.04, foot_center: [0, 0.01, 0.03]}");
  const model::RobotDescription robot = loaded();
  EXPECT_EQ(robot.legs[0].foot_radius, 0.031);
  EXPECT_EQ(robot.legs[3].foot_radius, 0.04);
  EXPECT_EQ(robot.legs[3].foot_center, Vec3(0.0, 0.01, 0.03));
}

TEST_F(ShortRobotFile, tells_what_is_wrong_with_a_single_leg) {
  const std::string good = text_;
  for (const auto& [own, told] :
       {std::pair{"limit: {torque: 30}", "did you mean \"limits\"?"},
        std::pair{"limits: {torque: {KNEE: 30}}", "legs.LF.limits.torque"},
        std::pair{"limits: {position_max: [1, 2, 3], position_min: [1, 0, 0]}",
                  "legs.LF.limits.position_max: must be above position_min"},
        std::pair{"posture: {nominal: [0, 0.4, 0.8]}", "legs.LF.posture.nominal: HFE and KFE"},
        std::pair{"posture: {nominal: [0, 0.4, -9.9]}",
                  "legs.LF.posture.nominal: KFE at -9.9 rad lies outside"}}) {
    text_ = good;
    change(text_, "LF: {foot: LF_FOOT}", std::string("LF: {foot: LF_FOOT, ") + own + "}");
    EXPECT_TRUE(holds(complaint(), told));
  }
}

TEST_F(ShortRobotFile, says_which_joint_has_no_limit) {
  const std::size_t limit = urdf_.find("<limit", urdf_.find("<joint name=\"RH_KFE\""));
  urdf_.replace(limit, urdf_.find("/>", limit) - limit, R"(<limit effort="0")");
  EXPECT_TRUE(holds(complaint(),
                    "limits.torque: this key is missing, and the URDF does not limit joint "
                    "\"RH_KFE\""));
}

TEST_F(ShortRobotFile, says_how_many_joints_it_found) {
  change(text_, "LF: {foot: LF_FOOT}", "LF: {foot: LF_THIGH}");
  EXPECT_TRUE(holds(complaint(),
                    "legs.LF: between the base and \"LF_THIGH\" there are 2 joints that move: "
                    "LF_HAA LF_HFE; a leg that walks has three"));
}

/// ANYmal B with an arm; what is changed, and what is said of it.
class ArmRobotFile : public RobotFile, public testing::WithParamInterface<BadFile> {
 protected:
  ArmRobotFile() { text_ = test::contents(find_data_file("robots", "anymal_b_kinova").string()); }
};

TEST_P(ArmRobotFile, says_where_and_what_is_wrong) {
  const BadFile& bad = GetParam();
  change(text_, bad.text, bad.becomes);
  const std::string message = complaint();
  for (const char* part : bad.told) EXPECT_TRUE(holds(message, part));
}

INSTANTIATE_TEST_SUITE_P(
    Each, ArmRobotFile,
    testing::Values(
        BadFile{kFile,
                "[0.0, 3.6, 1.2, 0.0, 1.6, 0.0]",
                "[0.0, 3.6]",
                {"robot.yaml:12: arms.kinova.posture: has 2 numbers, but the arm has 6 joints"}},
        BadFile{kFile,
                "[0.0, 3.6,",
                "[0.0, 9.6,",
                {"robot.yaml:12: arms.kinova.posture: the posture of joint \"j2s6s200_joint_2\""}},
        BadFile{
            kFile, "tip: j2s6s200_end", "tip: j2_end", {"robot.yaml:11: arms.kinova.tip: unkn"}},
        BadFile{kFile,
                "tip: j2s6s200_end_effector",
                "tip: LF_SHANK",
                {"robot.yaml:11: arms.kinova.tip: \"LF_SHANK\" moves with joint \"LF_KFE\" of leg "
                 "LF, and no joint lies between them; an arm has joints of its own"}},
        BadFile{kFile,
                "foot:\n",
                "  - {name: other, tip: j2s6s200_end_effector}\nfoot:\n",
                {"robot.yaml:13: arms.other.tip: \"j2s6s200_end_effector\" moves with joint "
                 "\"j2s6s200_joint_6\" of arm \"kinova\", and no joint lies between them"}},
        BadFile{kFile,
                "foot:\n",
                "  - {name: kinova, tip: j2s6s200_link_3}\nfoot:\n",
                {"arms: two arms have the name \"kinova\""}},
        BadFile{kFile,
                "posture: [0.0, 3.6",
                "position_min: [9, 9, 9, 9, 9, 9]\n    posture: [0.0, 3.6",
                {"robot.yaml:10: arms.kinova.position_max: must be above", "j2s6s200_joint_1"}}));

TEST_F(RobotFile, that_does_not_exist_lists_those_that_do) {
  EXPECT_TRUE(holds(message_of([] { (void)load_robot("anymal_x"); }),
                    "unknown robot \"anymal_x\"; did you mean \"anymal_b\"?"));
}

}  // namespace
}  // namespace surefoot::config
