#include "surefoot/gaits/parts/leg_motion.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::gaits {
namespace {

constexpr double kLongAgo = 1e3;       // [s]
constexpr double kCertain = 2.0;       // times the touchdown force: an impact, needs no second look
constexpr int kFirmTicks = 2;          // debounce of a touchdown
constexpr double kArrivesFrom = 0.8;   // share of a swing from which on its end is near
constexpr double kFastDescent = 0.25;  // too fast for its velocity to be told from a bounce [m/s]
constexpr double kStopped = 0.5;       // share of a foot's descent that an impact takes, at least
constexpr double kRebound = 0.25;      // a foot that rises faster stands on nothing [m/s] …
constexpr double kOffGround = 0.005;   // … higher than this over where it came down [m] …
constexpr double kFlight = 0.6;        // nor does one that goes anywhere so fast [m/s] …
constexpr double kBelow = 0.01;        // deeper than where it came down there was no ground [m]
constexpr double kFliesOn = 1.0;       // a foot in mid-swing this fast has met nothing [m/s]
constexpr double kAway = 0.02;         // … so far from there [m] …
constexpr double kFliesWithin = 0.1;   // … so soon after that [s]
constexpr double kAstray = 0.04;       // beside its reference by more, a foot could not follow [m]
constexpr double kGoes = 0.05;  // a foot that is asked to go faster than this can be caught [m/s]
constexpr double kLag = 0.04;   // weak or delayed drives let a foot be as late as this [s]
constexpr double kSearchBrake = 30.0;  // of a foot that begins to search [m/s²], which takes …
constexpr double kSearchTurn = 0.04;   // … as long as this at least [s]

}  // namespace

void LegMotion::plant(double time, const Vec3& p_WF, bool loaded) {
  phase_ = LegPhase::stance;
  begin_ = loaded ? time - kLongAgo : time;
  lift_off_time_ = kNever;
  stood_ = foothold_;
  foothold_ = landed_ = p_WF;
  light_for_ = 0.0;
}

void LegMotion::unload(double lift_off_time) {
  phase_ = LegPhase::unloading;
  lift_off_time_ = lift_off_time;
}

// The ramp up goes on from where the ramp down has come to: f_max does not jump.
void LegMotion::reload(double time) {
  const double share = force_max(time) / force_.max;
  const double along_ramp = 0.5 - std::sin(std::asin(1.0 - 2.0 * share) / 3.0);  // of smoothstep
  plant(time - along_ramp * force_.ramp_up, foothold_);
}

void LegMotion::lift(double time, const SwingTarget& target) {
  phase_ = LegPhase::swing;
  begin_ = time;
  curve_ = SwingCurve(target, swing_, scale_);
  firm_ticks_ = 0;
  impact_.begin();
  held_for_ = 0.0;
  search_ = {scale_};
}

// From the velocity it has to that of the search, evenly: the largest acceleration of such a spline
// is 3/2 of its mean.
void LegMotion::search(double time, const Vec3& p_WF, const Vec3& v_WF, const Vec3& normal) {
  const Vec3 down = -swing_.touchdown_speed * normal;
  const double duration =
      std::max(scale_.time() * kSearchTurn, 1.5 * (v_WF - down).norm() / kSearchBrake);
  lift(time, {.start = p_WF,
              .goal = p_WF + 0.5 * duration * (v_WF + down),
              .normal = normal,
              .duration = duration,
              .straight = true,
              .velocity = v_WF});
  phase_ = LegPhase::search;
}

LegEvent LegMotion::observe(double time, const LegObservation& seen) {
  hip_ = seen.hip.p;
  hip_velocity_ = seen.hip.v;
  normal_force_ = seen.normal.dot(seen.force);
  force_per_torque_ = seen.force_per_torque;
  if (!down()) return observe_swing(time, seen);
  foothold_ = seen.foot.p;  // the sphere rolls with its shank: the foothold wanders by a centimetre
  return observe_stance(time, seen);
}

