#include "surefoot/gaits/planner.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/math/disc.hpp"
#include "surefoot/math/rotation.hpp"
#include "surefoot/model/leg_jacobian.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace surefoot {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kGrace = 0.04;  // a touchdown this late is still on time [s]
constexpr double kLate = 0.10;   // … and this late worth telling: noticing one takes 50 ms [s]
constexpr double kWaitDuration = 0.8;  // how far ahead the COM is planned while a foot searches [s]
constexpr double kRecovery = 0.6;      // in which the COM of a pushed robot comes to rest [s]
constexpr double kOnTime = 0.05;       // a lift-off later than this needs a new COM plan [s]
constexpr double kLeastHeight = 0.1;   // of the COM over the plane [m]
constexpr double kLiftOffPatience = 0.3;  // before a lift-off is given up [s]
constexpr double kTiltGivenUp = 20.0;     // more of a shortfall than on all feet [rad/s²]

/// |n · (Jᵀ)⁻¹|: of the normal force by the leg's torques.
double force_per_torque(const PointKinematics& foot, Leg leg, const Vec3& normal) {
  return (damped_inverse(leg_jacobian(foot, leg)) * normal).norm();
}

/// The gait goes from leg to leg until it comes to the one that is looked for.
const PlannerOptions& checked(const PlannerOptions& options) {
  const PerLeg<Leg>& order = options.gait.order;
  for (const Leg k : kLegs) {
    if (std::ranges::count(order, k) == 1) continue;
    throw Error("gait.order has " + std::string(kLegNames[index(k)]) + " " +
                std::to_string(std::ranges::count(order, k)) +
                " times; it must have each of LF, RF, LH, RH once");
  }
  return options;
}

}  // namespace

Planner::Planner(const PlannerOptions& options, double weight, double period)
    : options_(checked(options)),
      period_(period),
      com_planner_(options.com, options.force, weight),
      balance_(options.push, period),
      foothold_planner_(options.stance, options.foothold),
      torso_(options.torso, period),
      friction_frame_(options.friction_frame, period),
      grip_(options.grip, options.force.friction, period),
      calibration_(options.calibration),
      legs_{LegMotion(options.swing, options.contact, options.force, period, options.reflex),
            LegMotion(options.swing, options.contact, options.force, period, options.reflex),
            LegMotion(options.swing, options.contact, options.force, period, options.reflex),
            LegMotion(options.swing, options.contact, options.force, period, options.reflex)} {}

void Planner::begin_anew(const Planner& fresh) {
  const int steps_taken = steps_taken_;
  *this = fresh;
  steps_taken_ = steps_taken;
}

const MotionPlan& Planner::update(const UserCommand& command, const RobotState& state,
                                  const Dynamics& dynamics, const HierarchyOutcome& last) noexcept {
  time_ = state.time;
  last_ = last;
  event_ = PlanEvent::none;
  if (!initialised_) calibration_.expect_switch(command.calibrate);  // it begins so anyway
  if (!initialised_ || restarts_) initialise(state, dynamics);
  calibration_.update(time_, command.calibrate, is_undisturbed(state));
  walked_ = within_strides(as_planned(command));
  UserCommand user = within_height(with_caution(walked_));
  user.height = slowly(user.height);
  user.walk = user.walk && !calibration_.is_due();
  user.yaw_rate *= turning_share(user.yaw_rate);
  yaw_rate_ = user.walk && !waits() ? user.yaw_rate : 0.0;
  yaw_ += period_ * yaw_rate_;
  observe_legs(user, state, dynamics);
  if (learns_ground_ && !calibration_.is_going_on()) learn_ground();
  observe_grip(user, state, dynamics);
  react_to_push(user, state, dynamics);
  advance(user, dynamics);
  note_rest(state);
  if (event_ == PlanEvent::none) event_ = calibration_.take_end();
  restarts_ = calibration_.is_wanted() && event_ == PlanEvent::none && is_at_rest(state);
  if (restarts_) event_ = PlanEvent::calibration;
  tell_limits();
  if (event_ == PlanEvent::none) event_ = calibration_.take_waiting();
  write_plan(user);
  return plan_;
}

