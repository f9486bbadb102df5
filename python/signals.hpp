#pragma once

#include "python/field_properties.hpp"
#include "surefoot/simulation/ground_truth.hpp"

#include <nanobind/stl/array.h>

#include <algorithm>
#include <array>

namespace surefoot::python {

using Twelve = std::array<double, kNumJoints>;

inline JointCommand joint_command(const Twelve& torque) {
  JointCommand command;
  std::ranges::copy(torque, command.torque.data());
  return command;
}

/// What the program's own log leaves to its truth channel.
inline void bind_truth(nb::module_& module) {
  nb::class_<TrueContact> contact(module, "TrueContact",
                                  "What really touches the ground at a foot.");
  const TrueContact c;
  FieldProperties<TrueContact> of_contact(contact, c);
  of_contact("touching", c.touching, "the foot touches the ground");
  of_contact("force", c.force, "of the ground on the foot, in W [N]");
  of_contact("normal", c.normal, "mean normal of its contacts, in W");
  of_contact("point", c.point, "mean contact point in W [m]");
  of_contact("slip_velocity", c.slip_velocity,
             "tangential, of the contact point's material, in W [m/s]");
  of_contact("friction", c.friction, "coefficient of this contact");
  of_contact("penetration", c.penetration, "deepest [m]");

  nb::class_<GroundTruth> truth(module, "GroundTruth",
                                "What the simulator knows and no sensor says.");
  const GroundTruth t;
  FieldProperties<GroundTruth> of_truth(truth, t);
  of_truth("time", t.time, "[s]");
  of_truth("p_WB", t.p_WB, "base position in W [m]");
  of_truth("q_WB", t.q_WB, "base orientation as quaternion w, x, y, z; takes B coordinates to W");
  of_truth("v_WB", t.v_WB, "base velocity in W [m/s]");
  of_truth("w_WB_B", t.w_WB_B, "base angular velocity in B [rad/s]");
  of_truth("q", t.q, "joint positions [rad]");
  of_truth("qd", t.qd, "joint velocities [rad/s]");
  of_truth("torque", t.torque, "applied at the joints, behind the actuator model [N·m]");
  of_truth("p_WCom", t.p_WCom, "centre of mass of everything that moves, in W [m]");
  of_truth("v_WCom", t.v_WCom, "[m/s]");
  of_truth("p_WF", t.p_WF, "centres of the foot spheres in W [m]");
  of_truth("v_WF", t.v_WF, "[m/s]");
  of_truth("feet", t.feet, "contact of each foot");
  of_truth("body_contact_force", t.body_contact_force, "largest on any other part than a foot [N]");
  of_truth("torso_contact", t.torso_contact, "the torso touches the ground");
  of_truth("shank_contacts", t.shank_contacts,
           "bit k: thigh, knee or shank of leg k touches the ground");
  of_truth("qpos", t.qpos, "MuJoCo's mjData.qpos for Plant.model_xml()");
  of_truth("qvel", t.qvel, "mjData.qvel");
  of_truth("ctrl", t.ctrl, "mjData.ctrl");
  of_truth("xfrc_applied", t.xfrc_applied,
           "mjData.xfrc_applied, row by row: force [N] and torque [N·m] from outside on each body");
}

inline void bind_signals(nb::module_& module) {
  signal<SensorReading>(module, "SensorReading", "What the robot's sensors give at one tick.")
      .def(nb::init<>());

  signal<UserCommand>(module, "UserCommand", "What the operator asks for.")
      .def(
          "__init__",
          [](UserCommand* self, bool walk, std::array<double, 2> velocity, double yaw_rate,
             double height) {
            new (self) UserCommand{walk, Vec2(velocity[0], velocity[1]), yaw_rate, height};
          },
          nb::arg("walk") = false, nb::arg("velocity") = std::array<double, 2>{},
          nb::arg("yaw_rate") = 0.0, nb::arg("height") = 0.0);

  signal<JointCommand>(module, "JointCommand", "Torques for the actuators at one tick.")
      .def(
          "__init__",
          [](JointCommand* self, const Twelve& torque) {
            new (self) JointCommand(joint_command(torque));
          },
          nb::arg("torque") = Twelve{});

  signal<RobotState>(module, "RobotState", "The state that the controller believes.");
  signal<FootPlan>(module, "FootPlan", "Reference of one foot F, the centre of its sphere, in W.");
  signal<TorsoPlan>(module, "TorsoPlan", "Reference of the torso.");
  signal<ComPlan>(module, "ComPlan", "Reference of the centre of mass, x and y in W.");
  signal<MotionPlan>(module, "MotionPlan", "Everything that the tasks follow at one tick.");
  signal<ModelRecord>(module, "ModelRecord",
                      "What the controller's model says of the robot at one tick.");
  signal<TickTiming>(module, "TickTiming", "Wall-clock time of the stages of one tick [µs].");
  bind_truth(module);
}

}  // namespace surefoot::python
