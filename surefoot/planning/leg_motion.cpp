#include "surefoot/planning/leg_motion.hpp"

#include "surefoot/math/smoothstep.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot {
namespace {

constexpr double kLongAgo = 1e3;  // [s]
constexpr double kCertain = 2.0;  // times the touchdown force: an impact, needs no second look
constexpr int kFirmTicks = 2;     // debounce of a touchdown
constexpr double kReferenceLead = 0.02;  // the search waits for a foot further behind than this [m]
constexpr double kUnreachableAfter = 0.3;  // [s]

}  // namespace

void LegMotion::plant(double time, const Vec3& p_WF, bool loaded) {
  phase_ = LegPhase::stance;
  begin_ = loaded ? time - kLongAgo : time;
  lift_off_time_ = std::numeric_limits<double>::infinity();
  foothold_ = p_WF;
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
  curve_ = SwingCurve(target, swing_);
  firm_ticks_ = 0;
  stuck_for_ = 0.0;
}

void LegMotion::search(double time, const Vec3& p_WF, const Vec3& normal) {
  lift(time, {p_WF, p_WF, normal, period_, 0.0});
  phase_ = LegPhase::search;
}

LegEvent LegMotion::observe(double time, const Vec3& p_WF, const Vec3& force, const Vec3& normal) {
  normal_force_ = normal.dot(force);
  if (!down()) return observe_swing(time, p_WF);
  foothold_ = p_WF;  // the sphere rolls with its shank: the foothold wanders by a centimetre
  return observe_stance();
}

LegEvent LegMotion::observe_stance() {
  light_for_ = normal_force_ < touchdown_.lost_force ? light_for_ + period_ : 0.0;
  const bool expected_to_carry = phase_ == LegPhase::stance;
  return expected_to_carry && light_for_ > touchdown_.lost_duration ? LegEvent::lost
                                                                    : LegEvent::none;
}

LegEvent LegMotion::observe_swing(double time, const Vec3& p_WF) {
  const double t = since(time);
  const SwingTarget& target = curve_.target();
  if (t > target.duration) phase_ = LegPhase::search;
  if (t < swing_.armed_after * target.duration) return LegEvent::none;
  const double behind = target.normal.dot(p_WF - curve_.at(t).p);
  const bool pressed = normal_force_ > touchdown_.touchdown_force;
  const bool stalled = behind > touchdown_.stall_error && normal_force_ > touchdown_.stall_force;
  const bool certain = normal_force_ > kCertain * touchdown_.touchdown_force;
  firm_ticks_ = pressed || stalled ? firm_ticks_ + 1 : 0;
  if (certain || firm_ticks_ >= kFirmTicks) return LegEvent::touchdown;
  if (phase_ != LegPhase::search) return LegEvent::none;
  if (behind > kReferenceLead) {
    begin_ += period_;
    stuck_for_ += period_;
  } else {
    stuck_for_ = std::max(0.0, stuck_for_ - period_);
  }
  const double depth = target.normal.dot(target.goal - curve_.at(since(time)).p);
  const bool unreachable = stuck_for_ > kUnreachableAfter || depth > swing_.search_depth_max;
  return unreachable ? LegEvent::unreachable : LegEvent::none;
}

double LegMotion::force_max(double time) const {
  if (!down()) return 0.0;
  if (!force_.ramps) return force_.max;
  const double up = smooth_ramp(since(time), force_.ramp_up);
  const double down_again = smooth_ramp(lift_off_time_ - time, force_.ramp_down);
  return force_.max * std::min(up, down_again);
}

FootPlan LegMotion::plan(double time) const {
  FootPlan plan;
  plan.phase = phase_;
  plan.force_max = force_max(time);
  plan.force_min = std::min(force_.min, plan.force_max);
  plan.p_WF = foothold_;
  if (down()) return plan;
  const Motion<Vec3> reference = curve_.at(since(time));
  plan.p_WF = reference.p;
  plan.v_WF = reference.v;
  plan.a_WF = reference.a;
  return plan;
}

}  // namespace surefoot
