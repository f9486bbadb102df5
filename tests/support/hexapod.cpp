#include "tests/support/hexapod.hpp"

#include "tests/logging/temporary_folder.hpp"
#include "tests/support/source_file.hpp"

#include <stdexcept>

namespace surefoot::test {
namespace {

constexpr const char* kLimit = R"(<limit lower="-0.6" upper="0.6" effort="60" velocity="12"/>)";
constexpr const char* kInertial =
    R"(<inertial><mass value="0.5"/><inertia ixx="0.002" iyy="0.002" izz="0.002" ixy="0" ixz="0" iyz="0"/></inertial>)";

void replace(std::string& text, const std::string& old, const std::string& with) {
  const std::size_t place = text.find(old);
  if (place == std::string::npos) throw std::logic_error("not in the URDF: " + old);
  text.replace(place, old.size(), with);
}

}  // namespace

model::RobotDescription hexapod() {
  model::RobotDescription robot;
  robot.name = "hexapod";
  robot.urdf_path = source_file("robots/hexapod.urdf");
  robot.base_link = "torso";
  robot.legs.resize(kMaxLegs);
  for (JointVector* values : {&robot.q_nominal, &robot.q_min, &robot.q_max})
    values->setZero(robot.num_joints());
  for (const Leg leg : robot.legs.legs()) {
    const std::string name(leg_name(leg, kMaxLegs));
    model::LegDescription& parts = robot.legs[index(leg)];
    parts.joints = {name + "_HAA", name + "_HFE", name + "_KFE"};
    parts.hip_frame = parts.thigh_link = name + "_thigh";
    parts.shank_link = name + "_shank";
    parts.foot_frame = name + "_foot";
    robot.q_nominal.segment<3>(first_joint(leg)) << 0.0, 0.5, -1.0;
    robot.q_min.segment<3>(first_joint(leg)) << -0.8, -2.2, -2.6;
    robot.q_max.segment<3>(first_joint(leg)) << 0.8, 2.2, 2.6;
  }
  for (model::LegDescription& leg : robot.legs) leg.foot_radius = 0.03;
  robot.torque_limit.setConstant(robot.num_joints(), 60.0);
  robot.velocity_limit.setConstant(robot.num_joints(), 12.0);
  robot.hold_kp.setConstant(robot.num_joints(), 80.0);
  robot.hold_kd.setConstant(robot.num_joints(), 4.0);
  robot.damping_kd.setConstant(robot.num_joints(), 6.0);
  return robot;
}

std::string hexapod_urdf_with_further_joints() {
  std::string urdf = contents(source_file("robots/hexapod.urdf"));
  for (const std::string_view name : kHexapodLegNames) {
    const std::string leg(name), joint = "<joint name=\"" + leg;
    const std::string haa = joint + "_HAA\" type=\"revolute\"><parent link=\"";
    const std::string ankle = joint + "_ANKLE\" type=\"";
    replace(urdf, haa + "torso\"/>",
            "<link name=\"" + leg + "_coxa\">" + kInertial + "</link>\n  " + joint +
                "_YAW\" type=\"revolute\"><parent link=\"torso\"/><child link=\"" + leg +
                "_coxa\"/><origin xyz=\"0 0 0.02\"/><axis xyz=\"0 0 1\"/>" + kLimit +
                "</joint>\n  " + haa + leg + "_coxa\"/>");
    replace(urdf, ankle + "fixed\">", ankle + "revolute\"><axis xyz=\"0 1 0\"/>" + kLimit);
  }
  return urdf;
}

}  // namespace surefoot::test
