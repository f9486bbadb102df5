#include "surefoot/gaits/stand/stand.hpp"

#include "surefoot/gaits/com_horizon.hpp"
#include "surefoot/gaits/reactions/push_reactions.hpp"

namespace surefoot::gaits {

void Stand::begin(Situation& now, Body& body, const std::optional<Action>&) { plan_com(now, body); }

void Stand::plan_com(const Situation& now, Body& body) {
  ComHorizon ahead(now, false);
  for (const Leg k : body.legs.all()) {
    if (!ahead.is_down(k)) ahead.land(k, now.foot(k));
  }
  ahead.come_to_rest(body);
}

GaitOutcome Stand::go_on(Situation& now, Body& body) {
  if (body.options.push.enabled) {
    now.gait = {};
    if (const std::optional<Action> step = step_to_recover(now))
      return {.hands_over = true, .first = step};
    if (wants_plan(now)) plan_com(now, body);
  }
  return {.hands_over = now.user.walk && body.legs.all_down()};
}

}  // namespace surefoot::gaits
