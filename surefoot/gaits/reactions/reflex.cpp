// What is done about something that is in a swinging foot's way.
#include "surefoot/gaits/reactions/leg_reactions.hpp"

#include <algorithm>

namespace surefoot {
namespace {

constexpr int kMaxCollisions = 2;    // of one swing with an edge, before the touch is believed
constexpr double kFolded = 0.20;     // of a hip over its foot: the leg folds no further [m]
constexpr double kLevel = 1e-3;      // apex of a move that does not rise [m]
constexpr double kMinStep = 0.02;    // a step that is shorter has no direction [m]
constexpr double kSamePlace = 1e-3;  // [m]

bool is_folded(const Situation& now, Leg k) {
  return now.tick.dynamics.hip[index(k)].p.z() - now.foot(k).z() < kFolded;
}

}  // namespace

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
  Action action{.memory = body.swing};
  ++action.memory->collisions;
  action.events.add(now.event(PlanEvent::collision, k));
  const Vec2 step = (expected - leg.foothold()).head<2>();
  Vec3 goal = expected;
  if (step.norm() > kMinStep) goal.head<2>() += options.probe.beyond * step.normalized();
  action.swing = {
      .leg = k,
      .target = {p_WF, goal, body.plane.normal, options.gait.swing_duration, options.swing.apex}};
  return action;
}

// A riser, or an edge that a shin or knee hangs on. The ground behind it lies higher by what nobody
// knows, so the foot rises anew from where it is, away from the edge, and comes down well behind
// it. Caught too often, or as high as the leg folds, it comes down before it.
std::optional<Action> on_caught(const Situation& now, Leg k) {
  const Body& body = now.body;
  if (body.swing.lands_anywhere) return {};
  const ReflexOptions& reflex = body.options.reflex;
  const double duration = body.options.gait.swing_duration;
  const LegMotion& leg = body.legs[k];
  const Vec3& p_WF = now.foot(k);
  const SwingTarget& before = leg.target();
  const Vec2 step = (before.goal - before.start).head<2>();
  const Vec2 way = step.norm() > kSamePlace ? Vec2(step.normalized()) : body.swing.direction;
  Action action{.memory = body.swing};
  SwingMemory& memory = *action.memory;
  action.events.add(now.event(PlanEvent::caught, k));
  if (memory.times_caught == 0) memory.caught_at = p_WF.head<2>();
  memory.times_caught = is_folded(now, k) ? reflex.most + 1 : memory.times_caught + 1;
  if (memory.times_caught > reflex.most) {
    memory.probes = false;
    Vec3 goal = leg.foothold();
    goal.head<2>() = p_WF.head<2>() - reflex.back * way;
    action.swing = {.leg = k, .target = {p_WF, goal, body.plane.normal, duration, kLevel}};
    return action;
  }
  Vec3 goal = before.goal;
  const double beyond = way.dot((goal - p_WF).head<2>());
  goal.head<2>() += std::max(0.0, reflex.beyond - beyond) * way;
  action.swing = {
      .leg = k,
      .target = {p_WF, goal, before.normal, duration, body.options.swing.apex, reflex.back}};
  return action;
}

bool touches_the_edge(const Situation& now, Leg k) {
  const SwingMemory& swing = now.body.swing;
  const ReflexOptions& reflex = now.body.options.reflex;
  const bool goes_over = swing.times_caught > 0 && swing.times_caught <= reflex.most;
  return goes_over && (now.foot(k).head<2>() - swing.caught_at).norm() < 0.5 * reflex.beyond;
}

}  // namespace surefoot
