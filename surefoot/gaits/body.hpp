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

/// What has happened in the present swing, or the last one.
struct SwingMemory {
  bool probes = false;           ///< before the first touch of a probing foot
  bool lands_anywhere = false;   ///< stands at the first contact, without reactions
  int times_caught = 0;          ///< on an obstacle
  Vec2 caught_at{0.0, 0.0};      ///< place of the first catch, x and y in W [m]
  int collisions = 0;            ///< above known ground
  Vec3 foothold = Vec3::Zero();  ///< target after the first touch, in W [m]
  Vec2 direction{1.0, 0.0};      ///< of the step, unit

  /// The memory of a swing that begins.
  [[nodiscard]] SwingMemory for_new_swing() const {
    return {.caught_at = caught_at, .foothold = foothold, .direction = direction};
  }
};

/// State that all gaits share: the active gait changes it, reactions read it.
struct Body {
  /// `control_period` [s], `robot`: its scale.
  Body(const PlannerOptions& given, double control_period, const Scale& robot)
      : options(given),
        period(control_period),
        scale(robot),
        legs(given, control_period, robot),
        footholds(given.stance, given.foothold, robot),
        grip(given.grip, given.force.friction, control_period, robot, given.gait.num_legs()),
        balance(given.push, control_period),
        com(given.com, given.force, robot) {}

  /// Goes on with other options, as another gait has them. All feet are down.
  void use(const PlannerOptions& given, double time) {
    options = given;
    for (const Leg k : legs.all()) legs[k].use(given, time);
    footholds.use(given.stance, given.foothold);
    com.use(given.force);
    grip.use(given.grip, given.force.friction);
  }
  /// Fits the terrain plane to the footholds.
  void fit_plane() {
    plane = estimation::fit_terrain_plane(legs.footholds(), options.torso.max_tilt, scale);
  }
  /// Forgets all of the ground but the present footholds.
  void learn_ground() {
    footholds.forget();
    for (const Leg k : legs.all()) footholds.remember(k, legs[k].foothold());
    fit_plane();
  }
  /// Factor ≥ 1 on the gait's durations for low friction; accelerations fall with its square.
  [[nodiscard]] double pace() const { return std::sqrt(grip.caution()); }
  /// Height of the COM over the plane, limited to what a plan needs [m].
  [[nodiscard]] double com_height(const model::Dynamics& dynamics) const {
    constexpr double kMinHeight = 0.1;  // [m]
    const Vec3& p = dynamics.com.p;
    return std::max(scale.length * kMinHeight, p.z() - plane.height(p.head<2>()));
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
