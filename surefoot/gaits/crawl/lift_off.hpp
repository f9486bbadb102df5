#pragma once

#include "surefoot/gaits/body.hpp"
#include "surefoot/gaits/gait_tick.hpp"

namespace surefoot {

/// How a swing begins.
struct LiftOff {
  SwingTarget target;
  SwingMemory memory;
};

/// To the leg's next foothold; a leg that probes first touches ahead of it. `cycle_duration` of the
/// gait's steps [s].
[[nodiscard]] LiftOff plan_lift_off(Leg leg, const GaitTick& tick, const Body& body,
                                    double cycle_duration);

}  // namespace surefoot
