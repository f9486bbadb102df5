// What the planner does about the ground that a foot meets, or does not meet.
#include "surefoot/gaits/planner.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot {
namespace {

constexpr int kMostCollisions = 2;     // of one swing with an edge, before the touch is believed
constexpr double kRetreatSpeed = 0.5;  // of a foot that found no ground [m/s]
constexpr double kWider = 0.01;        // a support that is worth another leg's step, by [m]
constexpr double kSamePlace = 1e-3;    // [m]
constexpr double kFolded = 0.20;       // of a hip over its foot: the leg folds no further [m]

bool is_folded(Leg leg, const Dynamics& dynamics) {
  return dynamics.hip[index(leg)].p.z() - dynamics.foot[index(leg)].p.z() < kFolded;
}

}  // namespace

void Planner::on_touchdown(Leg k, const UserCommand& user, const Dynamics& dynamics) {
  const Vec3& p_WF = dynamics.foot[index(k)].p;
  const bool was_swinging = mode_ == Mode::swing && next_leg() == k;
  const bool is_picky = was_swinging && !emergency_;
  if (is_picky && touches_the_edge(p_WF)) return on_caught(k, user, dynamics);
  if (is_picky && probing_) return continue_probe(k, p_WF);
  if (is_picky && hit_above_known_ground(k, user, dynamics)) return;
  event_ = PlanEvent::touchdown;
  leg(k).plant(time_, p_WF);
  foothold_planner_.remember(k, p_WF);
  plane_ = fit_terrain_plane(footholds(), options_.torso.max_tilt);
  if (was_swinging) {
    ++steps_taken_;
    cursor_ = (cursor_ + 1) % kNumLegs;
    begin_support(user, support_duration());
  }
  replan_com(user, dynamics);
}

void Planner::continue_probe(Leg k, const Vec3& p_WF) {
  probing_ = false;
  const double from_last = std::abs(p_WF.z() - leg(k).foothold().z());
  const double from_plane = std::abs(p_WF.z() - plane_.height(p_WF.head<2>()));
  const bool same_ground = std::min(from_last, from_plane) < options_.probe.tolerance;
  Vec3 goal = p_WF;
  if (same_ground) {
    goal.head<2>() = probe_target_.head<2>();
  } else {
    goal.head<2>() += options_.probe.beyond * probe_direction_;
  }
  event_ = same_ground ? PlanEvent::probe_same_ground : PlanEvent::probe_edge;
  leg(k).lift(time_, {p_WF, goal, plane_.normal, options_.probe.duration, options_.probe.lift});
}

// The foot stays in the air longer than the COM plan knows: a new plan, or the balance goes on
// without it.
void Planner::swing_again(Leg k, const SwingTarget& target, const UserCommand& user,
                          const Dynamics& dynamics) {
  leg(k).lift(time_, target);
  expect_touchdown(target.duration);
  replan_com(user, dynamics);
}

// No ground at the first touch: the foot hangs over an edge that lies behind it. It moves on before
// it goes down, so that the leg, stretched, passes clear of the edge, and its first touch can be
// the foothold.
void Planner::reach_beyond_edge(Leg k, const UserCommand& user, const Dynamics& dynamics) {
  const Vec3& p_WF = dynamics.foot[index(k)].p;
  const SwingTarget& target = leg(k).target();
  const double expected = std::min(target.goal.z(), leg(k).foothold().z());
  const bool below = p_WF.z() < expected - options_.probe.tolerance;
  if (leg(k).phase() != LegPhase::search || !below) return;
  probing_ = false;
  event_ = PlanEvent::probe_edge;
  Vec3 goal = p_WF - options_.probe.lift * target.normal;
  goal.head<2>() += options_.probe.beyond * probe_direction_;
  swing_again(k, {p_WF, goal, target.normal, options_.probe.duration, kLevel}, user, dynamics);
}

// A touch well above ground whose height is known is a shin or knee against the edge: up again, and
// down further on. Found there once more, or as high as the leg folds, the ground really is higher.
bool Planner::hit_above_known_ground(Leg k, const UserCommand& user, const Dynamics& dynamics) {
  const Vec3& p_WF = dynamics.foot[index(k)].p;
  const SwingTarget& target = leg(k).target();
  const bool above = p_WF.z() > target.goal.z() + options_.probe.lift + options_.probe.tolerance;
  if (!knows_ground(k) || !above || collisions_ >= kMostCollisions) return false;
  if (is_folded(k, dynamics)) return false;
  ++collisions_;
  event_ = PlanEvent::collision;
  const Vec2 step = (target.goal - leg(k).foothold()).head<2>();
  Vec3 goal = target.goal;
  if (step.norm() > kLeastWay) goal.head<2>() += options_.probe.beyond * step.normalized();
  swing_again(k, {p_WF, goal, plane_.normal, options_.gait.swing_duration, options_.swing.apex},
              user, dynamics);
  return true;
}

