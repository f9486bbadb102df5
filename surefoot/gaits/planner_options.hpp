#pragma once

#include "surefoot/signals/leg.hpp"

namespace surefoot {

/// Where the knees point: the side of each leg's inverse kinematics.
enum class KneeConfiguration {
  x,         ///< front knees backward, hind knees forward (ANYmal's usual stance)
  forward,   ///< all forward: the way downstairs
  backward,  ///< all backward: the way upstairs
};

/// Nominal stance: feet relative to the torso's centre, in the control frame.
struct StanceOptions {
  double half_length = 0.36;  ///< x of the front feet, −x of the hind feet [m]
  double half_width = 0.22;   ///< y of the left feet, −y of the right feet [m]
  double height = 0.46;       ///< base above the sphere centres of the feet [m]
  KneeConfiguration knees = KneeConfiguration::x;
};

/// Order and timing of the walk.
struct GaitOptions {
  /// For walking forward. Backward, the hind legs take the places of the front legs.
  PerLeg<Leg> order{Leg::LH, Leg::LF, Leg::RH, Leg::RF};
  double swing_duration = 0.5;      ///< lift-off to expected touchdown [s]
  double same_side_duration = 0.3;  ///< four feet down before a leg on the same side swings [s]
  double switch_duration = 0.6;     ///< four feet down before a leg on the other side swings [s]
  double start_duration = 1.0;      ///< four feet down before the first step [s]
};

/// Contact forces at phase changes, Eq. (30).
struct ForceOptions {
  double friction = 0.5;    ///< μ of the friction pyramid
  double min = 10.0;        ///< f_min of a loaded foot [N]
  double max = 400.0;       ///< f_max of a loaded foot, above the robot's weight [N]
  double ramp_up = 0.10;    ///< f_max from 0 to max after a touchdown [s]
  double ramp_down = 0.15;  ///< f_max from max to 0 before a lift-off [s]
  bool ramps = true;        ///< false: no modulation, for comparison
};

/// What is done about feet that slide.
struct GripOptions {
  bool enabled = true;
  double friction_min = 0.2;  ///< no foot is believed to have less
  double share = 0.7;         ///< of |f_t| / f_n at which a foot slides: believed afterwards
  double recovery = 0.05;     ///< toward force.friction, of a foot that doesn't slide [1/s]
  double enough = 0.3;        ///< with less than this under a foot the walk slows down …
  double caution_max = 2.0;   ///< … to at most so much less than commanded
};

/// Trajectory of the centre of mass: quintic Hermite splines from a QP with the ZMP in the support
/// region.
struct ComPlannerOptions {
  double zmp_margin = 0.02;  ///< ZMP inside the support region by [m]
  double rest_margin =
      0.04;               ///< capture point inside the swing's triangle by [m]: it may wait there
  int horizon_steps = 2;  ///< swings that the QP looks ahead, up to ComPlanner::kMaxSteps
  double sample_interval = 0.12;  ///< of the ZMP constraints [s]
  double leg_share = 0.76;        ///< of the weight, that one leg is planned to carry at most
  double terminal_weight = 1.0;   ///< pull of the horizon's end to the centre of the feet [1/s²]
};

struct SwingOptions {
  double apex = 0.08;              ///< height over the higher of start and goal [m]
  double apex_known = 0.08;        ///< the same for a hind foot that steps onto a footprint [m]
  double horizontal_start = 0.15;  ///< horizontal motion from this share of the swing …
  double horizontal_end = 0.85;    ///< … to this
  /// Downward, at the end of the swing and in the search [m/s]. A foot that comes down slowly is
  /// stopped by so little force, for so long, that its touch is told late.
  double touchdown_speed = 0.2;
  double search_depth_max = 0.30;  ///< below the expected ground [m]
  double hip_height_min =
      0.25;  ///< of the hip over the leg's last foothold: no search takes it further down [m]
  double reach_max =
      0.56;  ///< hip to foot that a swing foot is asked for: short of a straight leg [m]
  double speed_max =
      1.4;  ///< of a stride over its swing's duration; longer strides walk slower [m/s]
  double armed_after = 0.5;  ///< touchdown is believed after this share of the swing
};

/// When a foot counts as down, as up, or as lost.
struct TouchdownOptions {
  double touchdown_force = 10.0;  ///< a swinging foot that feels more has touched [N]
  /// The forces above hold where torques that are wrong by this make up less of a force; elsewhere,
  /// as with a leg nearly straight, all are larger in proportion [N·m].
  double torque_error = 1.6;
  double lift_off_force = 15.0;  ///< a foot that carries less may be lifted [N]
  double stall_error = 0.003;  ///< foot behind its reference by this, with at least stall_force [m]
  double bounce_speed = 0.06;  ///< … or faster upward, against its reference, than 10 ms ago [m/s]
  double bounce_force = 2.0;   ///< … while its force rises above what it was by this [N]
  double stall_force = 3.0;    ///< that a foot behind its reference must feel, too [N]
  double lost_force = 2.0;     ///< a loaded stance foot below this … [N]
  double lost_duration = 0.06;  ///< … for this long is lost [s]
};

/// The step reflex: a foot that rises or goes forward against something goes back, higher, and over
/// it.
struct ReflexOptions {
  bool enabled = true;
  double force =
      4.0;  ///< against the foot's motion; more where contact.torque_error hides it [N] …
  double error = 0.03;      ///< … and behind its reference along it by this [m] …
  double hit_force = 20.0;  ///< … or against it by this, however near the reference [N] …
  double duration = 0.02;   ///< … for this long [s]
  double back = 0.04;       ///< away from it, while the foot rises [m]
  double beyond = 0.08;     ///< it: no foothold nearer than this, or it stands on an edge [m]
  int most = 3;             ///< tries of one swing; then the foot comes down before it
};

/// Two-touch probing: a front foot first touches ahead of its foothold; an edge between is found
/// before the foot is loaded.
struct ProbeOptions {
  bool enabled = false;
  double ahead = 0.045;      ///< first touch ahead of the foothold [m]
  double tolerance = 0.015;  ///< same ground if within this of the leg's last foothold [m]
  double lift = 0.02;        ///< between the touches [m]
  double beyond = 0.05;      ///< other ground: land this much beyond the first touch [m]
  double duration = 0.35;    ///< of the second swing [s]
};

/// How the friction pyramids' normal follows the plane through the footholds.
struct FrictionFrameOptions {
  double time_constant = 0.10;  ///< [s]
  double rate_max = 0.5;        ///< [rad/s]
};

/// How the torso follows the terrain.
struct TorsoOptions {
  double frequency = 7.5;      ///< of the critically damped reference filter, third order [rad/s]
  double max_tilt = 0.35;      ///< of the reference [rad]
  bool follow_terrain = true;  ///< roll and pitch from the plane through the footholds
};

struct FootholdOptions {
  bool hind_use_front_prints = true;  ///< hind feet step where the front feet found ground
  double print_radius = 0.08;  ///< a footprint is used within this of the nominal foothold [m]
  double same_height = 0.03;  ///< footprints that differ by more than this have an edge between [m]
  /// The plane through feet on two levels says nothing of what lies beyond them: a front foot
  /// expects ground no higher than the feet stand, and above that only as its last stride rose.
  bool bounded_by_feet = true;
  double max_step = 0.30;        ///< [m]
  double max_stride = 1e3;       ///< that a command gets; more walks slower, beside max_step [m]
  double max_side_stride = 1e3;  ///< the same sideways, beside max_side_step [m]
  double stretch_max = 0.50;     ///< front and hind foot of a side may be further apart by this [m]
  double max_side_step = 0.22;   ///< a leg moves sideways about one hinge, its least agile [m]
  double void_radius = 0.06;  ///< no foothold nearer than this to where a foot found no ground [m]
};

/// Turning on the spot before the first step, for the estimator.
struct CalibrationOptions {
  double duration = 0.0;  ///< 0: none; a payload's height needs 3 s, and roll or pitch [s]
  double settle = 0.5;    ///< standing still before it [s]
  double roll = 0.20;     ///< amplitudes, under a window that rises and falls [rad]
  double pitch = 0.15;
  double yaw = 0.25;
};

/// What the walk does about forces that push or pull the robot.
struct PushOptions {
  bool enabled = true;
  double replan_step = 4.0;        ///< the COM is planned anew when the force moved by this [N]
  double replan_interval = 0.03;   ///< … but not more often [s]
  double settling_time = 0.2;      ///< of the filter that the force is compared with [s]
  double unsteady = 12.0;          ///< no lift-off while they differ by more [N] …
  double unsteady_share = 0.25;    ///< … and by more than this share of the force
  double slow_shift = 0.1;         ///< a force that moves the ZMP by this halves the velocity [m]
  double lift_off_margin = 0.02;   ///< capture point inside the other feet's triangle by [m]
  double foot_down_excess = 0.02;  ///< a foot comes down at once if the capture point would be out
                                   ///< of the other feet's triangle by this when it lands [m]
  double foot_down_duration = 0.15;  ///< of the way down [s]
  bool steps = true;           ///< with all feet down and the capture point leaving them, one steps
  double step_margin = 0.03;   ///< … when it is inside their region by less than this [m]
  double step_duration = 0.2;  ///< of that swing [s]
  double step_apex = 0.04;     ///< [m]
  double step_max = 0.25;      ///< how far a foot goes to catch the robot [m]
  double capture_margin = 0.09;  ///< … the capture point then inside the new region by this [m]
  double calm_margin = 0.06;  ///< the walk goes on when it is inside all feet's region by this [m]
  double zmp_margin = 0.02;   ///< … and until then the ZMP may come as near to its edges [m]
};

struct PlannerOptions {
  CalibrationOptions calibration;
  StanceOptions stance;
  GaitOptions gait;
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

/// Does a leg touch twice?
[[nodiscard]] inline bool probes(const ProbeOptions& options, Leg leg) {
  return options.enabled && is_front(leg);
}
/// A hind foot that steps into a front foot's print knows how high the ground is.
[[nodiscard]] inline bool knows_ground(const PlannerOptions& options, Leg leg) {
  return options.foothold.hind_use_front_prints && !is_front(leg);
}

}  // namespace surefoot
