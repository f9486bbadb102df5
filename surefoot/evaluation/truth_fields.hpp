#pragma once

#include "surefoot/logging/message_fields.hpp"
#include "surefoot/simulation/ground_truth.hpp"

/// The truth's fields, for the log's channel and for Python.
namespace surefoot::logged {

template <typename Archive, Is<simulation::TrueContact> T>
void fields(Archive& field, T& contact) {
  field("touching", contact.touching, "the foot touches the ground");
  field("touched", contact.touched,
        "it touches, or did in a physics step since the tick before: a bounce can be over by then");
  field("force", contact.force, "of the ground on the foot, in S [N]");
  field("normal", contact.normal, "mean normal of its contacts, in S");
  field("point", contact.point, "mean contact point in S [m]");
  field("slip_velocity", contact.slip_velocity,
        "tangential, of the contact point's material, in S [m/s]");
  field("friction", contact.friction, "coefficient of this contact");
  field("penetration", contact.penetration, "deepest [m]");
}

template <typename Archive, Is<simulation::GroundTruth> T>
void fields(Archive& field, T& truth) {
  field("time", truth.time, "of the simulation [s]");
  field("p_SB", truth.p_SB, "base position in S [m]");
  field("q_SB", truth.q_SB, "base orientation as quaternion w, x, y, z; takes B coordinates to S");
  field("v_SB", truth.v_SB, "base velocity in S [m/s]");
  field("w_SB_B", truth.w_SB_B, "base angular velocity in B [rad/s]");
  field("q", truth.q, "joint positions [rad]");
  field("qd", truth.qd, "joint velocities [rad/s]");
  field("torque", truth.torque, "applied at the joints, behind the actuator model [N·m]");
  field("p_SCom", truth.p_SCom, "centre of mass of everything that moves, in S [m]");
  field("v_SCom", truth.v_SCom, "its velocity, in S [m/s]");
  field("p_SF", truth.p_SF, "centres of the foot spheres in S [m]");
  field("v_SF", truth.v_SF, "velocities of these centres, in S [m/s]");
  field("feet", truth.feet, "contact of each foot");
  field("body_contact_force", truth.body_contact_force,
        "largest on any other part than a foot [N]");
  field("torso_contact", truth.torso_contact, "the torso touches the ground");
  field("shank_contacts", truth.shank_contacts,
        "bit k: thigh, knee or shank of leg k touches the ground");
  // Tools read brackets with several units by position: a last "…" repeats the unit before it;
  // without it, the list repeats.
  field("qpos", truth.qpos,
        "MuJoCo's mjData.qpos, of the model in model.xml: base position in S, its quaternion w, x, "
        "y, z, then the joints' angles in the model's order [m, m, m, 1, 1, 1, 1, rad, …]");
  field("qvel", truth.qvel,
        "mjData.qvel: base velocity in S, its angular velocity in B, then the joints' in the "
        "model's order [m/s, m/s, m/s, rad/s, …]");
  field("ctrl", truth.ctrl,
        "mjData.ctrl: torque of each joint's motor, as the actuator model has it, in the model's "
        "order [N·m]");
  field("xfrc_applied", truth.xfrc_applied,
        "mjData.xfrc_applied: from outside on each body, one after the other in the model's order, "
        "a force at its centre of mass and a torque, x, y and z, both in S: numbers 6 k to 6 k + 5 "
        "are body k's, the world's first, the base's from 6 on [N, N, N, N·m, N·m, N·m]");
}

}  // namespace surefoot::logged
