// A small robot in MJCF, changed place by place: what it becomes, and what is refused.
#include "surefoot/simulation/mjcf_robot.hpp"

#include "surefoot/model/collision_shapes.hpp"
#include "surefoot/model/urdf.hpp"
#include "surefoot/simulation/mjcf_urdf.hpp"
#include "tests/logging/temporary_folder.hpp"
#include "tests/support/messages.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace surefoot::simulation {
namespace {

using test::holds;
using test::message_of;

constexpr const char* kRobot = R"(<mujoco model="little">
<compiler angle="degree" meshdir="parts"/>
<default><default class="leg"><joint axis="0 1 0" damping="0.1"/></default></default>
<asset><mesh name="box" file="box.stl" scale="0.1 0.1 0.1"/></asset>
<worldbody>
<geom name="floor" type="plane" size="1 1 1"/>
<light pos="0 0 3"/>
<body name="base" pos="0 0 1" euler="0 0 90">
<freejoint name="free"/>
<inertial pos="0.1 0 0" mass="5" diaginertia="0.1 0.2 0.25"/>
<geom type="box" size="0.2 0.1 0.05" group="3"/>
<geom mesh="box" type="mesh" contype="0" conaffinity="0" rgba="1 0 0 1"/>
<site name="imu" pos="0 0 0.02"/>
<body name="thigh" pos="0.2 0.1 0" euler="0 90 0" childclass="leg">
<joint name="hfe" pos="0 0 0.01" range="-90 60" ref="30" actuatorfrcrange="-12 12"/>
<geom type="capsule" fromto="0 0 0 0 0 -0.3" size="0.02" mass="1"/>
<body name="shank" pos="0 0 -0.3">
<joint name="kfe"/>
<inertial pos="0 0 -0.1" mass="0.3" fullinertia="0.002 0.0021 0.0003 0.0001 0 0"/>
<geom name="foot" size="0.03" pos="0 0 -0.31"/>
</body></body></body>
</worldbody>
<actuator>
<motor name="a" joint="hfe" ctrlrange="-20 20"/>
<motor name="b" joint="kfe" ctrlrange="-3 3" gear="6"/>
</actuator>
<keyframe><key name="home" qpos="0 0 1 1 0 0 0 0 0"/></keyframe>
</mujoco>
)";

class MjcfRobotFile : public testing::Test {
 protected:
  void change(const std::string& from, const std::string& to) {
    const std::size_t place = mjcf_.find(from);
    ASSERT_NE(place, std::string::npos) << from;
    mjcf_.replace(place, from.size(), to);
  }
  std::string text(const std::string& folder = "") {
    test::write_file(folder_ / "robot.xml", mjcf_);
    return urdf_of_mjcf(folder_ / "robot.xml", folder);
  }
  model::Urdf urdf() {
    return model::read_urdf(folder_ / "robot.xml", model::ImpossibleInertia::refused, text());
  }
  std::string complaint() {
    return message_of([&] { (void)urdf(); });
  }

  test::TemporaryFolder folder_;
  std::string mjcf_ = kRobot;
};

const model::UrdfJoint& joint(const model::Urdf& urdf, const std::string& name) {
  return *std::ranges::find(urdf.joints, name, &model::UrdfJoint::name);
}

TEST_F(MjcfRobotFile, becomes_links_and_joints_with_its_lines) {
  const model::Urdf urdf = this->urdf();
  EXPECT_EQ(urdf.root, "base");
  ASSERT_EQ(urdf.links.size(), 5U);
  EXPECT_EQ(urdf.find_link("thigh")->line, 14);
  const model::UrdfJoint& hfe = joint(urdf, "hfe");
  EXPECT_EQ(hfe.type, "revolute");
  EXPECT_EQ(hfe.line, 15);
  EXPECT_NEAR(hfe.lower, -kPi / 2.0, 1e-12);
  EXPECT_NEAR(hfe.upper, kPi / 3.0, 1e-12);
  EXPECT_EQ(joint(urdf, "kfe").type, "continuous");
  EXPECT_TRUE(std::isnan(hfe.velocity));
}

