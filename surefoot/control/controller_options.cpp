#include "surefoot/base/fields.hpp"
#include "surefoot/base/formatted.hpp"
#include "surefoot/base/names_of.hpp"
#include "surefoot/control/controller.hpp"

namespace surefoot::control {
namespace {

constexpr NumberRange kPeriod{
    .min = 0.0, .max = 0.01, .min_included = false, .words = "above 0 and at most 0.01 s"};
constexpr NumberRange kFlops{.min = 0.0,
                             .min_included = false,
                             .words = "a number above 0",
                             .none = std::numeric_limits<double>::infinity()};

Group fields(SolverOptions& o) {
  return {
      {"method", choice(o.method, names_of(kSolverMethods)),
       "from the rows active at the last tick; or the reference, which starts from nothing"},
      {"structure", &o.structure, "physics and contacts in closed form; not of cascade"},
      {"flops", &o.budget.flops, kFlops, "", "of a tick, then the search ends; not of cascade"}};
}

Group fields(SafetyOptions& o) {
  return {{"damp_after_failures",
           &o.damp_after_failures,
           {.min = 1},
           "ticks",
           "of joint hold before the robot is damped, latched"},
          {"max_tilt", &o.max_tilt, kPositive, "rad", "of the torso, damped beyond, latched"},
          {"bridge_time", &o.bridge_time, kNotNegative, "s",
           "without a good sample of a sensor before the robot sits down; at most guard.patience",
           Sizing::none},
          {"sit_duration", &o.sit_duration, kPositive, "s",
           "of the way down; torques fade in its last two fifths"},
          {"sit_height", &o.sit_height, kPositive, "m", "of the hips above the feet when down"},
          {"max_torque_change", &o.max_torque_change, kPositive, "N·m",
           "from tick to tick after a fault or stop, and while a robot begins late"}};
}

/// No sensor is bridged for longer than it is made up for.
void check_bridge(const ControllerOptions& o, const Given& given) {
  const double bridge = o.safety.bridge_time, patience = o.guard.patience;
  if (bridge <= patience) return;
  if (given.has("safety.bridge_time")) {
    given.fail(
        "safety.bridge_time",
        formatted("%g s must not be above guard.patience, %g s, for which a sensor is made up for",
                  bridge, patience));
  }
  given.fail("guard.patience",
             formatted("%g s must not be below safety.bridge_time, %g s", patience, bridge));
}

}  // namespace

Group fields(LevelSwitch& o) {
  constexpr const char* kLevels = "must be a list of names of levels";
  return {Field{"time", &o.time, kNotNegative, "s", "when it begins"}.required(),
          {"duration", &o.duration, kNotNegative, "s", "0: at once"},
          {"add", Names{&o.add, 0, kLevels}, "levels that come"},
          {"remove", Names{&o.remove, 0, kLevels}, "levels that go"}};
}

Group fields(ControllerOptions& o) {
  return Group{
      {"period", &o.period, kPeriod, "s", "of the control loop, whole timesteps", Sizing::none},
      {"planner", fields(o.planner), "gait, footholds and reactions"},
      {"guard",
       fields(o.guard).and_also(
           {{"consistency", fields(o.consistency), "sensors that contradict each other"}}),
       "what a sensor can truly give"},
      {"slip", fields(o.slip), "when a standing foot counts as sliding"},
      {"contact_force", fields(o.contact_force), "contact detection"},
      {"link_masses", Group{{"enabled", &o.link_masses.enabled, "weigh swing legs"}},
       "masses of the legs' links"},
      {"external_force", fields(o.external_force), "what counts as push or load"},
      {"solver", fields(o.solver), "method and budget of a tick"},
      {"safety", fields(o.safety), "when the controller stops, and how it sits down"}}
      .with([&o](const Given& given) { check_bridge(o, given); });
}

}  // namespace surefoot::control
