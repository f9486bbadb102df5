#include "tests/support/hyq.hpp"

#include "surefoot/base/build_info.hpp"

#include <cctype>

namespace surefoot::test {

model::RobotDescription hyq() {
  model::RobotDescription robot;
  robot.name = "hyq";
  const std::string packages(build_info().robot_packages);
  robot.package_folders = {packages};
  robot.urdf_path =
      packages + "/example-robot-data/robots/hyq_description/robots/hyq_no_sensors.urdf";
  robot.base_link = "base_link";
  for (const Leg leg : kLegs) {
    std::string name(kLegNames[index(leg)]);
    for (char& letter : name) letter = static_cast<char>(std::tolower(letter));
    model::LegDescription& parts = robot.legs[index(leg)];
    parts.joints = {name + "_haa_joint", name + "_hfe_joint", name + "_kfe_joint"};
    parts.hip_frame = parts.thigh_link = name + "_upperleg";
    parts.shank_link = name + "_lowerleg";
    parts.foot_frame = name + "_foot";
    const double side = is_front(leg) ? 1.0 : -1.0;
    robot.q_nominal.segment<3>(first_joint(leg)) << 0.0, 0.6 * side, -1.2 * side;
    robot.q_min.segment<3>(first_joint(leg)) << -1.22, -1.22, -2.44;
    robot.q_max.segment<3>(first_joint(leg)) << 0.43, 1.22, 2.44;
  }
  for (model::LegDescription& leg : robot.legs) leg.foot_radius = 0.02175;
  robot.torque_limit.setConstant(150.0);
  robot.velocity_limit.setConstant(12.0);
  robot.hold_kp.setConstant(robot.num_joints(), 300.0);
  robot.hold_kd.setConstant(robot.num_joints(), 10.0);
  robot.damping_kd.setConstant(robot.num_joints(), 10.0);
  return robot;
}

}  // namespace surefoot::test