TEST_F(MjcfRobotFile, has_its_joints_at_their_anchors_and_at_angle_zero) {
  const model::UrdfJoint& hfe = joint(urdf(), "hfe");
  // Turned by 90° as written, of which 30° are the joint's reference.
  const Mat3 R = Eigen::AngleAxisd(kPi / 3.0, Vec3::UnitY()).toRotationMatrix();
  EXPECT_TRUE(hfe.R.isApprox(R, 1e-12)) << hfe.R;
  EXPECT_TRUE(hfe.p.isApprox(Vec3(0.21, 0.1, 0.0), 1e-12)) << hfe.p.transpose();
  EXPECT_TRUE(joint(urdf(), "kfe").p.isApprox(Vec3(0.0, 0.0, -0.31), 1e-12));
}

TEST_F(MjcfRobotFile, takes_efforts_from_actuators_and_joints) {
  const model::Urdf urdf = this->urdf();
  EXPECT_EQ(joint(urdf, "hfe").effort, 12.0);  // of the joint, below that of the motor
  EXPECT_EQ(joint(urdf, "kfe").effort, 18.0);  // with its gear
  change("<motor name=\"b\" joint=\"kfe\" ctrlrange=\"-3 3\" gear=\"6\"/>",
         "<position joint=\"kfe\" ctrlrange=\"-3 3\"/>");
  EXPECT_TRUE(std::isnan(joint(this->urdf(), "kfe").effort));
}

TEST_F(MjcfRobotFile, takes_inertias_from_geoms_where_none_is_written) {
  const model::Urdf urdf = this->urdf();
  EXPECT_NEAR(urdf.find_link("thigh")->inertia.mass, 1.0, 1e-12);
  EXPECT_NEAR(urdf.find_link("thigh")->inertia.com.z(), -0.16, 1e-12);
  EXPECT_NEAR(urdf.find_link("shank")->inertia.about_com(0, 1), 0.0001, 1e-12);
}

TEST_F(MjcfRobotFile, has_links_at_named_spheres_and_sites) {
  const model::Urdf urdf = this->urdf();
  EXPECT_EQ(joint(urdf, "foot_fixed").parent, "shank");
  EXPECT_TRUE(joint(urdf, "foot_fixed").p.isApprox(Vec3(0.0, 0.0, -0.31), 1e-12));
  EXPECT_EQ(joint(urdf, "imu_fixed").parent, "base");
}

TEST_F(MjcfRobotFile, collides_with_what_touches_and_shows_what_is_visible) {
  const std::vector<model::CollisionShape> shapes = model::collision_shapes(urdf());
  ASSERT_EQ(shapes.size(), 3U);
  EXPECT_EQ(shapes[0].kind, "box");
  EXPECT_EQ(shapes[1].kind, "capsule");
  EXPECT_EQ(shapes[2].kind, "sphere");
  const std::string text = this->text("package://robots/little");
  EXPECT_TRUE(holds(text, "filename=\"package://robots/little/parts/box.stl\" scale=\"0.1"));
  EXPECT_TRUE(holds(text, "<color rgba=\"1 0 0 1\"/>"));
}

TEST_F(MjcfRobotFile, tells_what_was_left_out) {
  change("<geom name=\"foot\" size",
         "<geom type=\"ellipsoid\" size=\"0.1 0.1 0.2\"/>"
         "<geom name=\"foot\" size");
  const std::vector<std::string> notes = urdf().notes;
  ASSERT_EQ(notes.size(), 2U);
  EXPECT_TRUE(holds(notes[0], "these bodies collide with less or nothing: shank"));
  EXPECT_TRUE(holds(notes[1], "damping, frictionloss and armature of 2 joints are ignored"));
}

TEST_F(MjcfRobotFile, has_names_where_the_file_has_none_and_keeps_those_of_xml) {
  change("<body name=\"shank\"", "<body");
  change("<joint name=\"kfe\"/>", "<joint name=\"a&quot;b\"/>");
  change("<motor name=\"b\" joint=\"kfe\"", "<motor name=\"b\" joint=\"hfe\"");
  EXPECT_EQ(joint(urdf(), "a\"b").child, "body1");
}

TEST_F(MjcfRobotFile, has_the_same_names_for_mujoco_where_the_file_has_none) {
  change("<body name=\"base\"", "<body");
  change("<body name=\"shank\"", "<body");
  change("<joint name=\"kfe\"/>", "<joint/>");
  change("<motor name=\"b\" joint=\"kfe\"", "<motor name=\"b\" joint=\"hfe\"");
  const model::Urdf urdf = this->urdf();
  const MjcfRobot robot = read_mjcf(folder_ / "robot.xml");
  EXPECT_EQ(urdf.root, "body1");
  EXPECT_EQ(joint(urdf, "body2_joint").parent, "thigh");
  EXPECT_EQ(joint(urdf, "body2_joint").child, "body2");
  for (const char* body : {"body1", "body2"})
    EXPECT_GE(id_of(*robot.model, mjOBJ_BODY, body), 0) << body;
  EXPECT_GE(id_of(*robot.model, mjOBJ_JOINT, "body2_joint"), 0);
}

