#include "surefoot/gaits/stand/stand.hpp"

#include "surefoot/gaits/com_horizon.hpp"
#include "surefoot/gaits/reactions/leg_reactions.hpp"
#include "surefoot/gaits/reactions/push_reactions.hpp"

namespace surefoot {
namespace {

constexpr double kToCentre = 1.0;  // for the COM to come to the centre of the feet [s]

}  // namespace

void Stand::begin(const GaitTick& tick, Body& body, const std::optional<Action>&) noexcept {
  plan_com(tick, body);
}

void Stand::observe(const GaitTick& tick, Body& body) noexcept {
  for (const Leg k : kLegs) {
    const LegEvent event = look_at(k, tick, body);
    act(react_to_leg(event, {tick, body, {}}, k), tick, body);
  }
}

GaitOutcome Stand::advance(const GaitTick& tick, Body& body) noexcept {
  const Situation now{tick, body, {}};
  if (body.observe_grip(tick)) act(on_slip(now), tick, body);
  body.balance.update(tick.state, tick.dynamics, body.com_height(tick.dynamics));
  if (body.options.push.enabled) {
    const std::optional<Action> step = step_to_recover(now);
    if (step) return {.hands_over = true, .first = step};
    if (body.wants_plan(tick)) plan_com(tick, body);
  }
  return {.hands_over = tick.user.walk && body.legs.all_down()};
}

void Stand::act(const std::optional<Action>& action, const GaitTick& tick, Body& body) {
  if (!action) return;
  carry_out(*action, tick, body);
  if (action->swing && !action->swing->keeps_deadline) plan_com(tick, body);
  if (action->replans) plan_com(tick, body);
}

void Stand::plan_com(const GaitTick& tick, Body& body) {
  ComHorizon ahead(tick, body, false);
  for (const Leg k : kLegs) {
    if (!ahead.is_down(k)) ahead.land(k, tick.dynamics.foot[index(k)].p);
  }
  ahead.add(kToCentre, false);
  ahead.plan(Vec2::Zero(), true);
}

}  // namespace surefoot
