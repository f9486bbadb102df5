#pragma once

#include "surefoot/gaits/body.hpp"
#include "surefoot/model/dynamics.hpp"
#include "surefoot/signals/hierarchy_outcome.hpp"
#include "surefoot/signals/motion_plan.hpp"
#include "surefoot/signals/robot_state.hpp"
#include "surefoot/signals/user_command.hpp"

#include <optional>

namespace surefoot::gaits {

/// What the gait that has the legs is about to do.
struct GaitStatus {
  std::optional<Leg> swings{};    ///< makes its step
  std::optional<Leg> unloads{};   ///< is about to lift off
  double lands_at = kNever;       ///< expected touchdown of `swings` [s]
  double support_duration = 0.0;  ///< all feet down before the next step [s]
};

/// What a gait and its reactions see at a tick.
struct Situation {
  double time = 0.0;        ///< [s]
  double yaw = 0.0;         ///< that the torso is to have [rad]
  const UserCommand& user;  ///< with velocities and a height that the legs can follow
  const RobotState& state;
  const model::Dynamics& dynamics;
  const HierarchyOutcome& last;  ///< of the tick before
  const MotionPlan& before;      ///< of the tick before
  const Body& body;
  GaitStatus gait{};

  [[nodiscard]] const Vec3& foot(Leg leg) const { return dynamics.foot[index(leg)].p; }
  /// Something that has happened to a leg: where its foot is, and with what force along the normal.
  [[nodiscard]] GaitEvent event(PlanEvent kind, Leg leg) const {
    return {.kind = kind,
            .leg = leg,
            .place = foot(leg),
            .force = body.plane.normal.dot(state.foot_force[index(leg)])};
  }
  /// That event alone.
  [[nodiscard]] EventList told(PlanEvent kind, Leg leg) const {
    EventList result;
    result.add(event(kind, leg));
    return result;
  }
};

/// A leg that goes, or goes on, through the air.
struct SwingOrder {
  Leg leg = Leg::LF;
  SwingTarget target;
  bool keeps_deadline = false;  ///< its touchdown is expected when it was, and the COM plan stays
};

/// What a reaction asks for; what is not set asks for nothing. A reaction is a function of the
/// Situation, and only the gait carries out what it returns.
struct Action {
  EventList events{};
  std::optional<SwingMemory> memory{};  ///< of the swing, from now on
  std::optional<Leg> lands{};           ///< this foot stands where it is
  std::optional<Leg> forgets_print{};   ///< there was no ground where this foot came down last
  std::optional<Vec3> avoids{};         ///< no foothold near this place, in W [m]
  std::optional<Leg> reloads{};         ///< this leg, about to lift off, carries again
  PerLeg<bool> searches{};              ///< these feet look for ground from where they are
  std::optional<SwingOrder> swing{};
  bool steps_out_of_turn = false;   ///< `swing` is a step that the gait did not plan
  std::optional<double> support{};  ///< time until the next lift-off, counted from now [s]
  std::optional<bool> recovers{};   ///< the gait waits until the robot has come to rest
  bool replans = false;             ///< the COM's way is planned anew
};

}  // namespace surefoot::gaits
