#include "surefoot/gaits/parts/leg_motion.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::gaits {
namespace {

constexpr double kLongAgo = 1e3;               // [s]
constexpr double kCertainForceFactor = 2.0;    // of the touchdown force: needs no debouncing
constexpr int kDebounceTicks = 2;              // of a touchdown
constexpr double kArrivalPhase = 0.8;          // share of the swing after which it may end
constexpr double kMaxBounceDescent = 0.25;     // faster descents hide a bounce [m/s]
constexpr double kMinStoppedShare = 0.5;       // of the descent speed, which an impact removes
constexpr double kReboundSpeed = 0.25;         // upward [m/s]
constexpr double kReboundHeight = 0.005;       // above the touchdown point [m]
constexpr double kFlightSpeed = 0.6;           // of a foot that is airborne [m/s]
constexpr double kFlightDistance = 0.02;       // of such a foot from its touchdown point [m]
constexpr double kNoGroundDepth = 0.01;        // of such a foot below its touchdown point [m]
constexpr double kFlightWindow = 0.1;          // after the touchdown, in which it is noticed [s]
constexpr double kFreeSwingSpeed = 1.0;        // a faster foot in mid-swing has no contact [m/s]
constexpr double kFastSearch = 0.3;            // of a fall that no contact allows [m/s]
constexpr double kRisingSpeed = 0.1;           // a faster foot leaves the ground [m/s]
constexpr double kFreeFallShare = 0.6;         // of the asked descent: such a foot has no contact
constexpr double kMaxTrackingError = 0.04;     // along the ground [m]
constexpr double kMinReflexSpeed = 0.05;       // of the reference, for the step reflex [m/s]
constexpr double kMaxLag = 0.04;               // of a foot with weak or delayed drives [s]
constexpr double kSearchAcceleration = 30.0;   // when a search begins, at most [m/s²]
constexpr double kMinSearchTransition = 0.04;  // duration of this change of velocity [s]

}  // namespace

void LegMotion::plant(double time, const Vec3& p_WF, bool loaded) {
  phase_ = LegPhase::stance;
  begin_ = touchdown_time_ = loaded ? time - kLongAgo : time;
  lift_off_time_ = kNever;
  previous_foothold_ = foothold_;
  foothold_ = touchdown_point_ = p_WF;
  unloaded_for_ = 0.0;
}

void LegMotion::unload(double lift_off_time) {
  phase_ = LegPhase::unloading;
  lift_off_time_ = lift_off_time;
}

void LegMotion::reload(double time) { load_from(force_max(time), time); }

void LegMotion::use(const PlannerOptions& options, double time) {
  const double force = force_max(time);
  swing_ = options.swing;
  touchdown_ = options.contact;
  force_ = options.force;
  reflex_ = options.reflex;
  impact_ = ImpactDetector(touchdown_, period_, scale_);
  load_from(force, time);
}

// The ramp up starts at the present value of f_max, which therefore does not jump.
void LegMotion::load_from(double force_max, double time) {
  const double share = std::min(1.0, force_max / force_.max);
  const double along_ramp = 0.5 - std::sin(std::asin(1.0 - 2.0 * share) / 3.0);  // of smoothstep
  const double touchdown_time = touchdown_time_;
  plant(time - along_ramp * force_.ramp_up, foothold_);
  touchdown_time_ = touchdown_time;
}

void LegMotion::lift(double time, const SwingTarget& target) {
  phase_ = LegPhase::swing;
  begin_ = time;
  curve_ = SwingCurve(target, swing_, scale_);
  contact_ticks_ = 0;
  hit_ = false;
  impact_.begin();
  blocked_for_ = 0.0;
  search_ = {scale_};
}

// The largest acceleration of a spline between two velocities is 3/2 of its mean.
void LegMotion::search(double time, const Vec3& p_WF, const Vec3& v_WF, const Vec3& normal) {
  const Vec3 down = -search_speed() * normal;
  const double duration = std::max(scale_.time() * kMinSearchTransition,
                                   1.5 * (v_WF - down).norm() / kSearchAcceleration);
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
  foothold_ = seen.foot.p;  // the foot sphere rolls with the shank, by about a centimetre
  return observe_stance(time, seen);
}

