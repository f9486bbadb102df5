// The parts of a URDF that physics gets: all that it needs, and nothing else.
#include "surefoot/model/physics_urdf.hpp"

#include "tests/logging/temporary_folder.hpp"
#include "tests/support/messages.hpp"

#include <gtest/gtest.h>

#include <fstream>

namespace surefoot::model {
namespace {

namespace fs = std::filesystem;
using test::holds;

constexpr const char* kBall =
    "<inertial><mass value=\"2\"/>"
    "<inertia ixx=\"1\" ixy=\"0\" ixz=\"0\" iyy=\"1\" iyz=\"0\" izz=\"1\"/></inertial>";

/// A base, a leg that turns and a sensor that is fixed to the leg.
class PhysicsUrdfTest : public testing::Test {
 protected:
  std::string joint_ = "<axis xyz=\"0 1 0\"/><limit lower=\"-1\" upper=\"2\" effort=\"nan\"/>";
  std::string of_sensor_ = kBall;
  std::string of_leg_ = kBall;
  std::string rest_;

  PhysicsUrdf read() {
    fs::create_directories(fs::path(folder_ / "robot/urdf"));
    const std::string path = folder_ / "robot/urdf/robot.urdf";
    std::ofstream(path)
        << "<!-- <robot> --><robot name=\"r\"><link name=\"base\">" << kBall
        << "</link><link name=\"leg\">" << of_leg_ << "</link><link name=\"eye\">" << of_sensor_
        << "</link><joint name=\"knee\" type=\"revolute\"><parent link=\"base\"/>"
           "<child link=\"leg\"/>"
        << joint_
        << "</joint><joint name=\"mount\" type=\"fixed\"><parent link=\"leg\"/>"
           "<child link=\"eye\"/><origin xyz=\"0.5 0 0\"/><axis xyz=\"0 0 0\"/></joint>"
        << rest_ << "</robot>";
    return physics_urdf(read_urdf(path), {.packages = {folder_ / "packages"},
                                          .urdf = fs::path(folder_ / "robot/urdf")});
  }

  std::string complaint() {
    try {
      (void)read();
    } catch (const FileError& error) {
      return error.what();
    }
    return "nothing was thrown";
  }

