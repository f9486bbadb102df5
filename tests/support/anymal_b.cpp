#include "tests/support/anymal_b.hpp"

#include "surefoot/base/build_info.hpp"

namespace surefoot::test {

model::RobotDescription anymal_b() {
  model::RobotDescription robot;
  robot.name = "anymal_b";
  const std::string packages(build_info().robot_packages);
  robot.package_folders = {packages};
  robot.urdf_path =
      packages + "/example-robot-data/robots/anymal_b_simple_description/robots/anymal.urdf";
  robot.base_link = "base";
  for (const Leg leg : kLegs) {
    const std::string name(kLegNames[index(leg)]);
    model::LegDescription& parts = robot.legs[index(leg)];
    parts.joints = {name + "_HAA", name + "_HFE", name + "_KFE"};
    parts.hip_frame = name + "_THIGH";
    parts.thigh_link = name + "_THIGH";
    parts.shank_link = name + "_SHANK";
    parts.foot_frame = name + "_FOOT";
    const double side = is_front(leg) ? 1.0 : -1.0;
    robot.q_nominal.segment<3>(first_joint(leg)) << 0.0, 0.4 * side, -0.8 * side;
    robot.q_min.segment<3>(first_joint(leg)) << -1.2, -2.6, -2.9;
    robot.q_max.segment<3>(first_joint(leg)) << 1.2, 2.6, 2.9;
  }
  for (model::LegDescription& leg : robot.legs) {
    leg.foot_radius = 0.031;
    leg.foot_center = Vec3(0.0, 0.0, 0.02325);
  }
  robot.torque_limit.setConstant(40.0);
  robot.velocity_limit.setConstant(15.0);
  robot.hold_kp.setConstant(robot.num_joints(), 80.0);
  robot.hold_kd.setConstant(robot.num_joints(), 4.0);
  robot.damping_kd.setConstant(robot.num_joints(), 6.0);
  return robot;
}

model::RobotDescription anymal_b_with_arm() {
  model::RobotDescription robot = anymal_b();
  robot.urdf_path = robot.urdf_path.replace(robot.urdf_path.find("anymal.urdf"), std::string::npos,
                                            "anymal-kinova.urdf");
  model::ArmDescription arm{.name = "kinova", .joints = {}, .tip_frame = "j2s6s200_end_effector"};
  for (int j = 1; j <= 6; ++j) arm.joints.push_back("j2s6s200_joint_" + std::to_string(j));
  robot.arms.push_back(arm);
  const auto extend = [](JointVector& values, double value) {
    values.conservativeResize(kNumLegJoints + 6);
    values.tail(6).setConstant(value);
  };
  extend(robot.q_nominal, 1.0);
  extend(robot.q_min, -6.0);
  extend(robot.q_max, 6.0);
  extend(robot.torque_limit, 20.0);
  extend(robot.velocity_limit, 1.0);
  return robot;
}

}  // namespace surefoot::test
