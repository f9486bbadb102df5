#pragma once

#include "surefoot/base/scale.hpp"
#include "surefoot/estimation/terrain_plane.hpp"
#include "surefoot/gaits/parts/com_planner.hpp"
#include "surefoot/gaits/parts/foothold_planner.hpp"
#include "surefoot/gaits/parts/grip.hpp"
#include "surefoot/gaits/parts/leg_limits.hpp"
#include "surefoot/gaits/parts/leg_motion.hpp"
#include "surefoot/gaits/parts/push_balance.hpp"
#include "surefoot/signals/event_list.hpp"

namespace surefoot::gaits {

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
  /// `control_period` [s], `robot` is its scale.
  Body(const PlannerOptions& given, double control_period, const Scale& robot)
      : options(given),
        period(control_period),
        scale(robot),
        legs(given, control_period, robot),
        footholds(given.stance, given.foothold, robot),
        grip(given.grip, given.force.friction, control_period, robot),
        balance(given.push, control_period),
        com(given.com, given.force, robot) {}

  /// The terrain plane through the footholds.
  void fit_plane() {
    plane = estimation::fit_terrain_plane(legs.footholds(), options.torso.max_tilt, scale);
  }
  /// Nothing but the present footholds is known of the ground.
  void learn_ground() {
    footholds.forget();
    for (const Leg k : kLegs) footholds.remember(k, legs[k].foothold());
    fit_plane();
  }
  /// Of the gait's durations, longer where a foot has little friction: a factor. Accelerations fall
  /// with the square of the durations.
  [[nodiscard]] double pace() const { return std::sqrt(grip.caution()); }
  /// Of the COM over the plane, but no less than a plan can be made with [m].
  [[nodiscard]] double com_height(const model::Dynamics& dynamics) const {
    constexpr double kLeast = 0.1;  // [m]
    const Vec3& p = dynamics.com.p;
    return std::max(scale.length * kLeast, p.z() - plane.height(p.head<2>()));
  }

  PlannerOptions options;
  double period;
  Scale scale;
  Legs legs;
  FootholdPlanner footholds;
  estimation::TerrainPlane plane;
  Grip grip;
  PushBalance balance;
  ComPlanner com;
  SwingMemory swing;
  EventList events;     ///< of this tick
  int steps_taken = 0;  ///< swings that ended on the ground
};

}  // namespace surefoot::gaits
