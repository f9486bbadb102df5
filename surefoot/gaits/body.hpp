#pragma once

#include "surefoot/estimation/terrain_plane.hpp"
#include "surefoot/gaits/gait_tick.hpp"
#include "surefoot/gaits/parts/com_planner.hpp"
#include "surefoot/gaits/parts/foothold_planner.hpp"
#include "surefoot/gaits/parts/grip.hpp"
#include "surefoot/gaits/parts/legs.hpp"
#include "surefoot/gaits/parts/push_balance.hpp"
#include "surefoot/gaits/planner_options.hpp"
#include "surefoot/signals/event_list.hpp"

namespace surefoot {

/// What the swing that goes on, or the last one, has met.
struct SwingMemory {
  bool probes = false;           ///< it makes its first touch
  bool lands_anywhere = false;   ///< it is to stand wherever it touches
  int times_caught = 0;          ///< on its way
  Vec2 caught_at{0.0, 0.0};      ///< for the first time, x and y in W [m]
  int collisions = 0;            ///< with something above the ground that it knows
  Vec3 foothold = Vec3::Zero();  ///< behind the first touch, in W [m]
  Vec2 direction{1.0, 0.0};      ///< of the step, unit

  /// As a swing begins.
  [[nodiscard]] SwingMemory begun() const {
    return {.caught_at = caught_at, .foothold = foothold, .direction = direction};
  }
};

/// What every gait stands and walks with: the gait that has the legs changes it, reactions read it.
struct Body {
  /// `weight` of the robot [N]; `period` of the control loop [s].
  Body(const PlannerOptions& options, double weight, double period);

  /// The terrain plane through the footholds.
  void fit_plane();
  /// Nothing but the present footholds is known of the ground.
  void learn_ground();
  /// One tick of the friction that the feet find. True if one began or ceased to slide: it stands
  /// elsewhere than it did.
  [[nodiscard]] bool observe_grip(const GaitTick& tick);
  /// Of the gait's durations, longer where a foot has little friction: a factor.
  [[nodiscard]] double pace() const;
  /// Of the COM over the plane, but no less than a plan can be made with [m].
  [[nodiscard]] double com_height(const Dynamics& dynamics) const;
  /// Does the load, or where the COM has gone, ask for a new COM plan?
  [[nodiscard]] bool wants_plan(const GaitTick& tick) const;

  PlannerOptions options;
  double period;
  Legs legs;
  FootholdPlanner footholds;
  TerrainPlane plane;
  Grip grip;
  PushBalance balance;
  ComPlanner com;
  SwingMemory swing;
  EventList events;     ///< of this tick
  int steps_taken = 0;  ///< swings that ended on the ground
};

}  // namespace surefoot
