#include "surefoot/config/planner_section.hpp"

#include "surefoot/config/initial_posture.hpp"
#include "surefoot/gaits/parts/calibration_motion.hpp"
#include "surefoot/gaits/parts/com_planner.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot {
namespace {

void read_stance(Section& section, StanceOptions& stance) {
  section.number("half_length", stance.half_length, kPositive);
  section.number("half_width", stance.half_width, kPositive);
  section.number("height", stance.height, kPositive);
  section.choice<KneeConfiguration>("knees", stance.knees, {kKnees.begin(), kKnees.end()});
}

/// Each leg once.
void read_order(Section& section, PerLeg<Leg>& order) {
  const ConfigNode* given = section.node("order");
  if (given == nullptr) return;
  if (given->items.size() != order.size()) {
    section.fail("order", "must name each of the 4 legs once: LF, RF, LH, RH");
  }
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::string& name = read_text(given->items[i], section.path_of("order"));
    const auto found = std::ranges::find(kLegNames, name);
    if (found == kLegNames.end()) {
      section.fail("order", "unknown leg \"" + name + "\"; valid are: LF, RF, LH, RH");
    }
    order[i] = kLegs[static_cast<std::size_t>(found - kLegNames.begin())];
    if (std::find(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(i), order[i]) !=
        order.begin() + static_cast<std::ptrdiff_t>(i)) {
      section.fail("order", "leg " + name + " comes twice; it must name each of the 4 legs once");
    }
  }
}

void read_gait(Section& section, GaitOptions& gait) {
  read_order(section, gait.order);
  section.number("swing_duration", gait.swing_duration, kPositive);
  section.number("same_side_duration", gait.same_side_duration, kNotNegative);
  section.number("switch_duration", gait.switch_duration, kNotNegative);
  section.number("start_duration", gait.start_duration, kNotNegative);
}

void read_force(Section& section, ForceOptions& force) {
  section.number("friction", force.friction, kPositive);
  section.number("min", force.min, kNotNegative);
  section.number("max", force.max, kPositive);
  section.number("ramp_up", force.ramp_up, kNotNegative);
  section.number("ramp_down", force.ramp_down, kNotNegative);
  section.flag("ramps", force.ramps);
  section.require_order("min", force.min, "max", force.max);
}

void read_grip(Section& section, GripOptions& grip) {
  section.flag("enabled", grip.enabled);
  section.number("friction_min", grip.friction_min, kPositive);
  section.number("share", grip.share, kShare);
  section.number("recovery", grip.recovery, kNotNegative);
  section.number("enough", grip.enough, kPositive);
  section.number("caution_max", grip.caution_max, kPositive);
  if (grip.caution_max < 1.0) section.fail("caution_max", "must not be below 1");
}

void read_com(Section& section, ComPlannerOptions& com) {
  section.number("zmp_margin", com.zmp_margin, kNotNegative);
  section.number("rest_margin", com.rest_margin, kNotNegative);
  section.integer("horizon_steps", com.horizon_steps, 1, ComPlanner::kMaxSteps);
  section.number("sample_interval", com.sample_interval, kPositive);
  section.number("terminal_weight", com.terminal_weight, kNotNegative);
  section.number("leg_share", com.leg_share,
                 {.min = 0.34, .max = 1.0, .words = "a number from 0.34 to 1"});
}

void read_swing(Section& section, SwingOptions& swing) {
  section.number("apex", swing.apex, kPositive);
  section.number("apex_known", swing.apex_known, kPositive);
  section.number("horizontal_start", swing.horizontal_start, kShare);
  section.number("horizontal_end", swing.horizontal_end, kShare);
  section.number("hip_height_min", swing.hip_height_min, kNotNegative);
  section.number("touchdown_speed", swing.touchdown_speed, kPositive);
  section.number("search_depth_max", swing.search_depth_max, kNotNegative);
  section.number("reach_max", swing.reach_max, kPositive);
  section.number("speed_max", swing.speed_max, kPositive);
  section.number("armed_after", swing.armed_after, kShare);
  if (swing.horizontal_end <= swing.horizontal_start) {
    section.fail("horizontal_end", "must be above horizontal_start");
  }
}

void read_contact(Section& section, TouchdownOptions& contact) {
  section.number("touchdown_force", contact.touchdown_force, kPositive);
  section.number("torque_error", contact.torque_error, kNotNegative);
  section.number("lift_off_force", contact.lift_off_force, kPositive);
  section.number("stall_error", contact.stall_error, kPositive);
  section.number("bounce_speed", contact.bounce_speed, kPositive);
  section.number("bounce_force", contact.bounce_force, kNotNegative);
  section.number("stall_force", contact.stall_force, kNotNegative);
  section.number("lost_force", contact.lost_force, kNotNegative);
  section.number("lost_duration", contact.lost_duration, kNotNegative);
}

void read_reflex(Section& section, ReflexOptions& reflex) {
  section.flag("enabled", reflex.enabled);
  section.number("force", reflex.force, kPositive);
  section.number("hit_force", reflex.hit_force, kPositive);
  section.number("error", reflex.error, kPositive);
  section.number("duration", reflex.duration, kNotNegative);
  section.number("back", reflex.back, kNotNegative);
  section.number("beyond", reflex.beyond, kNotNegative);
  section.integer("most", reflex.most, 0);
}

void read_probe(Section& section, ProbeOptions& probe) {
  section.flag("enabled", probe.enabled);
  section.number("ahead", probe.ahead, kPositive);
  section.number("tolerance", probe.tolerance, kPositive);
  section.number("lift", probe.lift, kPositive);
  section.number("beyond", probe.beyond, kNotNegative);
  section.number("duration", probe.duration, kPositive);
}

