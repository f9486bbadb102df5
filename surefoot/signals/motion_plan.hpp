#pragma once

#include "surefoot/signals/event_list.hpp"
#include "surefoot/signals/frame_plan.hpp"
#include "surefoot/signals/leg.hpp"
#include "surefoot/signals/user_command.hpp"

namespace surefoot {

/// Stages of the calibration before a walk.
enum class CalibrationStage : int {
  none = 0,
  settling = 1,  ///< stands still, or takes over its results
  turning = 2,   ///< turns the torso on the spot
  weighing = 3,  ///< stands still to measure its weight and centre of mass
};

/// What a leg is doing. `stance` and `unloading` carry force, the others do not.
enum class LegPhase : int {
  stance = 0,     ///< in contact, f_max ramps up from 0 after a touchdown and stays
  unloading = 1,  ///< in contact, f_max ramps down to 0 before lift-off
  swing = 2,      ///< follows its swing curve
  search = 3,     ///< late contact: moves down along the terrain normal until touchdown
};

[[nodiscard]] constexpr bool in_contact(LegPhase phase) {
  return phase == LegPhase::stance || phase == LegPhase::unloading;
}

/// Reference of one foot F (the centre of its sphere), all vectors in W.
struct FootPlan {
  LegPhase phase = LegPhase::stance;
  Vec3 p_WF = Vec3::Zero();  ///< reference position; of a stance foot: its foothold [m]
  Vec3 v_WF = Vec3::Zero();  ///< [m/s]
  Vec3 a_WF = Vec3::Zero();  ///< [m/s²]
  double force_min = 0.0;    ///< normal force limits of Eq. (30), min(f_min, f_max(t)) [N]
  double force_max = 0.0;    ///< [N]
  double friction = 0.5;     ///< μ that the contact force may use
};

/// Reference of the torso in W.
struct TorsoPlan {
  Quat q_WB = Quat::Identity();      ///< desired orientation
  Vec3 w_WB = Vec3::Zero();          ///< desired angular velocity, in W [rad/s]
  Vec3 wdot_WB = Vec3::Zero();       ///< desired angular acceleration, in W [rad/s²]
  double height = 0.0;               ///< desired z of the base in W [m]
  double height_rate = 0.0;          ///< [m/s]
  double height_acceleration = 0.0;  ///< [m/s²]
};

/// Reference of the tip T of an arm, in W.
struct ArmPlan {
  int arm = -1;  ///< in the robot's order; −1: no tip follows anything
  Vec3 p_WT = Vec3::Zero();
  Vec3 v_WT = Vec3::Zero();
  Vec3 a_WT = Vec3::Zero();
  Quat q_WT = Quat::Identity();
  Vec3 w_WT = Vec3::Zero();  ///< [rad/s]
};

/// Desired motion of the centre of mass, x and y in W.
struct ComPlan {
  Vec2 p{0.0, 0.0};    ///< [m]
  Vec2 v{0.0, 0.0};    ///< [m/s]
  Vec2 a{0.0, 0.0};    ///< [m/s²]
  Vec2 zmp{0.0, 0.0};  ///< its zero-moment point [m]
};

/// Everything that the tasks follow at one tick, made by the planner.
struct MotionPlan {
  double time = 0.0;  ///< [s]
  PerLeg<FootPlan> feet{};
  TorsoPlan torso{};
  ComPlan com{};
  ArmPlan arm{};
  /// Of frames that tasks follow. The controller adds those that the planner does not give.
  FrameList frames{};
  /// Reference of the joints, for tasks that follow it [rad]; without one they stay where they were
  /// at first.
  JointVector joints{};
  /// Control frame C: z along the filtered terrain normal, x the heading.
  Mat3 R_WC = Mat3::Identity();
  /// A point of the fitted terrain plane, at sphere-centre height, in W [m].
  Vec3 terrain_point = Vec3::Zero();
  double com_zmp_slack = 0.0;  ///< distance of the plan's ZMP outside the support polygon [m]
  CalibrationStage calibration = CalibrationStage::none;
  int gait = UserCommand::kOwnGait;  ///< as in `UserCommand`; never kAutoGait
  EventList events;                  ///< of this tick

  [[nodiscard]] bool contact(Leg leg) const { return in_contact(feet[index(leg)].phase); }
  /// The feet that may carry load.
  [[nodiscard]] PerLeg<bool> standing() const {
    PerLeg<bool> result;
    result.resize(static_cast<int>(feet.size()));
    for (const Leg leg : feet.legs()) result[index(leg)] = contact(leg);
    return result;
  }
  [[nodiscard]] int num_contacts() const {
    int count = 0;
    for (const Leg leg : feet.legs()) count += contact(leg) ? 1 : 0;
    return count;
  }
};

}  // namespace surefoot
