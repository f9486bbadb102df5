// Robot files with an MJCF: each that is wrong gives one message with its place.
#include "surefoot/config/robot_file.hpp"
#include "surefoot/model/mesh_files.hpp"
#include "surefoot/model/physics_urdf.hpp"
#include "tests/logging/temporary_folder.hpp"
#include "tests/support/messages.hpp"

#include <gtest/gtest.h>

#include <string>

namespace surefoot::config {
namespace {

using test::holds;
using test::message_of;

/// Spot's robot file and MJCF in a folder of their own, without meshes.
class MjcfOfRobotFile : public testing::Test {
 protected:
  void change(std::string& text, const std::string& from, const std::string& to) {
    const std::size_t place = text.find(from);
    ASSERT_NE(place, std::string::npos) << from;
    text.replace(place, from.size(), to);
  }
  model::RobotDescription robot() {
    test::write_file(folder_ / "robot.yaml", text_);
    test::write_file(folder_ / "robot.xml", mjcf_);
    return load_robot(folder_ / "robot.yaml");
  }
  std::string complaint() {
    return message_of([&] { (void)robot(); });
  }

  test::TemporaryFolder folder_;
  std::string mjcf_ = test::contents(load_robot("spot").urdf_path);
  std::string text_ =
      "name: spot\nmjcf: robot.xml\nlegs: {LF: {foot: FL}, RF: {foot: FR}, LH: {foot: RL},"
      " RH: {foot: RR}}\nfoot: {radius: 0.036}\nlimits: {velocity: 14}\n";
};

TEST_F(MjcfOfRobotFile, may_name_feet_by_their_geoms) {
  const model::RobotDescription robot = this->robot();
  EXPECT_EQ(robot.urdf_path, folder_ / "robot.xml");
  EXPECT_EQ(robot.legs[index(Leg::LF)].shank_link, "FL_calf");
  EXPECT_EQ(robot.torque_limit[0], 144.4);
  EXPECT_EQ(robot.q_max[0], 0.785398);
}

TEST_F(MjcfOfRobotFile, stands_alone) {
  change(text_, "mjcf:", "urdf: robot.urdf\nmjcf:");
  EXPECT_TRUE(holds(complaint(), "robot.yaml:3: mjcf: urdf stands beside it"));
  change(text_, "urdf: robot.urdf\nmjcf: robot.xml\n", "");
  EXPECT_TRUE(holds(complaint(), "urdf: this key is missing, or mjcf"));
}

TEST_F(MjcfOfRobotFile, is_told_from_a_urdf) {
  change(text_, "mjcf:", "urdf:");
  EXPECT_TRUE(holds(complaint(), "robot.xml:1: not a URDF: the file has no <robot>; an MJCF"));
}

TEST_F(MjcfOfRobotFile, is_missing) {
  change(text_, "robot.xml", "gone.xml");
  EXPECT_TRUE(holds(complaint(), "robot.yaml:2: mjcf: there is no \"gone.xml\"; looked for at: "));
}

TEST_F(MjcfOfRobotFile, does_not_have_that_foot) {
  change(text_, "foot: FL}", "foot: FX}");
  EXPECT_TRUE(
      holds(complaint(), "legs.LF.foot: unknown frame \"FX\" in " + (folder_ / "robot.xml")));
}

TEST_F(MjcfOfRobotFile, has_another_joint_in_a_leg) {
  change(mjcf_, "<joint name=\"FL_calf_joint\"", "<joint type=\"slide\" name=\"FL_calf_joint\"");
  EXPECT_TRUE(holds(complaint(), "joint \"FL_calf_joint\" is prismatic"));
  change(mjcf_,
         "<joint type=\"slide\" name=\"FL_calf_joint\" axis=\"0 1 0\" range=\"-2.7929 -0.254402\"",
         "<joint type=\"ball\" name=\"FL_calf_joint\"");
  change(mjcf_, "joint=\"FL_calf_joint\"", "joint=\"FL_thigh_joint\"");
  EXPECT_TRUE(holds(complaint(), "joint \"FL_calf_joint\" is ball"));
}

TEST_F(MjcfOfRobotFile, has_no_velocity_limits) {
  change(text_, "limits: {velocity: 14}\n", "");
  EXPECT_TRUE(holds(complaint(),
                    "limits.velocity: this key is missing, and the MJCF does not limit "
                    "joint \"FL_hip_joint\""));
}

TEST_F(MjcfOfRobotFile, lacks_a_mesh_that_collides) {
  const model::RobotDescription robot = this->robot();
  const std::string message = message_of(
      [&] { (void)model::physics_urdf(model::read_urdf(robot), model::mesh_folders(robot)); });
  EXPECT_TRUE(
      holds(message, "robot.xml:76: link \"body\": there is no \"assets/body_collision.obj\""));
}

}  // namespace
}  // namespace surefoot::config
