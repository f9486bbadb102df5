// Wrong robot files: each gives one message with the place and what would be valid.
#include "surefoot/base/error.hpp"
#include "surefoot/model/robot_model.hpp"
#include "surefoot/model/urdf.hpp"
#include "tests/support/changed_urdf.hpp"

#include <gtest/gtest.h>

namespace surefoot {
namespace {

using test::anymal_b;
using test::ChangedUrdf;

template <typename Exception>
std::string message_of(const RobotDescription& robot) {
  try {
    const RobotModel model(robot);
  } catch (const Exception& error) {
    return error.what();
  }
  return "nothing was thrown";
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(BadRobot, names_an_unknown_frame_and_those_that_exist) {
  RobotDescription robot = anymal_b();
  robot.legs[0].foot_frame = "LF_FOT";
  const std::string message = message_of<UnknownNameError>(robot);
  EXPECT_TRUE(
      contains(message, "unknown frame \"LF_FOT\"; the robot has: base base_inertia LF_HIP"))
      << message;
  EXPECT_TRUE(contains(message, " LF_FOOT")) << message;
}

TEST(BadRobot, names_an_unknown_joint_and_those_that_exist) {
  RobotDescription robot = anymal_b();
  robot.legs[3].joints[2] = "RH_KNEE";
  EXPECT_TRUE(contains(message_of<UnknownNameError>(robot),
                       "unknown joint \"RH_KNEE\"; the robot has: LF_HAA LF_HFE LF_KFE"));
}

TEST(BadRobot, refuses_an_unknown_or_inner_base) {
  RobotDescription robot = anymal_b();
  robot.base_link = "trunk";
  EXPECT_TRUE(contains(message_of<UnknownNameError>(robot), "unknown frame \"trunk\""));
  robot.base_link = "LF_HIP";
  EXPECT_TRUE(contains(message_of<Error>(robot), "must be the root of the URDF, \"base\""));
}

TEST(BadRobot, refuses_parts_of_another_leg) {
  RobotDescription robot = anymal_b();
  robot.legs[0].foot_frame = "RF_FOOT";
  EXPECT_TRUE(
      contains(message_of<Error>(robot), "\"RF_FOOT\" is not on the expected part of leg LF"));
  robot = anymal_b();
  std::swap(robot.legs[0].joints[1], robot.legs[1].joints[1]);
  EXPECT_TRUE(contains(message_of<Error>(robot), "is not connected to the one before it"));
  robot = anymal_b();
  robot.legs[0].joints[1] = "LF_HAA";
  EXPECT_TRUE(contains(message_of<Error>(robot), "\"LF_HAA\" is named for two places"));
}

TEST(BadRobot, says_that_a_urdf_is_missing) {
  RobotDescription robot = anymal_b();
  robot.urdf_path = "/nowhere/robot.urdf";
  EXPECT_TRUE(
      contains(message_of<FileError>(robot), "/nowhere/robot.urdf: the URDF can't be read"));
}

TEST(BadRobot, names_file_and_line_of_broken_xml) {
  const ChangedUrdf urdf("</link>", "</lnk>");
  const std::string message = message_of<FileError>(urdf.robot());
  EXPECT_TRUE(contains(message, ".urdf:40: not well-formed XML") ||
              contains(message, ": not well-formed XML"))
      << message;
}

TEST(BadRobot, says_that_a_file_is_no_urdf) {
  const ChangedUrdf start("<robot", "<machine");
  EXPECT_NE(message_of<FileError>(start.robot()), "nothing was thrown");
}

TEST(BadRobot, refuses_a_negative_mass) {
  const ChangedUrdf urdf("<mass value=\"1.42462064\"/>", "<mass value=\"-1.42462064\"/>");
  const std::string message = message_of<FileError>(urdf.robot());
  EXPECT_TRUE(contains(message, ".urdf:149: link \"LF_HIP\": mass -1.42462064 kg is negative"))
      << message;
}

TEST(BadRobot, refuses_numbers_that_are_not_finite) {
  const ChangedUrdf mass("<mass value=\"1.42462064\"/>", "<mass value=\"nan\"/>");
  EXPECT_TRUE(contains(message_of<FileError>(mass.robot()),
                       "needs value=\"a finite number\", not \"nan\""));
  const ChangedUrdf origin("xyz=\"0.277 0.116 0.0\"", "xyz=\"0.277 inf 0.0\"");
  EXPECT_TRUE(
      contains(message_of<FileError>(origin.robot()), "needs xyz=\"three finite numbers\""));
  const ChangedUrdf inertia("ixx=\"0.217391101503\"", "ixx=\"0,2\"");
  EXPECT_TRUE(contains(message_of<FileError>(inertia.robot()),
                       "needs ixx=\"a finite number\", not \"0,2\""));
}

TEST(BadRobot, refuses_an_inertia_that_no_body_can_have) {
  const ChangedUrdf urdf("ixx=\"0.217391101503\"", "ixx=\"-0.217391101503\"");
  EXPECT_TRUE(contains(message_of<FileError>(urdf.robot()),
                       "link \"base_inertia\": its inertia has a negative eigenvalue"));
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
  const ChangedUrdf urdf("<joint name=\"imu_joint\" type=\"fixed\">",
                         "<joint name=\"imu_joint\" type=\"revolute\">");
  EXPECT_TRUE(
      contains(message_of<Error>(urdf.robot()), "joint \"imu_joint\" can move but is not a joint"));
}

TEST(BadRobot, refuses_a_leg_joint_that_follows_another) {
  const ChangedUrdf urdf("<joint name=\"LF_KFE\" type=\"revolute\">",
                         "<joint name=\"LF_KFE\" type=\"revolute\"><mimic joint=\"LF_HFE\"/>");
  EXPECT_TRUE(contains(message_of<FileError>(urdf.robot()),
                       "joint \"LF_KFE\" mimics \"LF_HFE\"; a leg's joints must each have"));
}

TEST(BadRobot, refuses_a_name_that_two_joints_have_and_gives_both_lines) {
  const ChangedUrdf urdf("<joint name=\"imu_joint\"", "<joint name=\"LF_HAA\"");
  const std::string message = message_of<FileError>(urdf.robot());
  EXPECT_TRUE(contains(message, "joint \"LF_HAA\" stands twice, first in line ")) << message;
}

TEST(BadRobot, refuses_only_an_axis_that_something_turns_about) {
  const ChangedUrdf fixed("<joint name=\"imu_joint\" type=\"fixed\">",
                          "<joint name=\"imu_joint\" type=\"fixed\"><axis xyz=\"0 0 0\"/>");
  EXPECT_EQ(message_of<Error>(fixed.robot()), "nothing was thrown");
  const ChangedUrdf moving("<axis xyz=\"1 0 0\"/>", "<axis xyz=\"0 0 0\"/>");
  EXPECT_TRUE(contains(message_of<FileError>(moving.robot()),
                       "joint \"LF_HAA\": its axis has no direction"));
}

/// Inertia of a body with all mass on a line: rank one up to rounding, which leaves an eigenvalue
/// slightly below 0.
TEST(BadRobot, takes_an_inertia_that_is_below_zero_by_rounding_alone) {
  const std::string placeholder =
      "<inertia ixx=\"1e-6\" ixy=\"1e-6\" ixz=\"1e-6\" "
      "iyy=\"1e-6\" iyz=\"1e-6\" izz=\"1e-6\"/>";
  const ChangedUrdf urdf(
      "<link name=\"imu_link\">",
      "<link name=\"imu_link\"><inertial><mass value=\"1e-6\"/>" + placeholder + "</inertial>");
  EXPECT_EQ(message_of<Error>(urdf.robot()), "nothing was thrown");
}

TEST(BadRobot, refuses_a_body_whose_moments_of_inertia_contradict_each_other) {
  const ChangedUrdf urdf("ixx=\"0.217391101503\"", "ixx=\"9.217391101503\"");
  const std::string message = message_of<FileError>(urdf.robot());
  EXPECT_TRUE(contains(message,
                       "link \"base\" moves, but with all that is fixed to it has "
                       "principal moments of inertia of "))
      << message;
  EXPECT_TRUE(contains(message, "none is larger than the sum of the two others")) << message;
}

TEST(BadRobot, refuses_a_base_without_mass) {
  ChangedUrdf urdf;
  for (const char* mass : {"1e-6", "16.793507758", "0.05"})
    urdf.change(std::string("<mass value=\"") + mass, "<mass value=\"0");
  EXPECT_TRUE(contains(message_of<FileError>(urdf.robot()),
                       "link \"base\" moves, but with all that is fixed to it has no mass"));
}

TEST(BadRobot, says_that_xacro_must_be_run) {
  const ChangedUrdf element("<link name=\"imu_link\">",
                            "<xacro:leg side=\"left\"/><link name=\"imu_link\">");
  EXPECT_TRUE(contains(message_of<FileError>(element.robot()),
                       "<xacro:leg> does not belong in a URDF; run xacro first: xacro FILE"));
  const ChangedUrdf value("<mass value=\"1.42462064\"/>", "<mass value=\"${hip_mass}\"/>");
  EXPECT_TRUE(contains(message_of<FileError>(value.robot()), "run xacro first"));
}

TEST(BadRobot, reads_a_file_that_begins_with_a_byte_order_mark) {
  const ChangedUrdf urdf("<?xml", "\xEF\xBB\xBF<?xml");
  EXPECT_EQ(message_of<Error>(urdf.robot()), "nothing was thrown");
}

TEST(BadRobot, refuses_joints_that_lead_round_in_a_circle) {
  const ChangedUrdf urdf(
      "</robot>",
      "<link name=\"a\"/><link name=\"b\"/>"
      "<joint name=\"ab\" type=\"fixed\"><parent link=\"a\"/><child link=\"b\"/></joint>"
      "<joint name=\"ba\" type=\"fixed\"><parent link=\"b\"/><child link=\"a\"/></joint></robot>");
  EXPECT_TRUE(contains(message_of<FileError>(urdf.robot()), "link \"a\" is not connected to"));
}

TEST(BadRobot, refuses_links_that_do_not_form_a_tree) {
  const ChangedUrdf lost("<link name=\"imu_link\">", "<link name=\"imu\">");
  EXPECT_TRUE(contains(message_of<FileError>(lost.robot()),
                       "joint \"imu_joint\": link \"imu_link\" does not exist"));
  const ChangedUrdf loose("</robot>", "<link name=\"tail\"/></robot>");
  EXPECT_TRUE(contains(message_of<FileError>(loose.robot()),
                       "the links must form one tree; links without a parent: base tail"));
}

}  // namespace
}  // namespace surefoot
