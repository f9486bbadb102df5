#pragma once

#include "surefoot/estimation/terrain_plane.hpp"
#include "surefoot/gaits/parts/calibration_schedule.hpp"
#include "surefoot/gaits/parts/capture_step.hpp"
#include "surefoot/gaits/parts/com_planner.hpp"
#include "surefoot/gaits/parts/foothold_planner.hpp"
#include "surefoot/gaits/parts/friction_frame.hpp"
#include "surefoot/gaits/parts/grip.hpp"
#include "surefoot/gaits/parts/leg_motion.hpp"
#include "surefoot/gaits/parts/push_balance.hpp"
#include "surefoot/gaits/parts/torso_reference.hpp"
#include "surefoot/gaits/planner_options.hpp"
#include "surefoot/model/dynamics.hpp"
#include "surefoot/signals/hierarchy_outcome.hpp"
#include "surefoot/signals/motion_plan.hpp"
#include "surefoot/signals/plan_event.hpp"
#include "surefoot/signals/robot_state.hpp"
#include "surefoot/signals/user_command.hpp"

namespace surefoot {

/// The walk: one leg after the other in the gait's order, the COM led through the support regions
/// by a ZMP plan, the torso along the plane through the footholds. A foot that meets no ground goes
/// on down while the gait waits. Plans relative to the footholds; nothing depends on where the
/// world's origin lies.
class Planner {
 public:
  /// `weight` of the robot [N]; `period` of the control loop [s]. Throws Error unless the gait's
  /// order has each leg once.
  Planner(const PlannerOptions& options, double weight, double period);

  /// One tick. Allocates nothing, throws nothing.
  const MotionPlan& update(const UserCommand& command, const RobotState& state,
                           const Dynamics& dynamics, const HierarchyOutcome& last = {}) noexcept;

  /// Before an update: a plan that knows what `fresh` does, which has not begun; but for the steps
  /// taken.
  void begin_anew(const Planner& fresh);

  /// Between two ticks: the friction that every foot is believed to find from now on. Throws Error
  /// unless it is above 0.
  void set_friction(double friction);

  /// Before an update: does the calibration that has just ended know the legs and what the robot
  /// carries? Only one that was disturbed and doesn't is repeated.
  void tell_calibration_known(bool known) { calibration_.tell_known(known); }

  /// Unit normal of the terrain as believed, in W, through the filter of the friction frame: it
  /// lags, and jumps only where a calibration begins the plan anew.
  [[nodiscard]] const Vec3& terrain_normal() const { return friction_frame_.normal(); }
  [[nodiscard]] int steps_taken() const { return steps_taken_; }
  /// Is the estimate to begin anew before the next update, and the plan with it? As the user asked,
  /// or after a calibration that was disturbed, once all feet stand and nothing has moved for 1 s.
  [[nodiscard]] bool restarts() const { return restarts_; }
  /// May a calibration listen? By the last plan all feet stand, none slides, and nobody pushes. A
  /// payload, which pushes downward, is what it listens to.
  [[nodiscard]] bool is_undisturbed(const RobotState& state) const;

 private:
  enum class Mode { stand, support, swing };

  static constexpr double kStandDuration =
      1.0;                                   // for the COM to come to the centre of the feet [s]
  static constexpr double kLevel = 1e-3;     // apex of a move that does not rise [m]
  static constexpr double kLeastWay = 0.02;  // a step that is shorter has no direction [m]