void read_torso(Section& section, TorsoOptions& torso) {
  section.number("frequency", torso.frequency,
                 {.min = 0.1, .max = 100.0, .words = "from 0.1 to 100 rad/s"});
  section.number("max_tilt", torso.max_tilt,
                 {.min = 0.0, .max = 1.5, .words = "from 0 to 1.5 rad"});
  section.flag("follow_terrain", torso.follow_terrain);
}

void read_friction_frame(Section& section, FrictionFrameOptions& frame) {
  section.number("time_constant", frame.time_constant, kNotNegative);
  section.number("rate_max", frame.rate_max, kPositive);
}

/// Or the robot throws itself down.
void check_calibration(const Section& section, const CalibrationOptions& calibration) {
  const double least = CalibrationMotion::shortest_duration(calibration);
  if (calibration.duration == 0.0 || calibration.duration >= least) return;
  std::ostringstream message;
  message << calibration.duration
          << " s is too short for a turn by these angles; expected at least "
          << std::ceil(100.0 * least) / 100.0 << " s, or 0 for none";
  section.fail("duration", message.str());
}

void read_calibration(Section& section, CalibrationOptions& calibration) {
  const NumberRange tilt{.min = 0.0, .max = 0.3, .words = "from 0 to 0.3 rad"};
  section.number("duration", calibration.duration, kNotNegative);
  section.number("settle", calibration.settle, kNotNegative);
  section.number("roll", calibration.roll, tilt);
  section.number("pitch", calibration.pitch, tilt);
  section.number("yaw", calibration.yaw, tilt);
  check_calibration(section, calibration);
}

void read_foothold(Section& section, FootholdOptions& foothold) {
  section.flag("hind_use_front_prints", foothold.hind_use_front_prints);
  section.number("print_radius", foothold.print_radius, kNotNegative);
  section.number("same_height", foothold.same_height, kPositive);
  section.flag("bounded_by_feet", foothold.bounded_by_feet);
  section.number("max_step", foothold.max_step, kPositive);
  section.number("max_stride", foothold.max_stride, kPositive);
  section.number("max_side_stride", foothold.max_side_stride, kPositive);
  section.number("stretch_max", foothold.stretch_max, kNotNegative);
  section.number("max_side_step", foothold.max_side_step, kPositive);
  section.number("void_radius", foothold.void_radius, kPositive);
}

void read_push(Section& section, PushOptions& push) {
  section.flag("enabled", push.enabled);
  section.number("replan_step", push.replan_step, kPositive);
  section.number("replan_interval", push.replan_interval, kNotNegative);
  section.number("settling_time", push.settling_time, kPositive);
  section.number("unsteady", push.unsteady, kPositive);
  section.number("unsteady_share", push.unsteady_share, kNotNegative);
  section.number("slow_shift", push.slow_shift, kPositive);
  section.number("foot_down_excess", push.foot_down_excess, kNotNegative);
  section.number("foot_down_duration", push.foot_down_duration, kPositive);
  section.number("lift_off_margin", push.lift_off_margin, kNotNegative);
  section.flag("steps", push.steps);
  section.number("step_margin", push.step_margin);
  section.number("step_duration", push.step_duration, kPositive);
  section.number("step_apex", push.step_apex, kPositive);
  section.number("step_max", push.step_max, kNotNegative);
  section.number("capture_margin", push.capture_margin);
  section.number("calm_margin", push.calm_margin);
  section.number("zmp_margin", push.zmp_margin, kNotNegative);
}

/// A leg is loaded after its touchdown before the next one is unloaded.
void check_switches(const Section& section, const PlannerOptions& options) {
  const double least = options.force.ramps ? options.force.ramp_up + options.force.ramp_down : 0.0;
  const auto check = [&](const char* name, double duration) {
    if (duration > least - 1e-9) return;
    std::ostringstream message;
    message << name << " is " << duration
            << " s; it must last as long as force.ramp_up and force.ramp_down, " << least << " s";
    section.fail("gait", message.str());
  };
  check("switch_duration", options.gait.switch_duration);
  check("same_side_duration", options.gait.same_side_duration);
}

/// Or a foot that searches would be taken back at once.
void check_hip_height(const Section& section, const PlannerOptions& options) {
  if (options.swing.hip_height_min < options.stance.height) return;
  std::ostringstream message;
  message << "hip_height_min is " << options.swing.hip_height_min
          << " m; it must be below stance.height, " << options.stance.height << " m";
  section.fail("swing", message.str());
}

}  // namespace

void read_planner(Section& section, PlannerOptions& options) {
  section.section("calibration", [&](Section& s) { read_calibration(s, options.calibration); });
  section.section("stance", [&](Section& s) { read_stance(s, options.stance); });
  section.section("gait", [&](Section& s) { read_gait(s, options.gait); });
  section.section("force", [&](Section& s) { read_force(s, options.force); });
  section.section("grip", [&](Section& s) { read_grip(s, options.grip); });
  section.section("com", [&](Section& s) { read_com(s, options.com); });
  section.section("swing", [&](Section& s) { read_swing(s, options.swing); });
  section.section("contact", [&](Section& s) { read_contact(s, options.contact); });
  section.section("reflex", [&](Section& s) { read_reflex(s, options.reflex); });
  section.section("probe", [&](Section& s) { read_probe(s, options.probe); });
  section.section("torso", [&](Section& s) { read_torso(s, options.torso); });
  section.section("friction_frame",
                  [&](Section& s) { read_friction_frame(s, options.friction_frame); });
  section.section("foothold", [&](Section& s) { read_foothold(s, options.foothold); });
  section.section("push", [&](Section& s) { read_push(s, options.push); });
  check_switches(section, options);
  check_hip_height(section, options);
}

}  // namespace surefoot