void Planner::initialise(const RobotState& state, const Dynamics& dynamics) {
  initialised_ = learns_ground_ = true;
  restarts_ = false;
  calibration_.begin(time_);
  yaw_ = surefoot::yaw(state.R_WB());
  for (const Leg k : kLegs) {
    leg(k).plant(time_, dynamics.foot[index(k)].p, true);
    const Vec3 hip = rotation_about_z(-yaw_) * (dynamics.hip[index(k)].p - state.p_WB);
    hips_[index(k)] = hip.head<2>();
  }
  learn_ground();
  friction_frame_.restart(plane_.normal);
  torso_.restart(state);
  replan_com(UserCommand{}, dynamics);
}

// An estimate that begins anew has other places for the same feet, and others again when it is
// calibrated.
void Planner::learn_ground() {
  learns_ground_ = learns_ground_ && calibration_.is_going_on();
  foothold_planner_.forget();
  for (const Leg k : kLegs) foothold_planner_.remember(k, leg(k).foothold());
  plane_ = fit_terrain_plane(footholds(), options_.torso.max_tilt);
}

void Planner::observe_legs(const UserCommand& user, const RobotState& state,
                           const Dynamics& dynamics) {
  for (const Leg k : kLegs) {
    const std::size_t i = index(k);
    const LegObservation seen{
        .hip = {dynamics.hip[i].p, dynamics.hip[i].v, Vec3::Zero()},
        .foot = {dynamics.foot[i].p, dynamics.foot[i].v, Vec3::Zero()},
        .force = state.foot_force[i],
        .normal = plane_.normal,
        .force_per_torque = force_per_torque(dynamics.foot[i], k, plane_.normal)};
    switch (leg(k).observe(time_, seen)) {
      case LegEvent::none:
        break;
      case LegEvent::touchdown:
        on_touchdown(k, user, dynamics);
        break;
      case LegEvent::caught:
        on_caught(k, user, dynamics);
        break;
      case LegEvent::unreachable:
        on_unreachable(k, user, dynamics);
        break;
      case LegEvent::lost:
        on_lost(k, user, dynamics);
        break;
      case LegEvent::flew:
        on_flight(k, user, dynamics);
        break;
    }
  }
}

void Planner::advance(const UserCommand& user, const Dynamics& dynamics) {
  switch (mode_) {
    case Mode::stand:
      if (user.walk && all_down()) {
        begin_support(user, options_.gait.start_duration);
        replan_com(user, dynamics);
      }
      break;
    case Mode::support:
      advance_support(user, dynamics);
      break;
    case Mode::swing:
      if (probing_) reach_beyond_edge(next_leg(), user, dynamics);
      if (time_ >= late_time_) {
        event_ = PlanEvent::late;
        late_time_ = kInfinity;
      }
      if (time_ >= deadline_ + kGrace) {
        deadline_ = time_ + kWaitDuration;
        replan_com(user, dynamics);
      }
      break;
  }
}

void Planner::advance_support(const UserCommand& user, const Dynamics& dynamics) {
  LegMotion& next = leg(next_leg());
  if (waits()) {
    lift_time_ = std::max(lift_time_, time_ + support_duration());
    return;
  }
  if (next.phase() == LegPhase::stance) {
    if (!user.walk) {
      mode_ = Mode::stand;
      replan_com(user, dynamics);
    } else if (time_ >= lift_time_ - options_.force.ramp_down) {
      if (lets_another_leg_go_first(user, dynamics)) return;
      tilt_shortfall_on_four_ = last_.tilt_shortfall;
      next.unload(lift_time_);
    }
    return;
  }
  const bool holds =
      !(last_.tilt_shortfall > tilt_shortfall_on_four_ + kTiltGivenUp);  // nor if NaN
  if (holds && time_ < lift_time_) return;
  const bool unloaded = next.unloaded() || !options_.force.ramps;
  if (holds && unloaded && balanced_without(next_leg(), dynamics)) {
    lift_off(next_leg(), user, dynamics);
  } else if (!holds || time_ > lift_time_ + kLiftOffPatience) {
    event_ = PlanEvent::lift_off_aborted;
    next.reload(time_);
    begin_support(user, options_.gait.switch_duration);
    replan_com(user, dynamics);
  }
}

void Planner::begin_swing() {
  mode_ = Mode::swing;
  collisions_ = caught_ = 0;
  probing_ = emergency_ = false;
}

