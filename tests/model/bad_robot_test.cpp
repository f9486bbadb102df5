// Robot files that are wrong: each gives one message that says where and what would be valid.
#include "surefoot/base/error.hpp"
#include "surefoot/model/robot_model.hpp"
#include "surefoot/model/urdf.hpp"
#include "tests/support/anymal_b.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

namespace surefoot {
namespace {

using test::anymal_b;

/// The URDF of ANYmal B with one place of its text changed, as a file that is deleted afterwards.
class ChangedUrdf {
 public:
  ChangedUrdf(const std::string& from, const std::string& to) {
    std::ifstream original(anymal_b().urdf_path);
    std::string text{std::istreambuf_iterator<char>(original), std::istreambuf_iterator<char>()};
    const std::size_t place = text.find(from);
    EXPECT_NE(place, std::string::npos) << from;
    text.replace(place, from.size(), to);
    std::ofstream(path_) << text;
  }
  ChangedUrdf(const ChangedUrdf&) = delete;
  ChangedUrdf& operator=(const ChangedUrdf&) = delete;
  ~ChangedUrdf() { std::filesystem::remove(path_); }

  [[nodiscard]] RobotDescription robot() const {
    RobotDescription description = anymal_b();
    description.urdf_path = path_.string();
    return description;
  }

 private:
  std::filesystem::path path_ =
      std::filesystem::temp_directory_path() /
      ("surefoot_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) +
       ".urdf");
};

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