// After a hard landing the estimated force lags, so motion decides. A foot that slid off an edge or
// never had contact is pressed down with f_min as a stance foot and moves away fast. A normal
// touchdown that only bounces, without going deeper, is kept; so is that of a fast search, which
// always bounces: searching again would make it hop on and on.
bool LegMotion::is_airborne(double time, const LegObservation& seen) const {
  if (since(time) > scale_.time() * kFlightWindow) return false;
  const Vec3 moved = seen.foot.p - touchdown_point_;
  const double up = seen.normal.dot(moved);
  const double length = scale_.length, speed = scale_.speed();
  const bool is_fast =
      seen.foot.v.norm() > speed * kFlightSpeed && moved.norm() > length * kFlightDistance;
  if (!curve_.target().straight || searches_fast())
    return is_fast && up < -(length * kNoGroundDepth);
  const bool rises =
      seen.normal.dot(seen.foot.v) > speed * kReboundSpeed && up > length * kReboundHeight;
  return is_fast || rises;
}

LegEvent LegMotion::observe_stance(double time, const LegObservation& seen) {
  if (is_airborne(time, seen)) {
    foothold_ = previous_foothold_;
    return LegEvent::airborne;
  }
  unloaded_for_ = normal_force_ < touchdown_.lost_force ? unloaded_for_ + period_ : 0.0;
  const bool expected_to_carry = phase_ == LegPhase::stance;
  return expected_to_carry && unloaded_for_ > touchdown_.lost_duration ? LegEvent::lost
                                                                       : LegEvent::none;
}

LegEvent LegMotion::observe_swing(double time, const LegObservation& seen) {
  const double t = since(time);
  const SwingTarget& target = curve_.target();
  if (t > target.duration && phase_ == LegPhase::swing) {
    // The search below the goal is useless for a foot that is elsewhere.
    if (is_off_track(time, seen.foot.p)) search(time, seen.foot.p, seen.foot.v, target.normal);
    phase_ = LegPhase::search;
  }
  if (is_caught(time, seen)) return LegEvent::caught;
  const bool rises = t < swing_.armed_after * target.duration;
  if (rises && phase_ == LegPhase::swing) return LegEvent::none;
  if (touches(time, seen)) return LegEvent::touchdown;
  return phase_ == LegPhase::search ? observe_search(time, seen.foot.p) : LegEvent::none;
}

// A nearly straight leg's torques hardly depend on the force along it.
double LegMotion::force_uncertainty() const {
  return std::max(1.0, force_per_torque_ * touchdown_.torque_error / touchdown_.touchdown_force);
}

Vec3 LegMotion::motion_direction(const Motion<Vec3>& asked) const {
  const Vec3& normal = curve_.target().normal;
  const Vec3 motion = asked.v - std::min(0.0, normal.dot(asked.v)) * normal;
  return motion.norm() > scale_.speed() * kMinReflexSpeed ? Vec3(motion.normalized())
                                                          : Vec3::Zero();
}

bool LegMotion::is_off_track(double time, const Vec3& p_WF) const {
  const Vec3& normal = curve_.target().normal;
  const Vec3 error = p_WF - reference(time).p;
  return (error - normal.dot(error) * normal).norm() > scale_.length * kMaxTrackingError;
}

// Contact during the descent is the ground, so only forward and upward motion counts here.
bool LegMotion::is_caught(double time, const LegObservation& seen) {
  if (!reflex_.enabled || phase_ != LegPhase::swing) return false;
  const Motion<Vec3> asked = reference(time);
  const Vec3 forward = motion_direction(asked);
  const double allowed = reflex_.error + kMaxLag * forward.dot(asked.v);
  const bool behind = forward.dot(asked.p - seen.foot.p) > allowed;
  const double against = -forward.dot(seen.force) / force_uncertainty();
  const bool held = behind && against > reflex_.force;
  const bool hit = against > reflex_.hit_force;
  blocked_for_ = held || hit ? blocked_for_ + period_ : 0.0;
  return blocked_for_ > reflex_.duration;
}

