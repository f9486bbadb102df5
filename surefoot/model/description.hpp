#pragma once

#include "surefoot/base/scale.hpp"
#include "surefoot/signals/leg.hpp"

#include <string>
#include <vector>

namespace surefoot::model {

/// Names of one leg's parts in the URDF.
struct LegDescription {
  std::array<std::string, kJointsPerLeg> joints;  ///< HAA, HFE, KFE
  std::string hip_frame;                          ///< on the HFE axis: the hip H of Eq. (35)
  std::string thigh_link;
  std::string shank_link;  ///< link that carries the foot sphere
  std::string foot_frame;  ///< frame of the sphere's centre
};

/// Everything specific to a robot; read from robots/*.yaml.
struct RobotDescription {
  std::string name;
  std::string urdf_path;  ///< or that of the robot's MJCF
  std::string urdf_text;  ///< the URDF made from an MJCF; empty: that of the file
  std::vector<std::string> package_folders;  ///< searched for package:// names
  std::string base_link;
  PerLeg<LegDescription> legs;
  Scale scale;  ///< multiplies every constant and default that has a length, a mass or a time
  double foot_radius = 0.0;         ///< [m]
  Vec3 foot_center = Vec3::Zero();  ///< centre of the foot sphere in the foot frame [m]
  JointVector torque_limit = JointVector::Zero();    ///< |τ| ≤ limit [N·m]
  JointVector velocity_limit = JointVector::Zero();  ///< [rad/s]
  /// Torque–speed line of the drives: at rest [N·m], and where no torque is left [rad/s].
  JointVector stall_torque = JointVector::Zero(), no_load_speed = JointVector::Zero();
  JointVector q_min = JointVector::Zero();  ///< [rad]
  JointVector q_max = JointVector::Zero();  ///< [rad]
  /// Nominal standing posture, X-configuration: front knees backward, hind knees forward [rad].
  JointVector q_nominal = JointVector::Zero();
  double hold_kp = 0.0;     ///< joint hold of the safety ladder [N·m/rad]
  double hold_kd = 0.0;     ///< [N·m·s/rad]
  double damping_kd = 0.0;  ///< damping mode [N·m·s/rad]
};

}  // namespace surefoot::model
