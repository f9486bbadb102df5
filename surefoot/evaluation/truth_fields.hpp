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
  field("force", contact.force, "of the ground on the foot, in W [N]");
  field("normal", contact.normal, "mean normal of its contacts, in W");
  field("point", contact.point, "mean contact point in W [m]");
  field("slip_velocity", contact.slip_velocity,
        "tangential, of the contact point's material, in W [m/s]");
  field("friction", contact.friction, "coefficient of this contact");
  field("penetration", contact.penetration, "deepest [m]");
}

template <typename Archive, Is<simulation::GroundTruth> T>
void fields(Archive& field, T& truth) {
  field("time", truth.time, "of the simulation [s]");
  field("p_WB", truth.p_WB, "base position in W [m]");
  field("q_WB", truth.q_WB, "base orientation as quaternion w, x, y, z; takes B coordinates to W");
  field("v_WB", truth.v_WB, "base velocity in W [m/s]");
  field("w_WB_B", truth.w_WB_B, "base angular velocity in B [rad/s]");
  field("q", truth.q, "joint positions [rad]");
  field("qd", truth.qd, "joint velocities [rad/s]");
  field("torque", truth.torque, "applied at the joints, behind the actuator model [N·m]");
  field("p_WCom", truth.p_WCom, "centre of mass of everything that moves, in W [m]");
  field("v_WCom", truth.v_WCom, "its velocity, in W [m/s]");
  field("p_WF", truth.p_WF, "centres of the foot spheres in W [m]");
  field("v_WF", truth.v_WF, "velocities of these centres, in W [m/s]");
  field("feet", truth.feet, "contact of each foot");
  field("body_contact_force", truth.body_contact_force,
        "largest on any other part than a foot [N]");
  field("torso_contact", truth.torso_contact, "the torso touches the ground");
  field("shank_contacts", truth.shank_contacts,
        "bit k: thigh, knee or shank of leg k touches the ground");
  // Tools read brackets with several units by position: a last "…" repeats the unit before it;
  // without it, the list repeats.
  field("qpos", truth.qpos,
        "MuJoCo's mjData.qpos, of the model in model.xml: base position in W, its quaternion w, x, "
        "y, z, then the joints' angles in the model's order [m, m, m, 1, 1, 1, 1, rad, …]");
  field("qvel", truth.qvel,
        "mjData.qvel: base velocity in W, its angular velocity in B, then the joints' in the "
        "model's order [m/s, m/s, m/s, rad/s, …]");
  field("ctrl", truth.ctrl,
        "mjData.ctrl: torque of each joint's motor, as the actuator model has it, in the model's "
        "order [N·m]");
  field("xfrc_applied", truth.xfrc_applied,
        "mjData.xfrc_applied: from outside on each body, one after the other in the model's order, "
        "a force at its centre of mass and a torque, x, y and z, both in W: numbers 6 k to 6 k + 5 "
        "are body k's, the world's first, the base's from 6 on [N, N, N, N·m, N·m, N·m]");
}

}  // namespace surefoot::logged
