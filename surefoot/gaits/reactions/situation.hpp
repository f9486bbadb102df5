#pragma once

#include "surefoot/gaits/body.hpp"
#include "surefoot/model/dynamics.hpp"
#include "surefoot/signals/hierarchy_outcome.hpp"
#include "surefoot/signals/motion_plan.hpp"
#include "surefoot/signals/robot_state.hpp"
#include "surefoot/signals/user_command.hpp"

#include <optional>

namespace surefoot::gaits {

/// State of the active gait.
struct GaitStatus {
  std::optional<Leg> swings{};    ///< the swing leg
  std::optional<Leg> unloads{};   ///< the leg that is about to lift off
  double lands_at = kNever;       ///< expected touchdown of `swings` [s]
  double support_duration = 0.0;  ///< of all feet, before the next step [s]
};

/// What a gait and its reactions see at a tick.
struct Situation {
  double time = 0.0;        ///< [s]
  double yaw = 0.0;         ///< reference of the torso [rad]
  const UserCommand& user;  ///< within the command limits
  const RobotState& state;
  const model::Dynamics& dynamics;
  const HierarchyOutcome& last;  ///< of the tick before
  const MotionPlan& before;      ///< of the tick before
  const Body& body;
  GaitStatus gait{};
  bool yields = false;                         ///< another gait waits for all feet down
  const PlannerOptions* next = &body.options;  ///< of what comes after this gait

  [[nodiscard]] int num_legs() const { return body.options.gait.num_legs(); }
  [[nodiscard]] const Vec3& foot(Leg leg) const { return dynamics.foot[index(leg)].p; }
  /// All feet, in contact or not, x and y in W [m].
  [[nodiscard]] PerLeg<Vec2> feet() const {
    PerLeg<Vec2> result(num_legs(), Vec2::Zero());
    for (const Leg k : body.legs.all()) result[index(k)] = foot(k).head<2>();
    return result;
  }
  /// An event of a leg, with the place of its foot and its normal force.
  [[nodiscard]] GaitEvent event(PlanEvent kind, Leg leg) const {
    return {.kind = kind,
            .leg = leg,
            .place = foot(leg),
            .force = body.plane.normal.dot(state.foot_force[index(leg)])};
  }
  /// A list of this event alone.
  [[nodiscard]] EventList event_list(PlanEvent kind, Leg leg) const {
    EventList result;
    result.add(event(kind, leg));
    return result;
  }
};

/// A swing that begins or continues.
struct SwingOrder {
  Leg leg = Leg::LF;
  SwingTarget target;
  bool keeps_deadline = false;  ///< keeps expected touchdown and COM plan
};

/// What a reaction requests; unset members request nothing. A reaction is a function of the
/// Situation, and only the gait carries out its action.
struct Action {
  EventList events{};
  std::optional<SwingMemory> memory{};  ///< new state of the swing
  std::optional<Leg> lands{};           ///< begins this foot's stance at its place
  std::optional<Leg> forgets_print{};   ///< deletes this foot's last print
  std::optional<Vec3> avoids{};         ///< no foothold near this place, in W [m]
  std::optional<Leg> reloads{};         ///< cancels this leg's lift-off
  PerLeg<bool> searches{};              ///< these feet search for ground from their places
  std::optional<SwingOrder> swing{};
  bool steps_out_of_turn = false;   ///< `swing` is a step that the gait did not plan
  std::optional<double> support{};  ///< time until the next lift-off [s]
  std::optional<bool> recovers{};   ///< the gait waits until the robot is at rest
  bool replans = false;             ///< plans the COM again
};

}  // namespace surefoot::gaits
