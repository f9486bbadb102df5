#pragma once

#include "surefoot/gaits/body.hpp"
#include "surefoot/gaits/gait_tick.hpp"

#include <limits>
#include <optional>

namespace surefoot {

/// What the gait that has the legs is about to do.
struct GaitStatus {
  std::optional<Leg> swings{};   ///< makes its step
  std::optional<Leg> unloads{};  ///< is about to lift off
  double lands_at =
      std::numeric_limits<double>::infinity();  ///< expected touchdown of `swings` [s]
  double support_duration = 0.0;                ///< all feet down before the next step [s]
};

/// What a reaction sees: the state, the dynamics, and the gait. A reaction is a function of it that
/// returns an Action, or nothing where there is nothing to react to.
struct Situation {
  const GaitTick& tick;
  const Body& body;
  GaitStatus gait;

  [[nodiscard]] const Vec3& foot(Leg leg) const { return tick.dynamics.foot[index(leg)].p; }
  /// Something that has happened to a leg: where its foot is, and with what force along the normal.
  [[nodiscard]] GaitEvent event(PlanEvent kind, Leg leg) const {
    return {.kind = kind,
            .leg = leg,
            .place = foot(leg),
            .force = body.plane.normal.dot(tick.state.foot_force[index(leg)])};
  }
};

}  // namespace surefoot
