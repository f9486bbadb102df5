#pragma once

#include "surefoot/signals/per_leg.hpp"

#include <vector>

namespace surefoot::simulation {

/// True contact of a foot with the ground.
struct TrueContact {
  bool touching = false;
  bool touched = false;         ///< at any physics step since the tick before
  Vec3 force = Vec3::Zero();    ///< of the ground on the foot, summed over its contacts, in S [N]
  Vec3 normal = Vec3::UnitZ();  ///< force-weighted mean normal, in S
  Vec3 point = Vec3::Zero();    ///< force-weighted mean contact point, in S [m]
  Vec3 slip_velocity =
      Vec3::Zero();          ///< tangential velocity of the material contact point, in S [m/s]
  double friction = 0.0;     ///< coefficient
  double penetration = 0.0;  ///< deepest [m]
};

/// The simulator's truth. Only evaluation, the log's truth channel and an explicit `estimation:
/// truth` may read it; control never includes this header.
struct GroundTruth {
  double time = 0.0;
  Vec3 p_SB = Vec3::Zero();
  Quat q_SB = Quat::Identity();
  Vec3 v_SB = Vec3::Zero();    ///< in S
  Vec3 w_SB_B = Vec3::Zero();  ///< in B
  JointVector q = JointVector::Zero(kNumLegJoints);
  JointVector qd = JointVector::Zero(kNumLegJoints);
  JointVector torque =
      JointVector::Zero(kNumLegJoints);  ///< applied at the joints, after the actuator model [N·m]
  Vec3 p_SCom = Vec3::Zero();            ///< of all moving parts, with payload
  Vec3 v_SCom = Vec3::Zero();
  PerLeg<Vec3> p_SF = per_leg<Vec3>(Vec3::Zero());  ///< of spheres or soles, the centres
  PerLeg<Vec3> v_SF = per_leg<Vec3>(Vec3::Zero());
  std::vector<Vec3> p_ST;  ///< tips of arms
  PerLeg<TrueContact> feet;
  double body_contact_force = 0.0;  ///< largest force on any part of the robot besides feet [N]
  bool torso_contact = false;       ///< the torso touches the ground
  int shank_contacts = 0;           ///< bit k: thigh, knee or shank of leg k touches the ground
  std::vector<double> qpos, qvel, ctrl;  ///< MuJoCo's own, so that stock MuJoCo can replay
  std::vector<double> xfrc_applied;      ///< MuJoCo's external forces, 6 a body: the pushes
};

}  // namespace surefoot::simulation
