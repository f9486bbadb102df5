// Two touches of a front foot: an edge between them is found before the foot is loaded.
#include "surefoot/gaits/reactions/leg_reactions.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot {
namespace {

constexpr double kLevel = 1e-3;  // apex of a move that does not rise [m]

}  // namespace

Action on_first_touch(const Situation& now, Leg k) {
  const Body& body = now.body;
  const ProbeOptions& probe = body.options.probe;
  const Vec3& p_WF = now.foot(k);
  const double from_last = std::abs(p_WF.z() - body.legs[k].foothold().z());
  const double from_plane = std::abs(p_WF.z() - body.plane.height(p_WF.head<2>()));
  const bool same_ground = std::min(from_last, from_plane) < probe.tolerance;
  Vec3 goal = p_WF;
  if (same_ground) {
    goal.head<2>() = body.swing.foothold.head<2>();
  } else {
    goal.head<2>() += probe.beyond * body.swing.direction;
  }
  Action action{.memory = body.swing};
  action.memory->probes = false;
  action.events.add(
      now.event(same_ground ? PlanEvent::probe_same_ground : PlanEvent::probe_edge, k));
  action.swing = {.leg = k,
                  .target = {p_WF, goal, body.plane.normal, probe.duration, probe.lift},
                  .keeps_deadline = true};
  return action;
}

// The foot hangs over an edge that lies behind it. It moves on before it goes down, so that the
// leg, stretched, passes clear of the edge, and its first touch can be the foothold.
std::optional<Action> reach_beyond_edge(const Situation& now, Leg k) {
  const Body& body = now.body;
  const ProbeOptions& probe = body.options.probe;
  const LegMotion& leg = body.legs[k];
  const SwingTarget& target = leg.target();
  const Vec3& p_WF = now.foot(k);
  const double expected = std::min(target.goal.z(), leg.foothold().z());
  const bool below = p_WF.z() < expected - probe.tolerance;
  if (!body.swing.probes || leg.phase() != LegPhase::search || !below) return {};
  Action action{.memory = body.swing};
  action.memory->probes = false;
  action.events.add(now.event(PlanEvent::probe_edge, k));
  Vec3 goal = p_WF - probe.lift * target.normal;
  goal.head<2>() += probe.beyond * body.swing.direction;
  action.swing = {.leg = k, .target = {p_WF, goal, target.normal, probe.duration, kLevel}};
  return action;
}

}  // namespace surefoot
