#include "surefoot/gaits/reactions/action.hpp"

namespace surefoot {

void carry_out(const Action& action, const GaitTick& tick, Body& body) {
  body.events.add(action.events);
  if (action.memory) body.swing = *action.memory;
  if (action.forgets_print) {
    body.footholds.forget_last(*action.forgets_print);
    body.fit_plane();
  }
  if (action.avoids) body.footholds.avoid(*action.avoids);
  if (action.lands) {
    const Vec3& p_WF = tick.dynamics.foot[index(*action.lands)].p;
    body.legs[*action.lands].plant(tick.time, p_WF);
    body.footholds.remember(*action.lands, p_WF);
    body.fit_plane();
  }
  if (action.reloads) body.legs[*action.reloads].reload(tick.time);
  for (const Leg k : kLegs) {
    const PointKinematics& foot = tick.dynamics.foot[index(k)];
    if (action.searches[index(k)])
      body.legs[k].search(tick.time, foot.p, foot.v, body.plane.normal);
  }
  if (action.swing) body.legs[action.swing->leg].lift(tick.time, action.swing->target);
}

}  // namespace surefoot
