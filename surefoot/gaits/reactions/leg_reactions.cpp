#include "surefoot/gaits/reactions/leg_reactions.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::gaits {
namespace {

constexpr double kRetreatSpeed = 0.5;   // of a foot that found no ground [m/s]
constexpr double kSamePlace = 1e-3;     // [m]
constexpr int kMaxCollisions = 2;       // per swing, before a contact is taken as ground
constexpr double kMinHipHeight = 0.20;  // over its foot, with the leg folded [m]
constexpr double kFlatApex = 1e-3;      // of a swing that does not rise [m]
constexpr double kMinStep = 0.02;       // a shorter step has no direction [m]

/// Continues the swing to another target.
Action continue_swing(const Situation& now, PlanEvent event, Leg k, const SwingTarget& target) {
  return {
      .events = now.event_list(event, k), .memory = now.body.swing, .swing = SwingOrder{k, target}};
}
/// Continues the swing without probing.
Action continue_without_probe(const Situation& now, PlanEvent event, Leg k,
                              const SwingTarget& target) {
  Action action = continue_swing(now, event, k, target);
  action.memory->probes = false;
  return action;
}

bool is_folded(const Situation& now, Leg k) {
  return now.dynamics.hip[index(k)].p.z() - now.foot(k).z() < now.body.scale.length * kMinHipHeight;
}

// A contact well above known ground is a shin or knee against an edge: the foot rises and lands
// farther ahead. After repeated contacts, or with a folded leg, the ground is taken as higher.
std::optional<Action> on_collision(const Situation& now, Leg k) {
  const Body& body = now.body;
  const PlannerOptions& options = body.options;
  const LegMotion& leg = body.legs[k];
  const Vec3& p_WF = now.foot(k);
  const Vec3& expected = leg.target().goal;
  const bool above = p_WF.z() > expected.z() + options.probe.lift + options.probe.tolerance;
  if (!knows_ground(options, k) || !above || body.swing.collisions >= kMaxCollisions) return {};
  if (is_folded(now, k)) return {};
  const Vec2 step = (expected - leg.foothold()).head<2>();
  Vec3 goal = expected;
  const bool has_direction = step.norm() > body.scale.length * kMinStep;
  if (has_direction) goal.head<2>() += options.probe.beyond * step.normalized();
  Action action = continue_swing(
      now, PlanEvent::collision, k,
      {p_WF, goal, body.plane.normal, options.gait.swing_duration, options.swing.apex});
  ++action.memory->collisions;
  return action;
}

// The foot has hit a riser, or shin or knee an edge. The height beyond is unknown, so the foot
// backs off, rises from where it is and lands well beyond the edge. If it was caught too often, or
// the leg is folded, it lands before the edge.
std::optional<Action> on_caught(const Situation& now, Leg k) {
  const Body& body = now.body;
  if (body.swing.lands_anywhere) return {};
  const ReflexOptions& reflex = body.options.reflex;
  const Vec3& p_WF = now.foot(k);
  const SwingTarget& before = body.legs[k].target();
  const Vec2 step = (before.goal - before.start).head<2>();
  const bool has_way = step.norm() > body.scale.length * kSamePlace;
  const Vec2 way = has_way ? Vec2(step.normalized()) : body.swing.direction;
  SwingMemory memory = body.swing;
  if (memory.times_caught == 0) memory.caught_at = p_WF.head<2>();
  memory.times_caught = is_folded(now, k) ? reflex.most + 1 : memory.times_caught + 1;
  SwingTarget target{p_WF,
                     before.goal,
                     before.normal,
                     body.options.gait.swing_duration,
                     body.options.swing.apex,
                     reflex.back};
  if (memory.times_caught > reflex.most) {
    memory.probes = false;
    target.goal = body.legs[k].foothold();
    target.goal.head<2>() = p_WF.head<2>() - reflex.back * way;
    target.normal = body.plane.normal;
    target.apex = body.scale.length * kFlatApex;
    target.back = 0.0;
  } else {
    const double beyond = way.dot((before.goal - p_WF).head<2>());
    target.goal.head<2>() += std::max(0.0, reflex.beyond - beyond) * way;
  }
  Action action = continue_swing(now, PlanEvent::caught, k, target);
  action.memory = memory;
  return action;
}

/// Is this contact the edge of the obstacle that caught the foot before?
bool touches_the_edge(const Situation& now, Leg k) {
  const SwingMemory& swing = now.body.swing;
  const ReflexOptions& reflex = now.body.options.reflex;
  const bool goes_over = swing.times_caught > 0 && swing.times_caught <= reflex.most;
  return goes_over && (now.foot(k).head<2>() - swing.caught_at).norm() < 0.5 * reflex.beyond;
}

// The first of a front foot's two touches: finds an edge before the foot is loaded.
Action on_first_touch(const Situation& now, Leg k) {
  const Body& body = now.body;
  const ProbeOptions& probe = body.options.probe;
  const Vec3& p_WF = now.foot(k);
  const double from_last = std::abs(p_WF.z() - body.legs[k].foothold().z());
  const double from_plane = std::abs(p_WF.z() - body.plane.height(p_WF.head<2>()));
  const bool same_ground = std::min(from_last, from_plane) < probe.tolerance;
  Vec3 goal = p_WF;
  if (same_ground)
    goal.head<2>() = body.swing.foothold.head<2>();
  else
    goal.head<2>() += probe.beyond * body.swing.direction;
  Action action = continue_without_probe(
      now, same_ground ? PlanEvent::probe_same_ground : PlanEvent::probe_edge, k,
      {p_WF, goal, body.plane.normal, probe.duration, probe.lift});
  action.swing->keeps_deadline = true;
  return action;
}

Action on_touchdown(const Situation& now, Leg k) {
  if (now.gait.swings == k && !now.body.swing.lands_anywhere) {
    if (touches_the_edge(now, k)) return on_caught(now, k).value();
    if (now.body.swing.probes) return on_first_touch(now, k);
    if (const std::optional<Action> collision = on_collision(now, k)) return *collision;
  }
  return {.events = now.event_list(PlanEvent::touchdown, k), .lands = k, .replans = true};
}

// Returns to the last foothold, and marks the target as a void. A foot that lost the ground of its
// own foothold searches there again.
Action on_no_ground(const Situation& now, Leg k) {
  const Body& body = now.body;
  const Vec3& p_WF = now.foot(k);
  const Vec3& last = body.legs[k].foothold();
  const SwingTarget& target = body.legs[k].target();
  const double same = body.scale.length * kSamePlace, speed = body.scale.speed() * kRetreatSpeed;
  const double duration = body.options.gait.swing_duration + (p_WF - last).norm() / speed;
  Action action =
      continue_without_probe(now, PlanEvent::no_ground, k,
                             {p_WF, last, body.plane.normal, duration, body.options.swing.apex});
  const bool is_own_ground = target.straight && (target.start - last).norm() < same;
  if (!is_own_ground && (target.goal - last).norm() > same) action.avoids = target.goal;
  return action;
}

Action on_lost(const Situation& now, Leg k) {
  Action action{.events = now.event_list(PlanEvent::lost_contact, k), .replans = true};
  action.searches[index(k)] = true;
  if (now.gait.swings) {
    action.memory = now.body.swing;
    action.memory->probes = false;
    action.searches[index(*now.gait.swings)] = true;
  }
  if (now.gait.unloads && now.gait.unloads != k) action.reloads = now.gait.unloads;
  return action;
}

// The foot left the ground soon after touchdown: its print is no foothold.
Action on_airborne(const Situation& now, Leg k) {
  Action action = on_lost(now, k);
  action.forgets_print = k;
  return action;
}

}  // namespace

