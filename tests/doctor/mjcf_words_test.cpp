// What the doctor says of an MJCF names the elements of an MJCF.
#include "surefoot/doctor/mjcf_words.hpp"

#include "tests/doctor/changed_robot.hpp"
#include "tests/support/messages.hpp"

#include <tuple>

namespace surefoot::doctor {
namespace {

using test::has;

/// A trunk on four legs, with more on its trunk; ranges are in the unit of the compiler.
std::string mjcf(const std::string& compiler, const std::string& on_trunk) {
  constexpr const char* kInertial =
      R"(<inertial pos="0 0 0" mass="1" diaginertia="1e-2 1e-2 1e-2"/>)";
  std::string legs;
  for (const auto& [name, x, y] : {std::tuple{"LF", "0.25", "0.09"},
                                   {"RF", "0.25", "-0.09"},
                                   {"LH", "-0.25", "0.09"},
                                   {"RH", "-0.25", "-0.09"}}) {
    const std::string leg = name;
    legs += "<body name='" + leg + "_hip' pos='" + x + " " + y + " 0'>" + kInertial +
            "<joint name='" + leg + "_HAA' axis='1 0 0' range='-0.8 0.8'/><body name='" + leg +
            "_thigh'>" + kInertial + "<joint name='" + leg +
            "_HFE' axis='0 1 0' range='-2.2 2.2'/><body name='" + leg + "_shank' pos='0 0 -0.26'>" +
            kInertial + "<joint name='" + leg +
            "_KFE' axis='0 1 0' range='-2.6 2.6'/><geom name='" + leg +
            "_foot' type='sphere' size='0.024' pos='0 0 -0.26'/></body></body></body>";
  }
  return "<mujoco model='m'>" + compiler +
         "<worldbody><body name='trunk' pos='0 0 0.5'><freejoint/><inertial pos='0 0 0' mass='10' "
         "diaginertia='0.05 0.2 0.25'/>" +
         on_trunk + legs + "</body></worldbody></mujoco>";
}

Diagnosis diagnosis(const std::string& compiler, const std::string& on_trunk = "") {
  const test::TemporaryFolder folder;
  test::write_file(folder / "robot.xml", mjcf(compiler, on_trunk));
  return examine(folder / "robot.xml");
}

TEST(MjcfWords, take_the_place_of_those_of_a_urdf) {
  Findings findings(2);
  findings[0].remedy = "correct its <axis>, or the rpy of its <origin>";
  findings[1].remedy = "correct <mass value>";
  say_as_mjcf(findings);
  EXPECT_EQ(findings[0].remedy,
            "correct the axis of its <joint>, or the orientation of its <body>");
  EXPECT_EQ(findings[1].remedy, "correct the mass of <inertial>");
}

TEST(MjcfWords, tell_radians_without_their_compiler_setting) {
  EXPECT_TRUE(has(diagnosis(""), Severity::error,
                  "is range=\"-2.6 2.6\" in radians? Then add <compiler angle=\"radian\"/>"));
  EXPECT_FALSE(has(diagnosis("<compiler angle='radian'/>"), Severity::error, "radians"));
}

TEST(MjcfWords, tell_a_ball_joint) {
  const Diagnosis robot = diagnosis(
      "<compiler angle='radian'/>",
      "<body name='head'><inertial pos='0 0 0' mass='1' diaginertia='1e-2 1e-2 1e-2'/><joint "
      "name='neck' type='ball'/></body>");
  EXPECT_TRUE(has(robot, Severity::error, "its type is \"ball\", and a leg or an arm has hinges"));
  EXPECT_TRUE(has(robot, Severity::error, "set type=\"hinge\""));
}

}  // namespace
}  // namespace surefoot::doctor