void Planner::lift_off(Leg k, const UserCommand& user, const Dynamics& dynamics) {
  event_ = PlanEvent::lift_off;
  begin_swing();
  const Vec3& p_WF = dynamics.foot[index(k)].p;
  probe_target_ = foothold_planner_.foothold(k, footholds(), plane_, yaw_, user, cycle_duration());
  Vec3 goal = probe_target_;
  probing_ = probes(k);
  if (probing_) {
    const Vec2 heading(std::cos(yaw_), std::sin(yaw_));
    const Vec2 step = (goal - p_WF).head<2>();
    probe_direction_ = step.norm() > kLeastWay ? step.normalized() : heading;
    goal.head<2>() += options_.probe.ahead * probe_direction_;
    goal.z() = foothold_planner_.expected_height(k, goal.head<2>(), footholds(), plane_);
  }
  const double duration = pace() * options_.gait.swing_duration;
  goal.head<2>() = within_reach(k, goal, duration, dynamics);
  const double apex = knows_ground(k) ? options_.swing.apex_known : options_.swing.apex;
  leg(k).lift(time_, {p_WF, goal, plane_.normal, duration, apex});
  const bool on_time = time_ - lift_time_ < kOnTime;
  expect_touchdown(swing_duration(k));
  if (!on_time) replan_com(user, dynamics);
  take_up();
}

// Of the hip as it will be then: nearly straight, a leg neither feels the ground nor stands on it.
// Above lower ground the hip comes down with the torso.
Vec2 Planner::within_reach(Leg k, const Vec3& goal, double duration,
                           const Dynamics& dynamics) const {
  const Vec2 shift = com_planner_.at(time_ + duration).p - dynamics.com.p.head<2>();
  const Vec3& hip = dynamics.hip[index(k)].p;
  const double height = std::min(hip.z() - goal.z(), options_.stance.height);
  return nearest_within(goal.head<2>(), hip.head<2>() + shift, horizontal_reach(height));
}

double Planner::horizontal_reach(double height) const {
  const double reach = options_.swing.reach_max;
  return std::sqrt(std::max(0.0, reach * reach - height * height));
}

void Planner::expect_touchdown(double duration) {
  deadline_ = time_ + duration;
  late_time_ = deadline_ + kLate;
}

void Planner::begin_support(const UserCommand& user, double duration) {
  backward_ = user.velocity.x() < 0.0;
  mode_ = Mode::support;
  lift_time_ = time_ + duration;
}

double Planner::com_height(const Dynamics& dynamics) const {
  const Vec3& com = dynamics.com.p;
  return std::max(kLeastHeight, com.z() - plane_.height(com.head<2>()));
}

SupportPhase Planner::present_phase(const Dynamics& dynamics) const {
  const Vec2 com = dynamics.com.p.head<2>();
  const double ground = plane_.height(com);
  const PerLeg<Vec3> feet = footholds();
  SupportPhase phase;
  phase.lifts_in.fill(kInfinity);
  if (recovering_ || balance_.is_pushed()) phase.zmp_margin_max = options_.push.zmp_margin;
  for (const Leg k : kLegs) {
    phase.feet[index(k)] = feet[index(k)].head<2>();
    phase.heights[index(k)] = feet[index(k)].z() - ground;
    phase.down[index(k)] = leg(k).down();
    phase.loaded_for[index(k)] = leg(k).down() ? leg(k).since(time_) : 0.0;
    phase.hips[index(k)] = dynamics.hip[index(k)].p.head<2>() - com;
    phase.reach[index(k)] = horizontal_reach(dynamics.hip[index(k)].p.z() - feet[index(k)].z());
  }
  return phase;
}