// After a hard landing the estimated force lags and says little; the foot's way says more. So it
// does where a foot slid off an edge, or was never down: as a foot that stands it is pressed down
// with the least force, and flies off. (One that came down in its own time and isn't deeper now
// bounces, and is pressed down again.)
bool LegMotion::flies(double time, const LegObservation& seen) const {
  if (since(time) > scale_.time() * kFliesWithin) return false;
  const Vec3 moved = seen.foot.p - landed_;
  const double up = seen.normal.dot(moved);
  const double length = scale_.length, speed = scale_.speed();
  const bool goes = seen.foot.v.norm() > speed * kFlight && moved.norm() > length * kAway;
  if (!curve_.target().straight) return goes && up < -(length * kBelow);
  const bool rises = seen.normal.dot(seen.foot.v) > speed * kRebound && up > length * kOffGround;
  return goes || rises;
}

LegEvent LegMotion::observe_stance(double time, const LegObservation& seen) {
  if (flies(time, seen)) {
    foothold_ = stood_;
    return LegEvent::flew;
  }
  light_for_ = normal_force_ < touchdown_.lost_force ? light_for_ + period_ : 0.0;
  const bool expected_to_carry = phase_ == LegPhase::stance;
  return expected_to_carry && light_for_ > touchdown_.lost_duration ? LegEvent::lost
                                                                    : LegEvent::none;
}

LegEvent LegMotion::observe_swing(double time, const LegObservation& seen) {
  const double t = since(time);
  const SwingTarget& target = curve_.target();
  if (t > target.duration && phase_ == LegPhase::swing) {
    // The way down from the goal is of no use to a foot that is not there.
    if (strays(time, seen.foot.p)) search(time, seen.foot.p, seen.foot.v, target.normal);
    phase_ = LegPhase::search;
  }
  if (is_caught(time, seen)) return LegEvent::caught;
  const bool rises = t < swing_.armed_after * target.duration;
  if (rises && phase_ == LegPhase::swing) return LegEvent::none;
  if (touches(time, seen)) return LegEvent::touchdown;
  return phase_ == LegPhase::search ? observe_search(time, seen.foot.p) : LegEvent::none;
}

// Where the leg is nearly straight its torques say little of the force along it.
double LegMotion::doubt() const {
  return std::max(1.0, force_per_torque_ * touchdown_.torque_error / touchdown_.touchdown_force);
}

Vec3 LegMotion::way(const Motion<Vec3>& asked) const {
  const Vec3& normal = curve_.target().normal;
  const Vec3 going = asked.v - std::min(0.0, normal.dot(asked.v)) * normal;
  return going.norm() > scale_.speed() * kGoes ? Vec3(going.normalized()) : Vec3::Zero();
}

bool LegMotion::strays(double time, const Vec3& p_WF) const {
  const Vec3& normal = curve_.target().normal;
  const Vec3 error = p_WF - reference(time).p;
  return (error - normal.dot(error) * normal).norm() > scale_.length * kAstray;
}

// What meets the foot on its way down is the ground, so only its ways forward and up count here.
bool LegMotion::is_caught(double time, const LegObservation& seen) {
  if (!reflex_.enabled || phase_ != LegPhase::swing) return false;
  const Motion<Vec3> asked = reference(time);
  const Vec3 forward = way(asked);
  const double allowed = reflex_.error + kLag * forward.dot(asked.v);
  const bool behind = forward.dot(asked.p - seen.foot.p) > allowed;
  const double against = -forward.dot(seen.force) / doubt();
  const bool held = behind && against > reflex_.force;
  const bool hit = against > reflex_.hit_force;
  held_for_ = held || hit ? held_for_ + period_ : 0.0;
  return held_for_ > reflex_.duration;
}

