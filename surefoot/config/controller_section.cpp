#include "surefoot/config/controller_section.hpp"

#include "surefoot/base/formatted.hpp"
#include "surefoot/config/choices.hpp"
#include "surefoot/config/guard_section.hpp"
#include "surefoot/config/planner_section.hpp"

#include <sstream>

namespace surefoot {
namespace {

void read_safety(Section& section, SafetyOptions& safety) {
  section.integer("damp_after_failures", safety.damp_after_failures, 1);
  section.number("max_tilt", safety.max_tilt, kPositive);
  section.number("bridge_time", safety.bridge_time, kNotNegative);
  section.number("sit_duration", safety.sit_duration, kPositive);
  section.number("sit_height", safety.sit_height, kPositive);
  section.number("max_torque_change", safety.max_torque_change, kPositive);
}

void read_slip(Section& section, SlipOptions& slip) {
  section.flag("enabled", slip.enabled);
  section.number("begin_speed", slip.begin_speed, kPositive);
  section.number("begin_duration", slip.begin_duration, kNotNegative);
  section.number("end_speed", slip.end_speed, kPositive);
  section.number("end_duration", slip.end_duration, kNotNegative);
  section.number("force", slip.force, kNotNegative);
  section.number("settle", slip.settle, kNotNegative);
  section.number("cutoff_hz", slip.cutoff_hz, kPositive);
  if (slip.end_speed > slip.begin_speed) {
    std::ostringstream message;
    message << "is " << slip.end_speed << " m/s; it must not be above begin_speed, "
            << slip.begin_speed << " m/s";
    section.fail("end_speed", message.str());
  }
}

void read_contact_force(Section& section, ContactForceOptions& contact_force) {
  section.number("bandwidth_hz", contact_force.bandwidth_hz, kPositive);
  section.flag("use_foot_sensor", contact_force.use_foot_sensor);
  section.flag("tare", contact_force.tare.enabled);
}

void read_external_force(Section& section, ExternalForceOptions& external) {
  section.flag("enabled", external.enabled);
  section.number("time_constant", external.time_constant, kTimeConstant);
  section.number("load_time_constant", external.load_time_constant, kTimeConstant);
  section.number("dead_band", external.dead_band, kNotNegative);
  section.number("load_dead_band", external.load_dead_band, kNotNegative);
  section.number("moment_dead_band", external.moment_dead_band, kNotNegative);
  section.number("max_force", external.max_force, kNotNegative);
  section.number("max_moment", external.max_moment, kNotNegative);
}

void read_solver(Section& section, SolverOptions& solver) {
  section.choice<SolverMethod>("method", solver.method, named(kSolverMethods));
  section.flag("structure", solver.structure);
  section.number("flops", solver.budget.flops, kPositive);
}

/// No sensor is bridged for longer than it is made up for.
void check_bridge(Section& top, const ControllerOptions& controller) {
  const double bridge = controller.safety.bridge_time, patience = controller.guard.patience;
  if (bridge <= patience) return;
  const ConfigNode* safety = top.node("safety");
  const ConfigNode* given = safety == nullptr ? nullptr : safety->find("bridge_time");
  if (given != nullptr) {
    fail_at(
        *given, "safety.bridge_time",
        formatted("%g s must not be above guard.patience, %g s, for which a sensor is made up for",
                  bridge, patience));
  }
  fail_at(*top.node("guard")->find("patience"), "guard.patience",
          formatted("%g s must not be below safety.bridge_time, %g s", patience, bridge));
}

}  // namespace

void read_controller(Section& top, ControllerOptions& controller) {
  top.number(
      "period", controller.period,
      {.min = 0.0, .max = 0.01, .min_included = false, .words = "above 0 and at most 0.01 s"});
  top.section("planner", [&](Section& s) { read_planner(s, controller.planner); });
  top.section("guard",
              [&](Section& s) { read_guard(s, controller.guard, controller.consistency); });
  top.section("slip", [&](Section& s) { read_slip(s, controller.slip); });
  top.section("contact_force",
              [&](Section& s) { read_contact_force(s, controller.contact_force); });
  top.section("link_masses",
              [&](Section& s) { s.flag("enabled", controller.link_masses.enabled); });
  top.section("external_force",
              [&](Section& s) { read_external_force(s, controller.external_force); });
  top.section("solver", [&](Section& s) { read_solver(s, controller.solver); });
  top.section("safety", [&](Section& s) { read_safety(s, controller.safety); });
  check_bridge(top, controller);
}

}  // namespace surefoot
