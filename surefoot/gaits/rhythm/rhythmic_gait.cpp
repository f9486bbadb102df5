#include "surefoot/gaits/rhythm/rhythmic_gait.hpp"

#include "surefoot/math/rotation.hpp"
#include "surefoot/math/smoothstep.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::gaits {
namespace {

constexpr double kJustLifted = 0.04;  // a swing that can end where it began [s]
constexpr double kMaxSpread = 0.03;   // of the feet over their stance, mean over the legs [m]
constexpr double kSameTime = 0.02;    // between touchdowns of feet that step together [s]
constexpr double kMaxOff = 0.06;      // of the capture point where a gait ends [m]

/// Is the next stance so much wider or longer that a gait for wide feet should not begin in this?
bool is_wider(const StanceOptions& next, const StanceOptions& stance, const Scale& scale) {
  return std::max(next.half_width - stance.half_width, next.half_length - stance.half_length) >
         scale.length * kMaxSpread;
}

Vec2 middle(const Situation& now) {
  Vec2 result = Vec2::Zero();
  for (const Vec2& foot : now.feet()) result += foot / now.num_legs();
  return result;
}

double pendulum_rate(const Situation& now) {
  return std::sqrt(kGravity / now.body.com_height(now.dynamics));
}

}  // namespace

void RhythmicGait::begin(Situation& now, Body& body, const std::optional<Action>& first) {
  integral_ = {};
  if (begins_at_rest(options_, body.scale)) {
    com_.start(middle(now), Vec2::Zero());
  } else {
    com_.start(now.before.com.p, now.before.com.v);
  }
  stance_ = body.options.stance;
  gathers_ = !begins_at_rest(options_, body.scale) && is_spread(now);
  start_clock(now, body);
  waited_ = 0.0;
  stops_ = false;
  if (first) act(*first, now, body);
}

RhythmOptions RhythmicGait::gathering(const PlannerOptions& options) {
  PlannerOptions trot;
  set_num_legs(trot, options.gait.num_legs());
  RhythmOptions result = options.rhythm;
  result.offset = trot.rhythm.offset;
  result.duty = per_leg(0.5, options.gait.num_legs());
  return result;
}

// Three feet of a slow gait can't hold a COM that does not sway yet: it goes to its place while the
// clock waits.
void RhythmicGait::start_clock(const Situation& now, const Body& body) {
  clock_ = PhaseClock(gathers_ ? gathering_ : options_);
  const Leg first = first_leg(now, body);
  const double ramp = body.options.force.ramp_down;
  const double stance = std::max(ramp, clock_.stance_duration(first));
  sways_only_ = !gathers_ && !pushes_off() && begins_at_rest(options_, body.scale);
  double stands_for = ramp;
  grows_for_ = options_.period;
  if (pushes_off()) {
    stands_for = grows_for_ = stance;
  } else if (sways_only_) {
    stands_for = ramp + body.period;
    grows_for_ = 0.5 * stance;
  }
  clock_.start(stands_for, first);
  begin_ = now.time;
  sway(now);
}

// Of feet that take turns some would stand for a whole cycle.
bool RhythmicGait::pushes_off() const {
  const auto differs = [&](double offset) { return offset != options_.offset[0]; };
  const bool jumps = options_.flies && std::ranges::none_of(options_.offset, differs);
  return !gathers_ && (jumps || options_.pitch > 0.0);
}

// A body over one foot far from its middle, as in a pace with the feet of a trot, would tip.
bool RhythmicGait::is_spread(const Situation& now) const {
  const StanceOptions& stance = now.body.options.stance;
  const Mat2 R = rotation_about_z(-now.yaw).topLeftCorner<2, 2>();
  Vec2 extent = Vec2::Zero();
  const int num_legs = now.num_legs();
  for (const Leg k : now.body.legs.all()) {
    const Vec2 nominal = nominal_offset(stance, k, num_legs);
    extent += nominal.cwiseSign().cwiseProduct(R * now.foot(k).head<2>()) / num_legs;
    extent -= nominal.cwiseAbs() / num_legs;
  }
  return extent.maxCoeff() > now.body.scale.length * kMaxSpread;
}

