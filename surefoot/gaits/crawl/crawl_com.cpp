// How the crawl leads the COM.
#include "surefoot/gaits/com_horizon.hpp"
#include "surefoot/gaits/crawl/crawl.hpp"
#include "surefoot/math/rotation.hpp"

#include <algorithm>

namespace surefoot {
namespace {

constexpr double kToCentre = 1.0;  // for the COM to come to the centre of the feet [s]
constexpr double kRecovery = 0.6;  // in which the COM of a pushed robot comes to rest [s]

}  // namespace

// The phases ahead: what is left of this one, then support and swing in turn over the horizon, with
// the footholds that are expected by then.
void Crawl::plan_com(const GaitTick& tick, Body& body) {
  ComHorizon ahead(tick, body, recovers_);
  const bool swings = state_ == CrawlState::swing;
  if (swings) ahead.add(std::max(deadline_ - tick.time, body.period), true);
  for (const Leg k : kLegs) {
    if (ahead.is_down(k)) continue;
    const bool is_next = swings && k == steps_.next();
    ahead.land(k, is_next ? body.legs[k].target().goal : tick.dynamics.foot[index(k)].p);
  }
  if (!tick.user.walk || recovers_ || has_lost(body)) {
    ahead.add(recovers_ ? kRecovery : kToCentre, recovers_);
    ahead.plan(Vec2::Zero(), true);
    return;
  }
  const double pace = body.pace(), cycle = steps_.cycle_duration(pace);
  for (int step = swings ? 1 : 0; step < body.options.com.horizon_steps; ++step) {
    const Leg k = steps_.next(step);
    const double support = step == 0 ? std::max(lift_time_ - tick.time, body.period)
                                     : steps_.support_duration(pace, step);
    ahead.add_support_until_lift_off(k, support);
    ahead.add(steps_.swing_duration(pace, k), true);
    ahead.land(k, body.footholds.foothold(k, ahead.feet(), body.plane, tick.yaw, tick.user, cycle));
  }
  ahead.add(steps_.support_duration(pace, body.options.com.horizon_steps), false);
  ahead.plan(rotation_about_z(tick.yaw).topLeftCorner<2, 2>() * tick.user.velocity);
}

}  // namespace surefoot
