#include "tests/support/hexapod.hpp"

#include "tests/support/source_file.hpp"

namespace surefoot::test {

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

}  // namespace surefoot::test