TEST_F(MjcfRobotFile, gives_no_name_that_another_has) {
  change("<body name=\"shank\"", "<body");
  change("<body name=\"thigh\"", "<body name=\"body1\"");
  change("<joint name=\"hfe\"", "<joint name=\"body2_joint\"");
  change("<motor name=\"a\" joint=\"hfe\"", "<motor name=\"a\" joint=\"body2_joint\"");
  change("<joint name=\"kfe\"/>", "<joint/>");
  change("<motor name=\"b\" joint=\"kfe\"", "<motor name=\"b\" joint=\"body2_joint\"");
  EXPECT_EQ(joint(urdf(), "body2_joint_").child, "body2");
}

struct Wrong {
  const char *name, *from, *to, *message;
};
class WrongMjcf : public MjcfRobotFile, public testing::WithParamInterface<Wrong> {};

TEST_P(WrongMjcf, is_refused_with_one_message) {
  change(GetParam().from, GetParam().to);
  const std::string message = complaint();
  EXPECT_TRUE(message.starts_with(folder_ / "robot.xml:")) << message;
  EXPECT_TRUE(holds(message, GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(
    Each, WrongMjcf,
    testing::Values(
        Wrong{"NoFreeJoint", "<freejoint name=\"free\"/>", "", ":1: no body has a free joint"},
        Wrong{"TwoFreeJoints", "</worldbody>",
              "<body name=\"ball\"><freejoint/><geom size=\"1\"/></body></worldbody>",
              ":22: several bodies have a free joint: \"base\" \"ball\""},
        Wrong{"TwoJoints", "<joint name=\"kfe\"/>", "<joint name=\"kfe\"/><joint name=\"more\"/>",
              ":17: body \"shank\" has 2 joints"},
        Wrong{"Equality", "<actuator>",
              "<equality><connect body1=\"thigh\" body2=\"shank\" anchor=\"0 0 0\"/></equality>"
              "<actuator>",
              "an equality constraint ties \"thigh\" to \"shank\""},
        Wrong{
            "Tendon", "<actuator>",
            "<tendon><fixed name=\"rope\" stiffness=\"3\"><joint joint=\"kfe\" coef=\"1\"/></fixed>"
            "</tendon><actuator>",
            "tendon \"rope\" has stiffness"},
        Wrong{"Spring", "<joint name=\"kfe\"/>", "<joint name=\"kfe\" stiffness=\"2\"/>",
              ":18: joint \"kfe\" has stiffness"},
        Wrong{"Floating", "<body name=\"shank\"", "<body gravcomp=\"1\" name=\"shank\"",
              ":17: body \"shank\" has gravcomp"},
        Wrong{"NotFinite", "pos=\"0 0 -0.31\"", "pos=\"0 nan -0.31\"",
              ":20: <origin> needs xyz=\"three finite numbers\""},
        Wrong{"UnknownElement", "<light pos=\"0 0 3\"/>", "<ligt/>", ":7: Schema violation"},
        Wrong{"MassNan", "mass=\"0.3\"", "mass=\"nan\"",
              ":17: body \"shank\": the mass of its <inertial> is not a finite number"},
        Wrong{"NotClosed", "</mujoco>", "", "not well-formed XML"},
        Wrong{"MeshOfInertia",
              "<inertial pos=\"0.1 0 0\" mass=\"5\" diaginertia=\"0.1 0.2 0.25\"/>", "",
              ":4: <mesh>: there is no \"box.stl\"; looked for in"}),
    [](const auto& wrong) { return std::string(wrong.param.name); });

TEST_F(MjcfRobotFile, of_another_format_is_refused_with_the_way_out) {
  mjcf_ = "<robot name=\"x\"><link name=\"base\"/></robot>";
  EXPECT_TRUE(holds(complaint(), "the file has no <mujoco>; a URDF stands under `urdf:`"));
  mjcf_ = "<sdf/>";
  EXPECT_TRUE(complaint().ends_with(":1: not an MJCF: the file has no <mujoco>"));
}

}  // namespace
}  // namespace surefoot::simulation