  test::TemporaryFolder folder_;
};

TEST_F(PhysicsUrdfTest, has_nothing_that_physics_does_not_use) {
  of_leg_ += "<visual><material/><material/><geometry><mesh/></geometry></visual><collision/>";
  rest_ =
      "<transmission/><gazebo><kp>${kp}</kp></gazebo><material name=\"a\"/><material name=\"a\"/>";
  const PhysicsUrdf physics = read();
  for (const char* part :
       {"visual", "material", "transmission", "gazebo", "effort", "nan", "0 0 0"})
    EXPECT_FALSE(holds(physics.xml, part));
  EXPECT_TRUE(holds(physics.xml, "<limit lower=\"-1\" upper=\"2\"/>"));
  EXPECT_TRUE(holds(physics.xml, "<axis xyz=\"0 1 0\"/>"));
  EXPECT_TRUE(physics.notes.empty());
}

TEST_F(PhysicsUrdfTest, leaves_out_friction_of_joints_with_a_note) {
  joint_ += "<dynamics damping=\"0.1\" friction=\"0\"/>";
  const PhysicsUrdf physics = read();
  EXPECT_FALSE(holds(physics.xml, "dynamics"));
  ASSERT_EQ(physics.notes.size(), 1U);
  EXPECT_TRUE(holds(physics.notes[0], "<dynamics> of 1 joints is ignored"));
}

TEST_F(PhysicsUrdfTest, gives_an_inertia_that_is_impossible_alone_to_the_body_that_it_is_part_of) {
  of_sensor_ =
      "<inertial><origin xyz=\"0 0 0.1\" rpy=\"1.5707963267948966 0 0\"/><mass value=\"1\"/>"
      "<inertia ixx=\"1e-3\" ixy=\"0\" ixz=\"0\" iyy=\"1e-3\" iyz=\"0\" izz=\"4e-3\"/></inertial>";
  const PhysicsUrdf physics = read();
  ASSERT_EQ(physics.notes.size(), 1U);
  EXPECT_TRUE(holds(physics.notes[0], "alone, no body can have the inertia of: eye"));

  const std::string path = folder_ / "robot/urdf/again.urdf";
  std::ofstream(path) << physics.xml;
  const Urdf again = read_urdf(path);
  EXPECT_EQ(again.find_link("eye")->inertia.mass, 0.0);
  const Inertia sensor{1.0, Vec3(0.5, 0.0, 0.1), Vec3(1e-3, 4e-3, 1e-3).asDiagonal()};
  const Inertia expected = Inertia{2.0, Vec3::Zero(), Mat3::Identity()} + sensor;
  const Inertia& whole = again.find_link("leg")->inertia;
  EXPECT_DOUBLE_EQ(whole.mass, expected.mass);
  EXPECT_LT((whole.com - expected.com).norm(), 1e-12);
  EXPECT_LT((whole.about_com - expected.about_com).norm(), 1e-12);
}

TEST_F(PhysicsUrdfTest, finds_a_mesh_beside_the_urdf_above_it_and_in_a_package) {
  fs::create_directories(fs::path(folder_ / "robot/meshes"));
  fs::create_directories(fs::path(folder_ / "packages/other"));
  std::ofstream(folder_ / "robot/meshes/leg.stl") << "mesh";
  std::ofstream(folder_ / "packages/other/leg.STL") << "mesh";
  for (const char* uri : {"../meshes/leg.stl", "package://robot/meshes/leg.stl",
                          "package://other/leg.STL", "model://other/leg.STL"}) {
    of_leg_ = std::string(kBall) + "<collision><origin xyz=\"0 0 1\"/><geometry><mesh filename=\"" +
              uri + "\" scale=\"1 2 3\"/></geometry></collision>";
    const std::string xml = read().xml;
    const std::size_t begin = xml.find("filename=\"") + 10;
    EXPECT_TRUE(fs::is_regular_file(xml.substr(begin, xml.find('"', begin) - begin))) << xml;
    EXPECT_TRUE(holds(xml, "scale=\"1 2 3\"")) << uri;
  }
}

TEST_F(PhysicsUrdfTest, says_where_a_mesh_that_is_missing_was_looked_for) {
  of_leg_ +=
      "<collision><geometry><mesh filename=\"package://other/leg.stl\"/></geometry></collision>";
  const std::string message = complaint();
  EXPECT_TRUE(holds(message,
                    "robot.urdf:1: link \"leg\": there is no "
                    "\"package://other/leg.stl\"; looked for at: "))
      << message;
  EXPECT_TRUE(holds(message, "packages/other/leg.stl, in a folder \"other\" in ")) << message;
}

TEST_F(PhysicsUrdfTest, leaves_out_meshes_that_physics_does_not_read_with_a_note) {
  of_leg_ += "<collision><geometry><mesh filename=\"leg.dae\"/></geometry></collision>";
  const PhysicsUrdf physics = read();
  EXPECT_FALSE(holds(physics.xml, "mesh"));
  ASSERT_EQ(physics.notes.size(), 1U);
  EXPECT_TRUE(holds(physics.notes[0], "neither .stl nor .obj were left out"));
  EXPECT_TRUE(holds(physics.notes[0], ": leg"));
}

TEST_F(PhysicsUrdfTest, refuses_stops_that_cross_and_shapes_without_size) {
  joint_ = "<axis xyz=\"0 1 0\"/><limit lower=\"2\" upper=\"-1\"/>";
  EXPECT_TRUE(holds(complaint(), "joint \"knee\": its lower limit, 2, is above the upper, -1"));
  joint_ = "";
  of_leg_ += "<collision><geometry><box size=\"1 0 1\"/></geometry></collision>";
  EXPECT_TRUE(
      holds(complaint(), "link \"leg\": the <box> that it collides with has a size of 0 m"));
  of_leg_ = std::string(kBall) + "<collision><geometry><cone/></geometry></collision>";
  EXPECT_TRUE(holds(complaint(), "<cone> is no collision shape; valid: box, capsule"));
}

}  // namespace
}  // namespace surefoot::model
