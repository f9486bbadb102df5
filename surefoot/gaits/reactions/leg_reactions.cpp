#include "surefoot/gaits/reactions/leg_reactions.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::gaits {
namespace {

constexpr double kRetreatSpeed = 0.5;  // of a foot that found no ground [m/s]
constexpr double kSamePlace = 1e-3;    // [m]
constexpr int kMaxCollisions = 2;      // of one swing with an edge, before the touch is believed
constexpr double kFolded = 0.20;       // of a hip over its foot: the leg folds no further [m]
constexpr double kLevel = 1e-3;        // apex of a move that does not rise [m]
constexpr double kMinStep = 0.02;      // a step that is shorter has no direction [m]

/// The leg goes on to another target.
Action go_on(const Situation& now, PlanEvent event, Leg k, const SwingTarget& target) {
  return {.events = now.told(event, k), .memory = now.body.swing, .swing = SwingOrder{k, target}};
}
/// … and its next touch is no first one.
Action go_on_for_good(const Situation& now, PlanEvent event, Leg k, const SwingTarget& target) {
  Action action = go_on(now, event, k, target);
  action.memory->probes = false;
  return action;
}

bool is_folded(const Situation& now, Leg k) {
  return now.dynamics.hip[index(k)].p.z() - now.foot(k).z() < now.body.scale.length * kFolded;
}

// A touch well above ground whose height is known is a shin or knee against the edge: up again, and
// down further on. Found there once more, or as high as the leg folds, the ground really is higher.
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
  Action action =
      go_on(now, PlanEvent::collision, k,
            {p_WF, goal, body.plane.normal, options.gait.swing_duration, options.swing.apex});
  ++action.memory->collisions;
  return action;
}

// A riser, or an edge that a shin or knee hangs on. The ground behind it lies higher by what nobody
// knows, so the foot rises anew from where it is, away from the edge, and comes down well behind
// it. Caught too often, or as high as the leg folds, it comes down before it.
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
    target.apex = body.scale.length * kLevel;
    target.back = 0.0;
  } else {
    const double beyond = way.dot((before.goal - p_WF).head<2>());
    target.goal.head<2>() += std::max(0.0, reflex.beyond - beyond) * way;
  }
  Action action = go_on(now, PlanEvent::caught, k, target);
  action.memory = memory;
  return action;
}

/// Is this touch, after the foot was caught, the edge of what caught it?
bool touches_the_edge(const Situation& now, Leg k) {
  const SwingMemory& swing = now.body.swing;
  const ReflexOptions& reflex = now.body.options.reflex;
  const bool goes_over = swing.times_caught > 0 && swing.times_caught <= reflex.most;
  return goes_over && (now.foot(k).head<2>() - swing.caught_at).norm() < 0.5 * reflex.beyond;
}

// Two touches of a front foot: an edge between them is found before the foot is loaded.
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
  Action action =
      go_on_for_good(now, same_ground ? PlanEvent::probe_same_ground : PlanEvent::probe_edge, k,
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
  return {.events = now.told(PlanEvent::touchdown, k), .lands = k, .replans = true};
}

// There was ground where it stood. The next step goes to another place. (A foot whose own ground is
// gone has no other: it looks for it there again.)
Action on_no_ground(const Situation& now, Leg k) {
  const Body& body = now.body;
  const Vec3& p_WF = now.foot(k);
  const Vec3& last = body.legs[k].foothold();
  const SwingTarget& target = body.legs[k].target();
  const double same = body.scale.length * kSamePlace, speed = body.scale.speed() * kRetreatSpeed;
  const double duration = body.options.gait.swing_duration + (p_WF - last).norm() / speed;
  Action action =
      go_on_for_good(now, PlanEvent::no_ground, k,
                     {p_WF, last, body.plane.normal, duration, body.options.swing.apex});
  const bool is_own_ground = target.straight && (target.start - last).norm() < same;
  if (!is_own_ground && (target.goal - last).norm() > same) action.avoids = target.goal;
  return action;
}

Action on_lost(const Situation& now, Leg k) {
  Action action{.events = now.told(PlanEvent::lost_contact, k), .replans = true};
  action.searches[index(k)] = true;
  if (now.gait.swings) {
    action.memory = now.body.swing;
    action.memory->probes = false;
    action.searches[index(*now.gait.swings)] = true;
  }
  if (now.gait.unloads && now.gait.unloads != k) action.reloads = now.gait.unloads;
  return action;
}

// A foot that came down has flown off again: there was no ground, or only an edge. The plane, and
// those that follow in its prints, must do without.
Action on_flight(const Situation& now, Leg k) {
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
    case LegEvent::flew:
      return on_flight(now, k);
  }
  return {};
}

// The foot hangs over an edge that lies behind it. It moves on before it goes down, so that the
// leg, stretched, passes clear of the edge, and its first touch can be the foothold.
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
  return go_on_for_good(now, PlanEvent::probe_edge, k,
                        {p_WF, goal, target.normal, probe.duration, body.scale.length * kLevel});
}

std::optional<Action> abort_lift_off(const Situation& now) {
  return Action{.events = now.told(PlanEvent::lift_off_aborted, *now.gait.unloads),
                .reloads = now.gait.unloads,
                .support = now.body.options.gait.switch_duration,
                .replans = true};
}

}  // namespace surefoot::gaits