// A riser, or an edge that a shin or knee hangs on. The ground behind it lies higher by what nobody
// knows, so the foot rises anew from where it is, away from the edge, and comes down well behind
// it. Caught too often, or as high as the leg folds, it comes down before it.
void Planner::on_caught(Leg k, const UserCommand& user, const Dynamics& dynamics) {
  if (emergency_) return;
  const Vec3& p_WF = dynamics.foot[index(k)].p;
  const ReflexOptions& reflex = options_.reflex;
  const SwingTarget before = leg(k).target();
  const Vec2 step = (before.goal - before.start).head<2>();
  const Vec2 way = step.norm() > kSamePlace ? Vec2(step.normalized()) : probe_direction_;
  event_ = PlanEvent::caught;
  if (caught_ == 0) caught_at_ = p_WF.head<2>();
  caught_ = is_folded(k, dynamics) ? reflex.most + 1 : caught_ + 1;
  if (caught_ > reflex.most) {
    Vec3 goal = leg(k).foothold();
    goal.head<2>() = p_WF.head<2>() - reflex.back * way;
    probing_ = false;
    swing_again(k, {p_WF, goal, plane_.normal, options_.gait.swing_duration, kLevel}, user,
                dynamics);
    return;
  }
  Vec3 goal = before.goal;
  const double beyond = way.dot((goal - p_WF).head<2>());
  goal.head<2>() += std::max(0.0, reflex.beyond - beyond) * way;
  swing_again(
      k,
      {p_WF, goal, before.normal, options_.gait.swing_duration, options_.swing.apex, reflex.back},
      user, dynamics);
}

bool Planner::touches_the_edge(const Vec3& p_WF) const {
  const bool goes_over = caught_ > 0 && caught_ <= options_.reflex.most;
  return goes_over && (p_WF.head<2>() - caught_at_).norm() < 0.5 * options_.reflex.beyond;
}

// Back to the last foothold: there was ground. The next step goes to another place. (A foot whose
// own ground is gone has no other: it looks for it there again.)
void Planner::on_unreachable(Leg k, const UserCommand& user, const Dynamics& dynamics) {
  const Vec3& p_WF = dynamics.foot[index(k)].p;
  event_ = PlanEvent::no_ground;
  probing_ = false;
  const Vec3& last = leg(k).foothold();
  const SwingTarget& target = leg(k).target();
  const bool is_own_ground = target.straight && (target.start - last).norm() < kSamePlace;
  if (!is_own_ground && (target.goal - last).norm() > kSamePlace)
    foothold_planner_.avoid(target.goal);
  const double duration = options_.gait.swing_duration + (p_WF - last).norm() / kRetreatSpeed;
  swing_again(k, {p_WF, last, plane_.normal, duration, options_.swing.apex}, user, dynamics);
}

// The step of another leg to its nominal place.
bool Planner::lets_another_leg_go_first(const UserCommand& user, const Dynamics& dynamics) {
  const double enough = options_.com.rest_margin;
  const Leg next = next_leg();
  const PerLeg<Vec3> feet = footholds();
  PerLeg<Vec2> places;
  for (const Leg k : kLegs) places[index(k)] = feet[index(k)].head<2>();
  double widest = inradius_without(next, places);
  if (widest > enough) return false;
  widest += kWider;
  Leg first = next;
  for (const Leg k : kLegs) {
    if (k == next || inradius_without(k, places) < enough) continue;
    PerLeg<Vec2> after = places;
    after[index(k)] =
        foothold_planner_.foothold(k, feet, plane_, yaw_, user, cycle_duration()).head<2>();
    const double width = inradius_without(next, after);
    if (width > widest) first = k;
    widest = std::max(widest, width);
  }
  if (first == next) return false;
  event_ = PlanEvent::support_widened;
  begin_support(user, pace() * options_.gait.start_duration);
  go_on_with(first);
  replan_com(user, dynamics);
  return true;
}

// There was no ground where it came down, or only an edge: the plane, and those that follow in its
// prints, must do without.
void Planner::on_flight(Leg k, const UserCommand& user, const Dynamics& dynamics) {
  foothold_planner_.forget_last(k);
  plane_ = fit_terrain_plane(footholds(), options_.torso.max_tilt);
  on_lost(k, user, dynamics);
}

void Planner::on_lost(Leg k, const UserCommand& user, const Dynamics& dynamics) {
  event_ = PlanEvent::lost_contact;
  const auto searches = [&](Leg one) {
    const PointKinematics& foot = dynamics.foot[index(one)];
    leg(one).search(time_, foot.p, foot.v, plane_.normal);
  };
  searches(k);
  if (mode_ == Mode::swing) {
    probing_ = false;
    searches(next_leg());
  } else if (mode_ == Mode::support && leg(next_leg()).phase() == LegPhase::unloading) {
    leg(next_leg()).reload(time_);
  }
  replan_com(user, dynamics);
}

}  // namespace surefoot