  void initialise(const RobotState& state, const Dynamics& dynamics);
  void tell_limits();
  void note_rest(const RobotState& state);
  [[nodiscard]] bool is_at_rest(const RobotState& state) const;
  /// Of the command's velocities, that legs can follow.
  [[nodiscard]] double feasible_share(const UserCommand& user, double cycle_duration) const;
  /// The command with a velocity that the legs can follow.
  [[nodiscard]] UserCommand within_strides(const UserCommand& user);
  /// The command with the velocities that this step is planned with: in a stand as commanded.
  [[nodiscard]] UserCommand as_planned(const UserCommand& user);
  /// The next step's are as near to the command as it may change those that are walked.
  void take_up();
  [[nodiscard]] bool is_taken_up() const {
    return velocity_ == commanded_.velocity && turn_ == commanded_.yaw_rate;
  }
  /// The command with a height that strides, sway and a calibration leave to the legs.
  [[nodiscard]] UserCommand within_height(const UserCommand& user);
  /// On the way to a height [m].
  [[nodiscard]] double slowly(double height);
  /// Of the commanded yaw rate, until the next step.
  [[nodiscard]] double turning_share(double yaw_rate) const;
  /// Hips about the footholds' centre, in heading axes: the torso leans against a push.
  [[nodiscard]] PerLeg<Vec2> leaning_hips() const;
  /// How long the feet stay as they are, by the gait's time [s].
  [[nodiscard]] double until_switch() const;
  void observe_legs(const UserCommand& user, const RobotState& state, const Dynamics& dynamics);
  void observe_grip(const UserCommand& user, const RobotState& state, const Dynamics& dynamics);
  /// The command, slower where a foot has little friction or the robot leans against a push.
  [[nodiscard]] UserCommand with_caution(const UserCommand& user) const;
  /// Of the gait's durations, longer where a foot has little friction: a factor.
  [[nodiscard]] double pace() const;
  void on_touchdown(Leg leg, const UserCommand& user, const Dynamics& dynamics);
  /// A front foot's first touch: goes back or beyond.
  void continue_probe(Leg leg, const Vec3& p_WF);
  void reach_beyond_edge(Leg leg, const UserCommand& user, const Dynamics& dynamics);
  void swing_again(Leg leg, const SwingTarget& target, const UserCommand& user,
                   const Dynamics& dynamics);
  bool hit_above_known_ground(Leg leg, const UserCommand& user, const Dynamics& dynamics);
  void on_caught(Leg leg, const UserCommand& user, const Dynamics& dynamics);
  /// Is this touch, after the foot was caught, the edge of what caught it?
  [[nodiscard]] bool touches_the_edge(const Vec3& p_WF) const;
  void on_unreachable(Leg leg, const UserCommand& user, const Dynamics& dynamics);
  void learn_ground();
  void on_flight(Leg leg, const UserCommand& user, const Dynamics& dynamics);
  void on_lost(Leg leg, const UserCommand& user, const Dynamics& dynamics);
  void react_to_push(const UserCommand& user, const RobotState& state, const Dynamics& dynamics);
  void put_foot_down(Leg leg, const UserCommand& user, const Dynamics& dynamics);
  /// A step to recover, if one helps: of the foot after which the robot is balanced best.
  void step_to_recover(const UserCommand& user, const Dynamics& dynamics);
  /// Where a foot that lands after a time catches the robot.
  [[nodiscard]] CaptureStep capture_step(Leg leg, double duration, const Dynamics& dynamics) const;
  /// Will the balance be lost before the swinging foot lands by itself?
  [[nodiscard]] bool tips_before_landing(const Dynamics& dynamics) const;
  /// Can the drives move a foot like that?
  [[nodiscard]] bool is_agile(const SwingTarget& target) const;
  /// Has a robot that was pushed come to rest, well inside its feet, under a force that stays?
  [[nodiscard]] bool is_calm(const Dynamics& dynamics) const;
  void advance(const UserCommand& user, const Dynamics& dynamics);
  void advance_support(const UserCommand& user, const Dynamics& dynamics);
  void begin_swing();
  /// Where the other feet's triangle is too thin to swing the next leg: another leg goes first, if
  /// one can and that widens it.
  [[nodiscard]] bool lets_another_leg_go_first(const UserCommand& user, const Dynamics& dynamics);
  void lift_off(Leg leg, const UserCommand& user, const Dynamics& dynamics);
  /// A foothold, not further from the hip than the leg reaches when the foot lands.
  [[nodiscard]] Vec2 within_reach(Leg leg, const Vec3& goal, double duration,
                                  const Dynamics& dynamics) const;
  /// How far a leg reaches along the ground with its hip at a height over it [m].
  [[nodiscard]] double horizontal_reach(double height) const;
  void expect_touchdown(double duration);
  /// Of the feet where they are.
  [[nodiscard]] SupportRegion region(const PerLeg<double>& share, const Dynamics& dynamics) const;
  [[nodiscard]] SupportRegion region_without(Leg leg, const Dynamics& dynamics) const;
  /// Of the capture point in the region of all feet, as if all of them stood [m].
  [[nodiscard]] double balance_margin(const Dynamics& dynamics) const;
  [[nodiscard]] bool balanced_without(Leg leg, const Dynamics& dynamics) const;
  void begin_support(const UserCommand& user, double duration);
  /// Of the COM over the plane, but no less than a plan can be made with [m].
  [[nodiscard]] double com_height(const Dynamics& dynamics) const;
  /// The feet as they are now, for the COM planner.
  [[nodiscard]] SupportPhase present_phase(const Dynamics& dynamics) const;
  void replan_com(const UserCommand& user, const Dynamics& dynamics);
  void write_plan(const UserCommand& user);