// Of the legs that have stood longest, each with those that lift off with it, the first in a cycle.
Leg RhythmicGait::first_leg(const Situation& now, const Body& body) const {
  const PerLeg<double>& offset = (gathers_ ? gathering_ : options_).offset;
  const auto stood = [&](Leg k) {
    double result = clock_.stance_duration(k);
    for (const Leg other : body.legs.all()) {
      if (offset[index(other)] == offset[index(k)])
        result = std::min(result, body.legs[other].stood(now.time));
    }
    return result;
  };
  return *std::ranges::max_element(body.legs.all(), [&](Leg a, Leg b) {
    const double difference = stood(a) - stood(b);
    if (std::abs(difference) > body.scale.time() * kSameTime) return difference < 0.0;
    return offset[index(a)] > offset[index(b)];
  });
}

double RhythmicGait::stride_duration(double) const {
  return options_.period * *std::ranges::max_element(options_.duty);
}

// A foot without ground goes on searching.
std::optional<Action> RhythmicGait::answer(LegEvent event, const Situation& now, Leg k) const {
  switch (event) {
    case LegEvent::touchdown:
      return Action{.events = now.event_list(PlanEvent::touchdown, k), .lands = k};
    case LegEvent::lost:
    case LegEvent::airborne: {
      const bool flew = event == LegEvent::airborne;
      return Action{.events = now.event_list(PlanEvent::lost_contact, k),
                    .forgets_print = flew ? std::optional(k) : std::nullopt,
                    .searches = searches_for(k, flew, now)};
    }
    default:
      return {};
  }
}

// Legs that have lifted off relying on a foot that flew come down again.
PerLeg<bool> RhythmicGait::searches_for(Leg lost, bool flew, const Situation& now) const {
  PerLeg<bool> result(now.num_legs(), false);
  result[index(lost)] = true;
  if (!flew || clock_.until_landing(lost) >= 0.0) return result;
  for (const Leg k : now.body.legs.all()) {
    const LegMotion& leg = now.body.legs[k];
    const bool just_lifted = leg.since(now.time) < now.body.scale.time() * kJustLifted;
    if (leg.phase() == LegPhase::swing && just_lifted) result[index(k)] = true;
  }
  return result;
}

void RhythmicGait::follow(const Action& action, const Situation&, Body& body) {
  if (action.lands) ++body.steps_taken;
  const bool comes_down = std::ranges::count(action.searches, true) > 1;
  if (action.forgets_print && comes_down)
    clock_.return_to_landing(*action.forgets_print, body.options.force.ramp_down);
}

GaitOutcome RhythmicGait::go_on(Situation& now, Body& body) {
  drive_com(now);
  stops_ = stops(now);
  if (stops_ && body.legs.all_down()) return go_on_from_stop(now, body);
  sways_only_ = sways_only_ && now.time < begin_ + grows_for_;
  if (!sways_only_) advance_clock(body);
  sway(now);
  for (const Leg k : body.legs.all()) move_leg(k, now, body);
  return {.begins_step =
              std::ranges::any_of(body.legs.all(), [&](Leg k) { return clock_.lifts(k); })};
}

bool RhythmicGait::stops(const Situation& now) const {
  if (gathers_) return now.time > begin_ + gathering_.period;
  if (!now.yields && (now.user.walk || !(stops_ || is_slow(now)))) return false;
  if (stops_ || is_wider(now.next->stance, stance_, now.body.scale)) return true;
  return (now.body.legs.all_down() || is_about_to_lift(now.body)) && is_poised(now);
}

