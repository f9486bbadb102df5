#pragma once

#include "surefoot/base/scale.hpp"
#include "surefoot/signals/leg.hpp"

#include <functional>
#include <memory>
#include <string>

namespace surefoot {
struct Group;
}  // namespace surefoot

namespace surefoot::gaits {

/// Where the knees point: the branch of each leg's inverse kinematics.
enum class KneeConfiguration {
  x,         ///< front knees backward, hind knees forward (ANYmal's usual stance)
  forward,   ///< all forward: for descending stairs
  backward,  ///< all backward: for climbing stairs
};

/// Nominal stance: feet relative to the torso's centre, in the control frame.
struct StanceOptions {
  double half_length = 0.36, half_width = 0.22, height = 0.46;
  KneeConfiguration knees = KneeConfiguration::x;
};

/// From the hind leg to the front one, first on the left side.
[[nodiscard]] PerLeg<Leg> usual_order(int num_legs);

/// Order and timing of the walk.
struct GaitOptions {
  PerLeg<Leg> order = usual_order(kNumLegs);
  double swing_duration = 0.5;
  double same_side_duration = 0.3, switch_duration = 0.6, start_duration = 1.0;

  [[nodiscard]] int num_legs() const { return static_cast<int>(order.size()); }
};

/// A gait whose legs step by a clock, as gaits/*.yaml give it. Each leg lifts off at its `offset`
/// in the cycle, and stands for its `duty`; both are shares of the period.
struct RhythmOptions {
  bool enabled = false;
  bool stands = false, flies = false;
  double speed_max = 3.0, chosen_to = 0.0;
  double period = 0.5;
  PerLeg<double> duty{0.55, 0.55, 0.55, 0.55};
  PerLeg<double> offset{0.0, 0.5, 0.5, 0.0};
  double sway = 1.0, pitch = 0.0, capture = 1.0, leash = 0.05, acceleration = 1.0;
  double wait = 0.15, stop_speed = 0.1;
  double integral_rate = 0.0, integral_max = 0.15;
  double rise = 0.0, crouch = 0.0, fast = 1.0;
};

/// Does the robot stand still before the first step of this gait? So it does where legs step one by
/// one, or in a cycle so long that two feet can't carry it in turn.
[[nodiscard]] bool begins_at_rest(const RhythmOptions& options, const Scale& scale);

/// Contact forces at phase changes, Eq. (30).
struct ForceOptions {
  double friction = 0.5;
  double min = 10.0, max = 400.0;
  double ramp_up = 0.10, ramp_down = 0.15;
  bool ramps = true;
};

/// Friction estimation from slip.
struct GripOptions {
  bool enabled = true;
  double friction_min = 0.2, share = 0.7, recovery = 0.05;
  double enough = 0.3, caution_max = 2.0;
};

/// Trajectory of the centre of mass: quintic Hermite splines from a QP with the ZMP in the support
/// region.
struct ComPlannerOptions {
  double zmp_margin = 0.02, rest_margin = 0.04;
  int horizon_steps = 2;
  double sample_interval = 0.12, leg_share = 0.76, terminal_weight = 1.0;
};

struct SwingOptions {
  double apex = 0.08, apex_known = 0.08;
  double horizontal_start = 0.15, horizontal_end = 0.85;
  double touchdown_speed = 0.2, search_speed = 0.0, search_depth_max = 0.30;
  double hip_height_min = 0.25, reach_max = 0.56;
  double speed_max = 1.4, armed_after = 0.5, lead = 0.0;
};

/// When a foot counts as down, as up, or as lost.
struct TouchdownOptions {
  double touchdown_force = 10.0, torque_error = 1.6, lift_off_force = 15.0;
  double stall_error = 0.003, bounce_speed = 0.06, bounce_force = 2.0, stall_force = 3.0;
  double lost_force = 2.0, lost_duration = 0.06;
};

/// The step reflex: a foot that hits an obstacle goes back, then higher and over it.
struct ReflexOptions {
  bool enabled = true;
  double force = 4.0, error = 0.03, hit_force = 20.0, duration = 0.02;
  double back = 0.04, beyond = 0.08;
  int most = 3;
};

/// Two-touch probing: a front foot first touches ahead of its foothold, to find edges.
struct ProbeOptions {
  bool enabled = false;
  double ahead = 0.045, tolerance = 0.015, lift = 0.02, beyond = 0.05, duration = 0.35;
};

/// How the friction pyramids' normal follows the plane through the footholds.
struct FrictionFrameOptions {
  double time_constant = 0.10, rate_max = 0.5;
};

/// How the torso follows the terrain.
struct TorsoOptions {
  double frequency = 7.5, max_tilt = 0.35;
  bool follow_terrain = true;
};

struct FootholdOptions {
  bool hind_use_front_prints = true;
  double print_radius = 0.08, same_height = 0.03;
  /// The plane through feet on two levels must not be extrapolated.
  bool bounded_by_feet = true;
  double max_step = 0.30, max_stride = 1e3, max_side_stride = 1e3;
  double stretch_max = 0.50, max_side_step = 0.22, void_radius = 0.06;
};

/// Turning on the spot before the first step, for the estimator's calibration.
struct CalibrationOptions {
  double duration = 0.0, settle = 0.5;
  double roll = 0.20, pitch = 0.15, yaw = 0.25;
};

/// Reactions of the walk to external forces.
struct PushOptions {
  bool enabled = true;
  double replan_step = 4.0, replan_interval = 0.03, settling_time = 0.2;
  double unsteady = 12.0, unsteady_share = 0.25, slow_shift = 0.1, lift_off_margin = 0.02;
  double foot_down_excess = 0.02, foot_down_duration = 0.15;
  bool steps = true;
  double step_margin = 0.03, step_duration = 0.2, step_apex = 0.04, step_max = 0.25;
  double capture_margin = 0.09, calm_margin = 0.06, zmp_margin = 0.02;
};

struct PlannerOptions {
  CalibrationOptions calibration;
  StanceOptions stance;
  GaitOptions gait;
  RhythmOptions rhythm;
  ForceOptions force;
  GripOptions grip;
  ComPlannerOptions com;
  SwingOptions swing;
  TouchdownOptions contact;
  ReflexOptions reflex;
  ProbeOptions probe;
  TorsoOptions torso;
  FrictionFrameOptions friction_frame;
  FootholdOptions foothold;
  PushOptions push;
};

class Gait;

/// Makes a gait of the user's own, of the planner's options in this gait, the period of the control
/// loop [s] and the robot's scale.
using GaitFactory =
    std::function<std::unique_ptr<Gait>(const PlannerOptions&, double period, const Scale& scale)>;

/// A gait that the user may change to, with all that the planner needs for it.
struct NamedGait {
  std::string name;
  PlannerOptions options;
  GaitFactory make = {};  ///< null: one of the library's
};

/// Gives options of four legs, or of six, the usual order and rhythm of this number.
void set_num_legs(PlannerOptions& options, int num_legs);

/// Names, units, ranges and help of the options.
[[nodiscard]] Group fields(PlannerOptions& o);

/// Does a leg probe?
[[nodiscard]] inline bool probes(const ProbeOptions& options, Leg leg) {
  return options.enabled && is_front(leg);
}
/// Is the ground's height known, as a hind foot steps in a front foot's print?
[[nodiscard]] inline bool knows_ground(const PlannerOptions& options, Leg leg) {
  return options.foothold.hind_use_front_prints && !is_front(leg);
}

}  // namespace surefoot::gaits