// The phases ahead: what is left of this one, then support and swing in turn over the horizon, with
// the footholds that are expected by then.
void Planner::replan_com(const UserCommand& user, const Dynamics& dynamics) {
  const Vec2 com = dynamics.com.p.head<2>();
  const Motion<Vec2> begin{com, dynamics.com.v.head<2>(), plan_.com.a};
  const double ground = plane_.height(com), height = com_height(dynamics);
  PerLeg<Vec3> feet = footholds();
  SupportPhase phase = present_phase(dynamics);
  const auto add = [&](double duration, bool must_rest) {
    phase.duration = duration;
    phase.must_rest = must_rest;
    com_planner_.add(phase);
    for (double& loaded : phase.loaded_for) loaded += duration;
    for (double& lifts : phase.lifts_in) lifts -= duration;
  };
  const auto land = [&](Leg k, const Vec3& foothold) {
    feet[index(k)] = foothold;
    phase.feet[index(k)] = foothold.head<2>();
    phase.heights[index(k)] = foothold.z() - ground;
    phase.down[index(k)] = true;
    phase.loaded_for[index(k)] = 0.0;
    phase.lifts_in[index(k)] = kInfinity;
  };

  com_planner_.weigh(kGravity * dynamics.mass);
  com_planner_.bear(balance_.load());
  com_planner_.stand_on(mean_friction(), yaw_);
  balance_.planned(time_);
  com_planner_.clear();
  const bool swings = mode_ == Mode::swing;
  if (swings) add(std::max(deadline_ - time_, period_), true);
  for (const Leg k : kLegs) {
    const bool is_next = swings && k == next_leg();
    if (!phase.down[index(k)]) land(k, is_next ? leg(k).target().goal : dynamics.foot[index(k)].p);
  }
  if (mode_ == Mode::stand || !user.walk || recovering_ || has_lost()) {
    add(recovering_ ? kRecovery : kStandDuration, recovering_);
    com_planner_.plan(time_, begin, height, Vec2::Zero(), true);
    return;
  }
  for (int step = swings ? 1 : 0; step < options_.com.horizon_steps; ++step) {
    const Leg k = next_leg(step);
    const bool begun = step == 0;
    const double duration = begun ? std::max(lift_time_ - time_, period_) : support_duration(step);
    phase.lifts_in[index(k)] = duration;
    add(duration, false);
    phase.down[index(k)] = false;
    add(swing_duration(k), true);
    land(k, foothold_planner_.foothold(k, feet, plane_, yaw_, user, cycle_duration()));
  }
  add(support_duration(options_.com.horizon_steps), false);
  const Vec2 velocity = rotation_about_z(yaw_).topLeftCorner<2, 2>() * user.velocity;
  com_planner_.plan(time_, begin, height, velocity);
}

void Planner::write_plan(const UserCommand& user) {
  plan_.time = time_;
  for (const Leg k : kLegs) {
    plan_.feet[index(k)] = leg(k).plan(time_);
    plan_.feet[index(k)].friction = grip_.friction(k);
  }
  plan_.com = com_planner_.at(time_);
  plan_.com_zmp_slack = com_planner_.zmp_slack();
  torso_.update(plane_, yaw_, yaw_rate_, plan_.com, options_.stance.height + user.height,
                calibration_.motion());
  plan_.torso = torso_.plan();
  friction_frame_.update(plane_.normal);
  plan_.R_WC = control_frame(friction_frame_.normal(), yaw_);
  plan_.terrain_point = plane_.point;
  plan_.calibration = calibration_.stage();
  plan_.event = static_cast<int>(event_);
}

void Planner::go_on_with(Leg k) {
  while (next_leg() != k) cursor_ = (cursor_ + 1) % kNumLegs;
}

Leg Planner::next_leg(int ahead) const {
  const Leg k = options_.gait.order[static_cast<std::size_t>((cursor_ + ahead) % kNumLegs)];
  return backward_ ? same_side(k) : k;
}

double Planner::support_duration(int ahead) const {
  const bool same_side = is_left(next_leg(ahead)) == is_left(next_leg(ahead + kNumLegs - 1));
  return pace() * (same_side ? options_.gait.same_side_duration : options_.gait.switch_duration);
}

double Planner::swing_duration(Leg k) const {
  return pace() * options_.gait.swing_duration + (probes(k) ? options_.probe.duration : 0.0);
}

double Planner::cycle_duration() const {
  double sum = 0.0;
  for (int i = 0; i < kNumLegs; ++i) sum += support_duration(i) + swing_duration(next_leg(i));
  return sum;
}

bool Planner::has_lost() const {
  return std::ranges::any_of(kLegs, [this](Leg k) {
    const bool swings = mode_ == Mode::swing && k == next_leg();
    return !swings && !leg(k).down();
  });
}

bool Planner::waits() const {
  return mode_ == Mode::stand || (mode_ == Mode::support && (!all_down() || recovering_));
}

bool Planner::all_down() const {
  return std::all_of(legs_.begin(), legs_.end(), [](const LegMotion& l) { return l.down(); });
}

PerLeg<Vec3> Planner::footholds() const {
  PerLeg<Vec3> result;
  for (const Leg k : kLegs) result[index(k)] = leg(k).foothold();
  return result;
}

}  // namespace surefoot