GaitOutcome RhythmicGait::go_on_from_stop(const Situation& now, Body& body) {
  const bool ends = now.yields || !now.user.walk;
  const StanceOptions& next = ends ? now.next->stance : body.options.stance;
  const bool fits = !is_wider(next, stance_, body.scale);
  for (const Leg k : body.legs.all()) {
    if (body.legs[k].phase() == LegPhase::unloading) body.legs[k].reload(now.time);
  }
  if (ends && fits && (!gathers_ || is_poised(now))) return {.hands_over = true};
  gathers_ = ends || is_wider(stance_, next, body.scale);
  stance_ = next;
  stops_ = false;
  start_clock(now, body);
  return {.has_new_reference = true};
}

// The sway of a short cycle turns back in time, and is no error.
bool RhythmicGait::is_poised(const Situation& now) const {
  const Mat2 R = rotation_about_z(now.yaw).topLeftCorner<2, 2>();
  Vec2 place = now.dynamics.com.p.head<2>(), excess = now.dynamics.com.v.head<2>();
  if (now.user.walk && !(now.yields && begins_at_rest(now.next->rhythm, now.body.scale)))
    excess -= com_.plan().v;
  if (!begins_at_rest(options_, now.body.scale)) {
    place -= R * sway_.p.head<2>();
    excess -= R * sway_.v.head<2>();
  }
  const Vec2 off = place + excess / pendulum_rate(now) - middle(now);
  return off.norm() < now.body.scale.length * kMaxOff;
}

bool RhythmicGait::is_about_to_lift(const Body& body) const {
  return std::ranges::any_of(body.legs.all(), [&](Leg k) {
    return body.legs[k].down() && !clock_.swings(k) &&
           clock_.until_lift_off(k) < body.options.force.ramp_down;
  });
}

// Its own part of the reference is no error.
void RhythmicGait::drive_com(const Situation& now) {
  const Mat2 R = rotation_about_z(now.yaw).topLeftCorner<2, 2>();
  const Vec2 wanted = com_.plan().v + R * sway_.v.head<2>();
  const Vec2 missing = R.transpose() * (wanted - now.dynamics.com.v.head<2>());
  integral_.update(missing - integral_.value(), options_.integral_rate, options_.integral_max,
                   now.body.period);
  const Vec2 asked = now.user.walk ? now.user.velocity + integral_.value() : now.user.velocity;
  com_.update(R * asked, now.user.yaw_rate, options_.acceleration, options_.leash,
              now.dynamics.com.p.head<2>() - R * sway_.p.head<2>(), now.body.period);
}

