// Wrong robot files: each gives one message with the place and what would be valid.
#include "surefoot/base/error.hpp"
#include "surefoot/model/robot_model.hpp"
#include "surefoot/model/urdf.hpp"
#include "tests/support/changed_urdf.hpp"
#include "tests/support/messages.hpp"

#include <gtest/gtest.h>

namespace surefoot::model {
namespace {

using test::anymal_b;
using test::ChangedUrdf;
using test::holds;

template <typename Exception>
std::string message_of(const RobotDescription& robot) {
  try {
    const RobotModel model(robot);
  } catch (const Exception& error) {
    return error.what();
  }
  return "nothing was thrown";
}

TEST(BadRobot, names_an_unknown_frame_and_those_that_exist) {
  RobotDescription robot = anymal_b();
  robot.legs[0].foot_frame = "LF_FOT";
  const std::string message = message_of<UnknownNameError>(robot);
  EXPECT_TRUE(holds(message, "unknown frame \"LF_FOT\"; the robot has: base base_inertia LF_HIP"));
  EXPECT_TRUE(holds(message, " LF_FOOT"));
}

TEST(BadRobot, names_an_unknown_joint_and_those_that_exist) {
  RobotDescription robot = anymal_b();
  robot.legs[3].joints[2] = "RH_KNEE";
  EXPECT_TRUE(holds(message_of<UnknownNameError>(robot),
                    "unknown joint \"RH_KNEE\"; the robot has: LF_HAA LF_HFE LF_KFE"));
}

TEST(BadRobot, refuses_an_unknown_or_inner_base) {
  RobotDescription robot = anymal_b();
  robot.base_link = "trunk";
  EXPECT_TRUE(holds(message_of<UnknownNameError>(robot), "unknown frame \"trunk\""));
  robot.base_link = "LF_HIP";
  EXPECT_TRUE(holds(message_of<Error>(robot), "must be the root of the URDF, \"base\""));
}

TEST(BadRobot, refuses_parts_of_another_leg) {
  RobotDescription robot = anymal_b();
  robot.legs[0].foot_frame = "RF_FOOT";
  EXPECT_TRUE(holds(message_of<Error>(robot), "\"RF_FOOT\" is not on the expected part of leg LF"));
  robot = anymal_b();
  std::swap(robot.legs[0].joints[1], robot.legs[1].joints[1]);
  EXPECT_TRUE(
      holds(message_of<Error>(robot), "which is not what the joint before it in its leg moves"));
  robot = anymal_b();
  robot.legs[0].joints[1] = "LF_HAA";
  EXPECT_TRUE(holds(message_of<Error>(robot), "\"LF_HAA\" is named for two places"));
}

TEST(BadRobot, says_that_a_urdf_is_missing) {
  RobotDescription robot = anymal_b();
  robot.urdf_path = "/nowhere/robot.urdf";
  EXPECT_TRUE(holds(message_of<FileError>(robot), "/nowhere/robot.urdf: the URDF can't be read"));
}

struct BadUrdf {
  const char *text, *becomes, *told;
};

class BadRobotUrdf : public testing::TestWithParam<BadUrdf> {};

TEST_P(BadRobotUrdf, is_refused_and_says_why) {
  const ChangedUrdf urdf(GetParam().text, GetParam().becomes);
  const std::string message = message_of<FileError>(urdf.robot());
  EXPECT_TRUE(holds(message, GetParam().told));
}

constexpr const char* kMass = "<mass value=\"1.42462064\"/>";
constexpr const char* kInertia = "ixx=\"0.217391101503\"";
constexpr const char* kImuJoint = "<joint name=\"imu_joint\" type=\"fixed\">";
constexpr const char* kImuLink = "<link name=\"imu_link\">";
constexpr const char* kKnee = "<joint name=\"LF_KFE\" type=\"revolute\">";

INSTANTIATE_TEST_SUITE_P(
    Each, BadRobotUrdf,
    testing::Values(
        BadUrdf{"</link>", "</lnk>", ": not well-formed XML"},
        BadUrdf{"<robot", "<machine", ".urdf:"},
        BadUrdf{kMass, "<mass value=\"-1.42462064\"/>",
                ".urdf:149: link \"LF_HIP\": mass -1.42462064 kg is negative"},
        BadUrdf{kMass, "<mass value=\"0\"/>",
                ".urdf:147: link \"LF_HIP\": its mass is 0 and its inertia is not; a mass above 0"},
        BadUrdf{kMass, "<mass value=\"nan\"/>", "needs value=\"a finite number\", not \"nan\""},
        BadUrdf{kMass, "<mass value=\"${hip_mass}\"/>", "run xacro first"},
        BadUrdf{"xyz=\"0.277 0.116 0.0\"", "xyz=\"0.277 inf 0.0\"",
                "needs xyz=\"three finite numbers\""},
        BadUrdf{kInertia, "ixx=\"0,2\"", "needs ixx=\"a finite number\", not \"0,2\""},
        BadUrdf{kInertia, "ixx=\"-0.217391101503\"",
                "link \"base_inertia\": its inertia has a negative principal moment, -0.217 kg·m²"},
        BadUrdf{kInertia, "ixx=\"9.217391101503\"",
                "link \"base\" moves, but with all that is fixed to it has principal moments of "
                "inertia of "},
        BadUrdf{kInertia, "ixx=\"9.217391101503\"",
                "none is larger than the sum of the two others"},
        BadUrdf{kKnee, "<joint name=\"LF_KFE\" type=\"revolute\"><mimic joint=\"LF_HFE\"/>",
                "joint \"LF_KFE\" mimics \"LF_HFE\"; a leg's joints must each have"},
        BadUrdf{"<joint name=\"imu_joint\"", "<joint name=\"LF_HAA\"",
                "joint \"LF_HAA\" stands twice, first in line "},
        BadUrdf{"<axis xyz=\"1 0 0\"/>", "<axis xyz=\"0 0 0\"/>",
                "joint \"LF_HAA\": its axis has no direction"},
        BadUrdf{kImuLink, "<xacro:leg side=\"left\"/><link name=\"imu_link\">",
                "<xacro:leg> does not belong in a URDF; run xacro first: xacro FILE"},
        BadUrdf{kImuLink, "<link name=\"imu\">",
                "joint \"imu_joint\": unknown link \"imu_link\"; there are: base base_inertia"},
        BadUrdf{"</robot>", "<link name=\"tail\"/></robot>",
                "the links must form one tree; links without a parent: base tail"},
        BadUrdf{"</robot>",
                "<link name=\"a\"/><link name=\"b\"/>"
                "<joint name=\"ab\" type=\"fixed\"><parent link=\"a\"/><child link=\"b\"/></joint>"
                "<joint name=\"ba\" type=\"fixed\"><parent link=\"b\"/><child link=\"a\"/></joint>"
                "</robot>",
                "link \"a\" is not connected to"}));

TEST(BadRobot, takes_what_is_odd_but_does_no_harm) {
  // All mass on a line: rank one up to rounding, which leaves an eigenvalue slightly below 0.
  const std::string flat =
      "<inertial><mass value=\"1e-6\"/><inertia ixx=\"1e-6\" ixy=\"1e-6\" ixz=\"1e-6\" "
      "iyy=\"1e-6\" iyz=\"1e-6\" izz=\"1e-6\"/></inertial>";
  for (const ChangedUrdf& urdf :
       {ChangedUrdf(kImuJoint, std::string(kImuJoint) + "<axis xyz=\"0 0 0\"/>"),
        ChangedUrdf("</robot>", "<link name=\"odd\">" + flat +
                                    "</link><joint name=\"odd\" type=\"fixed\"><parent "
                                    "link=\"base\"/><child link=\"odd\"/></joint></robot>"),
        ChangedUrdf("<?xml", "\xEF\xBB\xBF<?xml")}) {
    EXPECT_EQ(message_of<Error>(urdf.robot()), "nothing was thrown");
  }
}

TEST(BadRobot, takes_only_a_light_inertia_that_no_body_can_have_for_a_placeholder) {
  const Mat3 flat = Vec3(1.0, 1.0, 0.0).asDiagonal();
  EXPECT_TRUE(is_placeholder({.mass = 1e-6, .about_com = 1e-6 * Mat3::Ones()}));
  EXPECT_TRUE(is_placeholder({.mass = 1e-3, .about_com = flat}));
  EXPECT_TRUE(is_placeholder({.mass = 0.0, .about_com = Mat3::Identity()}));
  EXPECT_FALSE(is_placeholder({.mass = 5.0, .about_com = flat}));
  EXPECT_FALSE(is_placeholder({.mass = 1e-3, .about_com = 1e-6 * Mat3::Identity()}));
  EXPECT_FALSE(is_placeholder(Inertia()));
}

TEST(BadRobot, refuses_a_movable_joint_that_the_description_does_not_name) {
  const ChangedUrdf urdf(kImuJoint, "<joint name=\"imu_joint\" type=\"revolute\">");
  EXPECT_TRUE(
      holds(message_of<Error>(urdf.robot()), "joint \"imu_joint\" can move but is not a joint"));
}

TEST(BadRobot, refuses_a_base_of_which_a_part_has_an_inertia_without_mass) {
  ChangedUrdf urdf;
  for (const char* mass : {"1e-6", "16.793507758", "0.05"})
    urdf.change(std::string("<mass value=\"") + mass, "<mass value=\"0");
  EXPECT_TRUE(holds(message_of<FileError>(urdf.robot()),
                    "link \"base_inertia\": its mass is 0 and its inertia is not"));
}

}  // namespace
}  // namespace surefoot::model
