#pragma once

#include <string_view>

namespace surefoot {

/// What happened in the walk at a tick; kept in the log.
enum class PlanEvent : int {
  none = 0,
  lift_off = 1,
  touchdown = 2,
  probe_same_ground = 3,   ///< the first touch is at the height of the last foothold
  probe_edge = 4,          ///< the first touch is lower or higher: the foot moves beyond the edge
  late = 5,                ///< no ground at the expected time: the gait waits, the foot searches
  no_ground = 6,           ///< no ground within reach: the foot returns
  lost_contact = 7,        ///< a stance foot lost its ground
  lift_off_aborted = 8,    ///< the leg did not unload, or the others could not carry the load
  collision = 9,           ///< a hind leg met something above the ground that it steps onto
  slowed = 10,             ///< commanded velocity needs longer strides than the legs have
  slip = 11,               ///< a standing foot began to slide
  push_foot_down = 12,     ///< pushed in a swing: the foot comes down where it helps
  push_reloaded = 13,      ///< pushed before a lift-off: the leg takes load again
  push_step = 14,          ///< pushed with all feet down: a step to recover
  caught = 15,             ///< a rising foot hit something: back, higher, over
  calibration = 16,        ///< the estimate restarts and calibrates on the spot
  calibration_waits = 17,  ///< it is due, but the robot does not rest on all feet
  support_widened = 18,    ///< the other feet's triangle is too thin: another leg steps first
  lowered = 19,            ///< commanded height needs longer legs at the commanded stride
  /// A push or a sliding foot disturbed the calibration, which misses legs or payload: it repeats.
  calibration_disturbed = 20,
  /// The repetition was disturbed too, or can't begin: the robot goes on with what it has.
  calibration_given_up = 21,
  raised = 22,      ///< commanded height leaves legs no room to step: walking higher
  begun_anew = 23,  ///< the next readings contradict the first ones, which are discarded
  lifted = 24,      ///< the feet carry little and the robot does not fall: legs relax
  stands_up = 25,   ///< back on its feet, or began lying: gets up
  gait_changed = 26,
  too_fast = 27,         ///< the command is faster than the gait can go
  invalid_command = 28,  ///< numbers of the command are not finite: they count as 0
  unknown_gait = 29,     ///< the command names a gait that there is not: the gait stays
};

[[nodiscard]] constexpr std::string_view name(PlanEvent event) {
  switch (event) {
    case PlanEvent::none:
      return "none";
    case PlanEvent::lift_off:
      return "lift-off";
    case PlanEvent::touchdown:
      return "touchdown";
    case PlanEvent::probe_same_ground:
      return "probe: same ground";
    case PlanEvent::probe_edge:
      return "probe: edge, going beyond";
    case PlanEvent::late:
      return "no ground at the expected time: searching";
    case PlanEvent::no_ground:
      return "no ground within reach: foot taken back";
    case PlanEvent::lost_contact:
      return "stance foot lost contact: searching";
    case PlanEvent::collision:
      return "leg met something above the ground: up and further on";
    case PlanEvent::slowed:
      return "strides too long for the legs: walking slower than commanded";
    case PlanEvent::slip:
      return "stance foot slides: less force along the ground, slower";
    case PlanEvent::lift_off_aborted:
      return "lift-off aborted: shifting again";
    case PlanEvent::push_foot_down:
      return "pushed in a swing: foot down at once";
    case PlanEvent::push_reloaded:
      return "pushed before a lift-off: leg loaded again";
    case PlanEvent::push_step:
      return "pushed out of balance: step to recover";
    case PlanEvent::caught:
      return "foot met something on its way: back, higher and over";
    case PlanEvent::calibration:
      return "estimate begins anew: calibrating on the spot";
    case PlanEvent::calibration_waits:
      return "calibration waits: for 1 s at rest on all feet";
    case PlanEvent::support_widened:
      return "support too thin for the next swing: another foot steps first";
    case PlanEvent::lowered:
      return "height out of the legs' reach: torso lower than commanded";
    case PlanEvent::calibration_disturbed:
      return "calibration was disturbed: once more, at rest on all feet";
    case PlanEvent::calibration_given_up:
      return "calibration was disturbed, and is given up: going on with what it found";
    case PlanEvent::raised:
      return "torso too low for legs that step: higher than commanded";
    case PlanEvent::begun_anew:
      return "first readings contradicted by the next: beginning anew";
    case PlanEvent::lifted:
      return "lifted off the ground: legs relax";
    case PlanEvent::stands_up:
      return "on the ground: standing up";
    case PlanEvent::gait_changed:
      return "gait changed";
    case PlanEvent::too_fast:
      return "too fast for this gait: walking slower than commanded";
    case PlanEvent::invalid_command:
      return "command has NaN or infinity, which counts as 0";
    case PlanEvent::unknown_gait:
      return "command names an unknown gait: the gait stays";
  }
  return "unknown";
}

}  // namespace surefoot