void RhythmicGait::sway(const Situation& now) {
  sway_ = {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  pitch_ = {0.0, 0.0, 0.0};
  if (gathers_) return;
  const double t = std::min(now.time - begin_, grows_for_);
  if (sways_only_) {
    sway_ = hermite(sway_, cycle_.at(clock_.phase()), t, grows_for_);
    return;
  }
  const double s = t / grows_for_, share = smoothstep(s);
  const double rate = 6.0 * s * (1.0 - s) / grows_for_;
  const auto grown = [&](const auto& whole) -> std::decay_t<decltype(whole)> {
    return {share * whole.p, share * whole.v + rate * whole.p,
            share * whole.a + 2.0 * rate * whole.v};
  };
  sway_ = grown(cycle_.at(clock_.phase()));
  pitch_ = grown(cycle_.pitch_at(clock_.phase()));
}

ComPlan RhythmicGait::com(const Situation& now, const Body&) const {
  const Mat2 R = rotation_about_z(now.yaw).topLeftCorner<2, 2>();
  ComPlan plan = com_.plan();
  plan.p += R * sway_.p.head<2>();
  plan.v += R * sway_.v.head<2>();
  plan.a += R * sway_.a.head<2>();
  return plan;
}

// At the speed of a fast gait all of the drives' torque moves the feet forward.
double RhythmicGait::slowness() const {
  return std::clamp(2.0 - 2.0 * com_.plan().v.norm() / options_.fast, 0.0, 1.0);
}

bool RhythmicGait::is_slow(const Situation& now) const {
  return com_.plan().v.norm() < options_.stop_speed &&
         now.dynamics.com.v.head<2>().norm() < 2.0 * options_.stop_speed;
}

bool RhythmicGait::misses_foot(const Body& body) const {
  const double ramp = body.options.force.ramp_down + body.period;
  double next = kNever;  // lift-off, where one is near
  for (const Leg k : body.legs.all()) {
    const double lifts = clock_.until_lift_off(k);
    if (lifts <= ramp) next = std::min(next, lifts);
  }
  return std::ranges::any_of(body.legs.all(), [&](Leg k) {
    return !body.legs[k].down() && next < kNever && clock_.until_landing(k) <= next;
  });
}

void RhythmicGait::advance_clock(const Body& body) {
  const bool misses = misses_foot(body), waits = misses && waited_ < options_.wait;
  waited_ = misses ? waited_ + body.period : 0.0;
  clock_.advance(waits ? 0.0 : body.period);
}

void RhythmicGait::move_leg(Leg k, const Situation& now, Body& body) {
  LegMotion& leg = body.legs[k];
  const double until_lift_off = clock_.until_lift_off(k);
  if (clock_.lifts(k) && !stops_) {
    lift(k, now, body);
  } else if (leg.down() && !clock_.swings(k) && !stops_ &&
             until_lift_off < body.options.force.ramp_down) {
    leg.unload(now.time + until_lift_off);
  } else if (leg.phase() == LegPhase::unloading && stops_) {
    leg.reload(now.time);
  } else if (!leg.down()) {
    leg.aim(now.time, foothold(k, leg.target().duration - leg.since(now.time), now));
  }
}

void RhythmicGait::lift(Leg k, const Situation& now, Body& body) {
  const double duration = clock_.swing_duration(k);
  body.events.add(now.event(PlanEvent::lift_off, k));
  body.legs[k].lift(now.time, {.start = now.foot(k),
                               .goal = foothold(k, duration, now),
                               .normal = body.plane.normal,
                               .duration = duration,
                               .apex = body.options.swing.apex + slowness() * options_.rise});
}

// A pendulum over its feet goes slowest in the middle of a stance of duration T:
//
//     v(t) = v_cmd (ω T/2) / sinh(ω T/2) cosh(ω (T/2 − t))        t before the next landing
//
// and the middle of its next stance is v_cmd T/2 ahead of where it is then. What it is faster than
// this moves the foothold on, and so does the centripetal acceleration a of a turn:
//
//     p = c + t v + v_cmd T/2 + R(ψ) offset + capture (v − v(t)) / ω − a / ω²
//
// with ω² = g / h and the heading ψ in the middle of the next stance. Where the gait sways, c is
// less its sway at the landing, and v less that of now.
Vec3 RhythmicGait::foothold(Leg k, double until_landing, const Situation& now) const {
  const Body& body = now.body;
  const double w = pendulum_rate(now);
  const double half = 0.5 * clock_.stance_duration(k);
  const double t = std::clamp(until_landing, 0.0, 2.0 * half);
  const double pace = w * half / std::sinh(w * half) * std::cosh(w * (half - t));
  const double yaw_rate = now.user.yaw_rate;
  const Mat2 R = rotation_about_z(now.yaw + yaw_rate * (t + half)).topLeftCorner<2, 2>();
  const Vec2 v = now.dynamics.com.v.head<2>(), wanted = com_.plan().v;
  const Vec2 centripetal = yaw_rate * Vec2(-wanted.y(), wanted.x());
  const Vec3 sway = gathers_ ? Vec3::Zero() : cycle_.at(clock_.phase() + t / options_.period).p;
  const Vec2 excess = v - pace * wanted - R * sway_.v.head<2>();
  const Vec2 offset = nominal_offset(stance_, k, now.num_legs()) - sway.head<2>();
  const Vec2 place = now.dynamics.com.p.head<2>() + t * v + half * wanted + R * offset +
                     options_.capture / w * excess - centripetal / (w * w);
  Vec3 result;
  result << place, body.plane.height(place);
  return result;
}

}  // namespace surefoot::gaits