// What brakes a foot in contact is the estimated force; what moves a free one may look like it.
bool LegMotion::moves_freely(const Vec3& v_WF, double descent) const {
  if (phase_ != LegPhase::search) return v_WF.norm() > scale_.speed() * kFreeSwingSpeed;
  if (!searches_fast()) return false;
  const double falls = -curve_.target().normal.dot(v_WF);
  const bool as_asked = falls > kFreeFallShare * descent;
  return falls < -scale_.speed() * kRisingSpeed ||
         (descent > scale_.speed() * kFastSearch && as_asked);
}

// A foot may bounce off before its force or tracking error grows. Its velocity has then changed
// suddenly; drives and model errors change it slowly. Where a search is fast, a hit counts until
// the foot falls as asked again, for it may bounce up without any force.
bool LegMotion::has_bounced(const Motion<Vec3>& asked, const Vec3& v_WF, double force,
                            double brake) {
  const Vec3& normal = curve_.target().normal;
  const double descent = -normal.dot(asked.v), lag = normal.dot(v_WF - asked.v);
  const double stopped = std::max(touchdown_.bounce_speed, kMinStoppedShare * descent);
  const bool impact = impact_.is_impact(lag, stopped, force);
  hit_ = impact || (hit_ && searches_fast() && lag > stopped);
  const bool braked = impact_.is_braking(brake);
  const bool is_late = phase_ == LegPhase::search && searches_fast();
  return hit_ && !braked && (is_late || descent < scale_.speed() * kMaxBounceDescent);
}

// A foot pushed back more than up met a wall.
bool LegMotion::touches(double time, const LegObservation& seen) {
  const model::PointKinematics& foot = seen.foot;
  const Motion<Vec3> asked = reference(time);
  const Vec3& normal = curve_.target().normal;
  const double force = normal_force_ / force_uncertainty();
  const bool near = since(time) > kArrivalPhase * curve_.target().duration;
  const bool is_late = phase_ == LegPhase::search, arrives = near || is_late;
  const bool behind = normal.dot(foot.p - asked.p) > touchdown_.stall_error;
  const bool stalled = arrives && behind && force > touchdown_.stall_force;
  const double brake = normal.dot(asked.v - curve_.at(since(time)).v);
  const bool bounced = has_bounced(asked, foot.v, force, brake) && arrives;
  // In mid-swing a large tracking error comes from the drives, not from contact.
  const bool off_track = !arrives && is_off_track(time, foot.p);
  const bool may_be_free = is_late ? !bounced : !near;
  const bool is_free = may_be_free && moves_freely(foot.v, -normal.dot(asked.v));
  const bool pressed = force > touchdown_.touchdown_force && !off_track;
  const bool is_large = force > kCertainForceFactor * touchdown_.touchdown_force;
  const bool certain = is_large && !(is_late && is_free);
  const bool wall = reflex_.enabled && -motion_direction(asked).dot(seen.force) > normal_force_;
  const bool contact = !wall && !is_free && (pressed || stalled || bounced);
  contact_ticks_ = contact ? contact_ticks_ + 1 : 0;
  return !wall && (certain || contact_ticks_ >= kDebounceTicks);
}

// The reference waits for a foot that lags, and at the end of the leg's reach.
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
  plan.a_WF = reference(time + swing_.lead).a;
  return plan;
}

// Beyond the leg's reach ρ the reference is projected onto the sphere of radius ρ around the hip:
// d/dt (ρ e) = ρ/r (1 − e eᵀ) ṙ, with r from hip to foot and e its direction. Close to the straight
// leg the knee's speed would diverge, and the torques would not show the force along the leg. What
// moves back into reach keeps its radial part, or its velocity would jump where it arrives.
Motion<Vec3> LegMotion::reference(double time) const {
  Motion<Vec3> result = curve_.at(since(time));
  result.v *= search_.pace;
  if (curve_.target().straight) result.a *= search_.pace;
  const Vec3 r = result.p - hip_;
  const double length = r.norm(), reach = swing_.reach_max;
  if (length <= reach) return result;
  const Vec3 e = r / length;
  const Vec3 relative = result.v - hip_velocity_;
  Mat3 kept = reach / length * (Mat3::Identity() - e * e.transpose());
  if (e.dot(relative) < 0.0) kept += e * e.transpose();
  result.p = hip_ + reach * e;
  result.v = hip_velocity_ + kept * relative;
  result.a = kept * result.a;
  return result;
}

}  // namespace surefoot::gaits
