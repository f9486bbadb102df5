#pragma once

#include "surefoot/base/scale.hpp"
#include "surefoot/signals/leg.hpp"

#include <string>
#include <vector>

namespace surefoot::model {

/// Names of one leg's parts in the URDF, and its foot.
struct LegDescription {
  /// HAA, HFE, KFE of a walker, which place its foot; else all from the base to the foot.
  std::vector<std::string> joints = std::vector<std::string>(kJointsPerLeg);
  /// All others of a walker between base and foot, in this order. They keep the nominal posture.
  std::vector<std::string> further;
  std::string hip_frame;            ///< on the HFE axis: the hip H of Eq. (35)
  std::string thigh_link;           ///< empty: no walker
  std::string shank_link;           ///< on the body that carries the foot
  std::string foot_frame;           ///< frame of the foot's centre
  double foot_radius = 0.0;         ///< of the sphere [m]
  Vec3 foot_center = Vec3::Zero();  ///< centre of sphere or sole in the foot frame [m]
};

/// A limb that stands on nothing: an arm, a neck, a tail.
struct ArmDescription {
  std::string name;
  std::vector<std::string> joints;  ///< in the URDF, from the base to the tip
  std::string tip_frame;            ///< what `frame_position` and `frame_orientation` move
};

/// Everything specific to a robot; read from robots/*.yaml.
struct RobotDescription {
  std::string name;
  std::string urdf_path;  ///< or that of the robot's MJCF
  std::string urdf_text;  ///< the URDF made from an MJCF; empty: that of the file
  std::vector<std::string> package_folders;  ///< searched for package:// names
  std::string base_link;
  PerLeg<LegDescription> legs;
  std::vector<ArmDescription> arms;  ///< their joints follow the legs' in every JointVector
  Scale scale;  ///< multiplies every constant and default that has a length, a mass or a time
  Vec2 sole = Vec2::Zero();  ///< length and width of flat feet, along their x and y [m]
  JointVector torque_limit = JointVector::Zero(kNumLegJoints);    ///< |τ| ≤ limit [N·m]
  JointVector velocity_limit = JointVector::Zero(kNumLegJoints);  ///< [rad/s]
  /// Torque–speed line of the drives: at rest [N·m], and where no torque is left [rad/s].
  JointVector stall_torque = JointVector::Zero(kNumLegJoints),
              no_load_speed = JointVector::Zero(kNumLegJoints);
  JointVector q_min = JointVector::Zero(kNumLegJoints);  ///< [rad]
  JointVector q_max = JointVector::Zero(kNumLegJoints);  ///< [rad]
  /// Nominal standing posture, X-configuration: front knees backward, hind knees forward [rad].
  JointVector q_nominal = JointVector::Zero(kNumLegJoints);

  [[nodiscard]] int num_legs() const { return static_cast<int>(legs.size()); }
  /// Four or six legs of at least three joints, with spheres as feet. Others have two legs with
  /// flat feet: they stand.
  [[nodiscard]] bool can_walk() const { return num_legs() >= kNumLegs; }
  /// Of `LegDescription::joints`.
  [[nodiscard]] JointRange leg_joints(Leg leg) const;
  [[nodiscard]] JointRange further_joints(Leg leg) const;
  /// Joints of the legs with the further ones; those of the arms follow.
  [[nodiscard]] int num_leg_joints() const;
  /// n_τ
  [[nodiscard]] int num_joints() const;
  /// Of the URDF, in the order of a JointVector.
  [[nodiscard]] std::vector<std::string> joint_names() const;
  /// As in messages: "LF_HAA", and the URDF's name of a further joint or an arm's.
  [[nodiscard]] std::string joint_name(int joint) const;
  JointVector hold_kp = JointVector::Zero(kNumLegJoints);     ///< of the safety ladder [N·m/rad]
  JointVector hold_kd = JointVector::Zero(kNumLegJoints);     ///< [N·m·s/rad]
  JointVector damping_kd = JointVector::Zero(kNumLegJoints);  ///< of damping mode [N·m·s/rad]
};

}  // namespace surefoot::model