  /// Of the feet that stand.
  [[nodiscard]] double mean_friction() const;
  [[nodiscard]] Leg next_leg(int ahead = 0) const;
  /// The gait's order goes on from this leg.
  void go_on_with(Leg leg);
  [[nodiscard]] double support_duration(int ahead = 0) const;
  [[nodiscard]] double swing_duration(Leg leg) const;
  [[nodiscard]] double cycle_duration() const;
  [[nodiscard]] bool probes(Leg leg) const { return options_.probe.enabled && is_front(leg); }
  /// A hind foot that steps into a front foot's print knows how high the ground is.
  [[nodiscard]] bool knows_ground(Leg leg) const {
    return options_.foothold.hind_use_front_prints && !is_front(leg);
  }
  /// A foot that should stand looks for ground.
  [[nodiscard]] bool has_lost() const;
  /// The gait goes on later: it stands, a lost foot searches, or a pushed robot comes to rest.
  [[nodiscard]] bool waits() const;
  [[nodiscard]] bool all_down() const;
  [[nodiscard]] PerLeg<Vec3> footholds() const;
  [[nodiscard]] LegMotion& leg(Leg which) { return legs_[index(which)]; }
  [[nodiscard]] const LegMotion& leg(Leg which) const { return legs_[index(which)]; }

  PlannerOptions options_;
  double period_;
  ComPlanner com_planner_;
  PushBalance balance_;
  FootholdPlanner foothold_planner_;
  TorsoReference torso_;
  FrictionFrame friction_frame_;
  Grip grip_;
  CalibrationSchedule calibration_;
  PerLeg<LegMotion> legs_;
  TerrainPlane plane_;
  MotionPlan plan_;

  PerLeg<Vec2> hips_{};         // about the torso's centre, in heading axes
  bool learns_ground_ = false;  // once more, as soon as the calibration is over
  bool initialised_ = false;
  bool slows_ = false, slowed_ = false;    // strides too short for the velocity; that it was told
  bool lowers_ = false, lowered_ = false;  // legs too short for the height; that it was told
  bool raises_ = false, raised_ = false;   // legs too bent for it; that it was told
  double time_ = 0.0;
  bool restarts_ = false;
  double stands_from_ = 0.0;           // on all feet [s]
  double rests_from_ = 0.0;            // without going anywhere [s]
  UserCommand commanded_, walked_;     // that is asked for, and with strides that legs can make
  Vec2 velocity_{0.0, 0.0};            // that this step is planned with [m/s]
  double turn_ = 0.0;                  // the same, of the yaw rate [rad/s]
  double height_ = kNaN;               // of the torso, beside the stance's [m]
  double yaw_ = 0.0, yaw_rate_ = 0.0;  // of the heading that the torso is to have
  Mode mode_ = Mode::stand;
  int cursor_ = 0;         // place of the next leg in the gait's order
  bool backward_ = false;  // the gait's order is mirrored, fore and hind
  HierarchyOutcome last_;
  double tilt_shortfall_on_four_ = 0.0;  // before the next leg began to unload: more of it
                                         // is the torso let go, as the others can't carry it
  double lift_time_ = 0.0;               // planned lift-off of the next leg [s]
  double deadline_ = 0.0;     // expected touchdown of the swinging leg; later the gait waits [s]
  double late_time_ = 0.0;    // when a missing touchdown is told [s]
  bool probing_ = false;      // the swinging foot makes its first touch
  bool emergency_ = false;    // it is to stand wherever it touches
  bool recovering_ = false;   // after a push or a slip: the gait waits until it is balanced
  int caught_ = 0;            // times that this swing was caught on its way
  Vec2 caught_at_{0.0, 0.0};  // where it was first
  int collisions_ = 0;        // of this swing with something above the ground that it knows
  Vec3 probe_target_ = Vec3::Zero();  // the foothold behind the first touch
  Vec2 probe_direction_{1.0, 0.0};
  int steps_taken_ = 0;
  PlanEvent event_ = PlanEvent::none;
};

}  // namespace surefoot