// A foot that meets ground bounces: it is off the ground again before it presses or stays behind
// its reference, but its velocity has changed at once, where drives and a robot that is not as
// modelled change it little by little. What pushes a foot back more than up is a wall.
bool LegMotion::touches(double time, const LegObservation& seen) {
  const model::PointKinematics& foot = seen.foot;
  const Motion<Vec3> asked = reference(time);
  const Vec3& normal = curve_.target().normal;
  const double force = normal_force_ / doubt();
  const bool near = since(time) > kArrivesFrom * curve_.target().duration;
  const bool arrives = near || phase_ == LegPhase::search;
  const bool behind = normal.dot(foot.p - asked.p) > touchdown_.stall_error;
  const bool stalled = arrives && behind && force > touchdown_.stall_force;
  const double descent = -normal.dot(asked.v);
  const double stopped = std::max(touchdown_.bounce_speed, kStopped * descent);
  const bool jolted = impact_.is_jolted(normal.dot(foot.v - asked.v), stopped, force);
  const bool braked = impact_.brakes(normal.dot(asked.v - curve_.at(since(time)).v));
  const bool bounced = arrives && jolted && !braked && descent < scale_.speed() * kFastDescent;
  // What drags a foot off its way in the middle of a swing are its own drives.
  const bool astray = !arrives && strays(time, foot.p);
  // One that flies on has met nothing: what is felt is what brakes it.
  const bool flies_on = !arrives && foot.v.norm() > scale_.speed() * kFliesOn;
  const bool pressed = force > touchdown_.touchdown_force && !astray && !flies_on;
  const bool certain = force > kCertain * touchdown_.touchdown_force;
  const bool wall = reflex_.enabled && -way(asked).dot(seen.force) > normal_force_;
  const bool firm = !wall && (pressed || stalled || bounced);
  firm_ticks_ = firm ? firm_ticks_ + 1 : 0;
  return !wall && (certain || firm_ticks_ >= kFirmTicks);
}

// The reference waits for a foot that stays behind, and at the end of the leg's reach.
LegEvent LegMotion::observe_search(double time, const Vec3& p_WF) {
  const SwingTarget& target = curve_.target();
  const double behind = target.normal.dot(p_WF - reference(time).p);
  const double reach_left = swing_.reach_max - (p_WF - hip_).norm();
  search_.update(behind, reach_left, period_);
  begin_ += (1.0 - search_.pace) * period_;
  const double depth = target.normal.dot(target.goal - curve_.at(since(time)).p);
  const bool deeper = target.normal.dot(foothold_ - p_WF) > search_.reference_lead();
  const bool low = deeper && target.normal.dot(hip_ - foothold_) < swing_.hip_height_min;
  const bool unreachable = search_.is_stuck() || depth > swing_.search_depth_max || low;
  return unreachable ? LegEvent::unreachable : LegEvent::none;
}

double LegMotion::force_max(double time) const {
  return down() ? ramped_force_max(force_, since(time), lift_off_time_ - time) : 0.0;
}

FootPlan LegMotion::plan(double time) const {
  FootPlan plan;
  plan.phase = phase_;
  plan.force_max = force_max(time);
  plan.force_min = std::min(force_.min, plan.force_max);
  plan.p_WF = foothold_;
  if (down()) return plan;
  const Motion<Vec3> asked = reference(time);
  plan.p_WF = asked.p;
  plan.v_WF = asked.v;
  plan.a_WF = asked.a;
  return plan;
}

// The curve, as far as the leg reaches: beyond, the reference stays on the sphere of radius ρ
// around the hip, where d/dt (ρ e) = ρ/r (1 − e eᵀ) ṙ with r from hip to foot and e its direction.
// A leg that is asked to be straight turns its knee ever faster, and its torques say nothing about
// the force along it.
Motion<Vec3> LegMotion::reference(double time) const {
  Motion<Vec3> result = curve_.at(since(time));
  result.v *= search_.pace;
  if (curve_.target().straight) result.a *= search_.pace;
  const Vec3 r = result.p - hip_;
  const double length = r.norm(), reach = swing_.reach_max;
  if (length <= reach) return result;
  const Vec3 e = r / length;
  const Mat3 on_sphere = reach / length * (Mat3::Identity() - e * e.transpose());
  result.p = hip_ + reach * e;
  result.v = hip_velocity_ + on_sphere * (result.v - hip_velocity_);
  result.a = on_sphere * result.a;
  return result;
}

}  // namespace surefoot::gaits