std::optional<Action> react_to_leg(LegEvent event, const Situation& now, Leg k) {
  switch (event) {
    case LegEvent::none:
      return {};
    case LegEvent::touchdown:
      return on_touchdown(now, k);
    case LegEvent::caught:
      return on_caught(now, k);
    case LegEvent::unreachable:
      return on_no_ground(now, k);
    case LegEvent::lost:
      return on_lost(now, k);
    case LegEvent::airborne:
      return on_airborne(now, k);
  }
  return {};
}

// The edge lies behind the foot. The foot first moves ahead and then down, so that the stretched
// leg clears the edge and the first touch can be the foothold.
std::optional<Action> reach_beyond_edge(const Situation& now) {
  const Leg k = *now.gait.swings;
  const Body& body = now.body;
  const ProbeOptions& probe = body.options.probe;
  const LegMotion& leg = body.legs[k];
  const SwingTarget& target = leg.target();
  const Vec3& p_WF = now.foot(k);
  const double expected = std::min(target.goal.z(), leg.foothold().z());
  const bool below = p_WF.z() < expected - probe.tolerance;
  if (!body.swing.probes || leg.phase() != LegPhase::search || !below) return {};
  Vec3 goal = p_WF - probe.lift * target.normal;
  goal.head<2>() += probe.beyond * body.swing.direction;
  return continue_without_probe(
      now, PlanEvent::probe_edge, k,
      {p_WF, goal, target.normal, probe.duration, body.scale.length * kFlatApex});
}

std::optional<Action> abort_lift_off(const Situation& now) {
  return Action{.events = now.event_list(PlanEvent::lift_off_aborted, *now.gait.unloads),
                .reloads = now.gait.unloads,
                .support = now.body.options.gait.switch_duration,
                .replans = true};
}

}  // namespace surefoot::gaits
