#pragma once

#include "surefoot/gaits/body.hpp"

#include <optional>

namespace surefoot {

/// A leg that goes, or goes on, through the air.
struct SwingOrder {
  Leg leg = Leg::LF;
  SwingTarget target;
  bool keeps_deadline = false;  ///< its touchdown is expected when it was, and the COM plan stays
};

/// What a reaction asks for. What is not set asks for nothing. The gait that has the legs carries
/// it out: legs and ground by `carry_out`, its own times by itself.
struct Action {
  EventList events{};
  std::optional<Leg> lands{};          ///< this foot stands where it is
  std::optional<Leg> forgets_print{};  ///< there was no ground where this foot came down last
  std::optional<Vec3> avoids{};        ///< no foothold near this place, in W [m]
  std::optional<Leg> reloads{};        ///< this leg, about to lift off, carries again
  PerLeg<bool> searches{};             ///< these feet look for ground from where they are
  std::optional<SwingOrder> swing{};
  std::optional<SwingMemory> memory{};  ///< of the swing, from now on
  bool steps_out_of_turn = false;       ///< `swing` is a step that the gait did not plan
  std::optional<double> support{};      ///< time until the next lift-off, counted from now [s]
  std::optional<bool> recovers{};       ///< the gait waits until the robot has come to rest
  bool replans = false;                 ///< the COM's way is planned anew
};

/// What it says about legs, ground and the swing, and its events.
void carry_out(const Action& action, const GaitTick& tick, Body& body);

}  // namespace surefoot
