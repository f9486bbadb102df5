#include "surefoot/evaluation/metric_table.hpp"

#include <algorithm>

namespace surefoot::evaluation {
namespace {

using enum Sense;
using enum Course;
using M = Metrics;

constexpr Place kFirst = Place::among_the_first, kTitle = Place::in_the_title;
constexpr bool kByClock = true;

constexpr ShownUnit kNone{""}, kMetres{"m"}, kMillimetres{"mm", 1e3}, kSpeed{"m/s"};
constexpr ShownUnit kDegrees{"°", 180.0 / kPi}, kTurn{"°/s", 180.0 / kPi}, kJointSpeed{"rad/s"};
constexpr ShownUnit kSeconds{"s"}, kMilliseconds{"ms", 1e3}, kMicroseconds{"µs"}, kTorque{"N·m"};
constexpr ShownUnit kRealTime{"× real time"};

std::vector<Metric> all_metrics() {
  return {
      {"succeeded", &M::succeeded, kNone, none, varies,
       "all criteria hold, no stop, no failed own part", kTitle},
      {"reason", &M::reason, kNone, none, varies, "why the run ended", kTitle},
      {"goal_reached", &M::goal_reached, kNone, none, grows, "the scenario's goal was reached"},
      {"fell", &M::fell, kNone, none, grows,
       "torso on the ground, hips lower than 0.21 of the leg over the standing feet (ANYmal B: "
       "0.12 m), or tilt above 60°"},
      {"duration_s", &M::duration_s, kSeconds, none, grows, "of the run"},
      {"distance_m", &M::distance_m, kMetres, larger, varies,
       "of the base in the plane, from start to end", kFirst},
      {"speed_mps", &M::speed_mps, kSpeed, larger, varies,
       "of the base in the plane, over the time in which walking was commanded", kFirst},
      {"com_error_max_m", &M::com_error_max_m, kMillimetres, smaller, grows,
       "centre of mass against its plan in the plane, laid by the standing feet; without "
       "calibration",
       kFirst},
      {"com_error_calibrating_max_m", &M::com_error_calibrating_max_m, kMillimetres, smaller, grows,
       "centre of mass against its plan, while it calibrates"},
      {"com_error_rms_m", &M::com_error_rms_m, kMillimetres, smaller, varies,
       "centre of mass against its plan, without calibration"},
      {"com_lateral_sway_m", &M::com_lateral_sway_m, kMillimetres, none, grows,
       "half the range of the centre of mass across the heading, against the feet's centre, while "
       "it walks",
       kFirst},
      {"com_zmp_slack_max_m", &M::com_zmp_slack_max_m, kMillimetres, smaller, grows,
       "of the planned zero-moment point outside the support polygon"},
      {"path_deviation_max_m", &M::path_deviation_max_m, kMillimetres, smaller, grows,
       "of the feet's centre from the commanded path"},
      {"path_deviation_base_max_m", &M::path_deviation_base_max_m, kMillimetres, smaller, grows,
       "of the base, which sways and leans over the feet"},
      {"command_error_rms_mps", &M::command_error_rms_mps, kSpeed, smaller, varies,
       "velocity of the centre of mass against a command unchanged for 3 s"},
      {"turn_error_rms_radps", &M::turn_error_rms_radps, kTurn, smaller, varies,
       "yaw rate of the torso against a command unchanged for 3 s"},
      {"base_height_end_m", &M::base_height_end_m, kMetres, none, varies,
       "base over the mean centre of the standing foot spheres, at the end"},
      {"base_height_error_rms_m", &M::base_height_error_rms_m, kMillimetres, smaller, varies,
       "base against its planned height"},
      {"orientation_error_rms_rad", &M::orientation_error_rms_rad, kDegrees, smaller, varies,
       "angle between the torso and its plan"},
      {"max_tilt_rad", &M::max_tilt_rad, kDegrees, smaller, grows,
       "between the torso's z axis and the vertical, without calibration", kFirst},
      {"max_tilt_calibrating_rad", &M::max_tilt_calibrating_rad, kDegrees, smaller, grows,
       "between the torso's z axis and the vertical while it calibrates, which tilts the torso"},
      {"torso_reference_step_max_rad", &M::torso_reference_step_max_rad, kDegrees, smaller, grows,
       "change of the torso's planned orientation in a tick"},
      {"torso_reference_step_max_m", &M::torso_reference_step_max_m, kMillimetres, smaller, grows,
       "change of the torso's planned height in a tick"},
      {"control_frame_step_max_rad", &M::control_frame_step_max_rad, kDegrees, smaller, grows,
       "turn of the control frame in a tick"},
      {"reach_error_max_m", &M::reach_error_max_m, kMillimetres, smaller, grows,
       "tip of an arm against its plan, both relative to the base, from 6 s after a new command on "
       "(ANYmal B's; by √(l/g))"},
      {"velocity_error_rms_mps", &M::velocity_error_rms_mps, kSpeed, smaller, varies,
       "estimated against true base velocity, in B"},
      {"tilt_error_rms_rad", &M::tilt_error_rms_rad, kDegrees, smaller, varies,
       "angle between the estimated and the true vertical"},
      {"tilt_error_max_rad", &M::tilt_error_max_rad, kDegrees, smaller, grows,
       "angle between the estimated and the true vertical"},
      {"velocity_nees", &M::velocity_nees, kNone, none, varies,
       "squared error of the estimated velocity over its believed variance (NEES), mean a degree "
       "of freedom; 1: as good as believed, above: worse"},
      {"tilt_nees", &M::tilt_nees, kNone, none, varies,
       "squared error of the estimated vertical over its believed variance, as velocity_nees"},
      {"position_drift_m", &M::position_drift_m, kMillimetres, smaller, varies,
       "of the estimated base since the start, at the end"},
      {"heading_drift_rad", &M::heading_drift_rad, kDegrees, smaller, varies,
       "of the estimated heading since the start, at the end"},
      {"touchdown_latency_p95_s", &M::touchdown_latency_p95_s, kMilliseconds, smaller, varies,
       "from a foot's touch to the tick that notices it, 95 %"},
      {"touchdowns_noticed", &M::touchdowns_noticed, kNone, none, grows,
       "true touchdowns, noticed"},
      {"touchdowns_late", &M::touchdowns_late, kNone, smaller, grows,
       "touchdowns noticed more than 30 ms after the touch"},
      {"false_touchdowns", &M::false_touchdowns, kNone, smaller, grows,
       "touchdowns noticed without a touch"},
      {"contact_losses_noticed", &M::contact_losses_noticed, kNone, none, grows,
       "of planned stance feet that had lost the ground"},
      {"contact_losses_missed", &M::contact_losses_missed, kNone, smaller, grows,
       "of planned stance feet that had lost the ground, not noticed"},
      {"contact_losses_false", &M::contact_losses_false, kNone, smaller, grows,
       "losses noticed of a foot that stood"},
      {"contact_loss_latency_p95_s", &M::contact_loss_latency_p95_s, kMilliseconds, smaller, varies,
       "from the last touch to the tick that notices it, 95 %"},
      {"slips_detected", &M::slips_detected, kNone, none, grows, "true slips, detected"},
      {"slips_missed", &M::slips_missed, kNone, smaller, grows, "slips that were not detected"},
      {"slips_false", &M::slips_false, kNone, smaller, grows, "slips detected without one"},
      {"slip_latency_p95_s", &M::slip_latency_p95_s, kMilliseconds, smaller, varies,
       "from a slip's start to the tick that detects it, 95 %"},
      {"steps_taken", &M::steps_taken, kNone, none, grows, "touchdowns, also after a contact loss"},
      {"edge_landings", &M::edge_landings, kNone, smaller, grows, "touchdowns on an edge"},
      {"no_ground_events", &M::no_ground_events, kNone, smaller, grows,
       "feet that returned without ground in reach"},
      {"search_max_s", &M::search_max_s, kMilliseconds, smaller, grows,
       "longest search of a foot for ground"},
      {"foot_slip_max_m", &M::foot_slip_max_m, kMillimetres, smaller, grows,
       "longest tangential path of a foot's contact point in one stance", kFirst},
      {"friction_margin_min", &M::friction_margin_min, kNone, larger, falls,
       "μ − |f_t| / f_n of any standing foot; 0: one slid, be it at a touchdown"},
      {"friction_margin_loaded_min", &M::friction_margin_loaded_min, kNone, larger, falls,
       "μ − |f_t| / f_n of standing feet that carry a tenth of the weight", kFirst},
      {"limb_extension_max_m", &M::limb_extension_max_m, kMetres, smaller, grows,
       "longest leg, hip to the foot sphere's centre"},
      {"penetration_max_m", &M::penetration_max_m, kMillimetres, smaller, grows,
       "of a foot into the ground"},
      {"shank_contacts", &M::shank_contacts, kNone, smaller, grows,
       "times that a thigh, knee or shank began to touch the ground"},
      {"torso_contacts", &M::torso_contacts, kNone, smaller, grows,
       "times that the torso began to touch the ground"},
      {"torque_max_nm", &M::torque_max_nm, kTorque, smaller, grows, "applied at a joint", kFirst},
      {"torque_command_max_nm", &M::torque_command_max_nm, kTorque, smaller, grows,
       "commanded at a joint"},
      {"torque_step_max_nm", &M::torque_step_max_nm, kTorque, smaller, grows,
       "change of a commanded torque in a tick"},
      {"joint_speed_max_radps", &M::joint_speed_max_radps, kJointSpeed, smaller, grows,
       "of a joint"},
      {"cost_of_transport", &M::cost_of_transport, kNone, smaller, varies,
       "positive mechanical work of the joints over weight and way, from the start of walking on; "
       "not for a way shorter than 0.5 m (ANYmal B's; by size)"},
      {"lifted_s", &M::lifted_s, kSeconds, none, grows, "time lifted, with relaxed legs"},
      {"torque_lifted_max_nm", &M::torque_lifted_max_nm, kTorque, smaller, grows,
       "applied at a joint while lifted"},
      {"standing_up_s", &M::standing_up_s, kSeconds, smaller, grows, "time of getting up"},
      {"torque_standing_up_max_nm", &M::torque_standing_up_max_nm, kTorque, smaller, grows,
       "applied at a joint while it got up"},
      {"fallback_ticks", &M::fallback_ticks, kNone, smaller, grows,
       "ticks whose command is not the hierarchy's optimum", kFirst},
      {"tick_us", &M::tick_us, kMicroseconds, smaller, varies, "wall-clock time of a tick", kFirst,
       kByClock},
      {"solve_us", &M::solve_us, kMicroseconds, smaller, varies,
       "wall-clock time of the solver in a tick", Place::with_all, kByClock},
      {"realtime_factor", &M::realtime_factor, kRealTime, larger, varies, "of the simulation",
       Place::with_all, kByClock},
      {"seed", &M::seed, kNone, none, varies, "of all that is random", kTitle},
      {"version", &M::version, kNone, none, varies, "of the program", kTitle},
  };
}

}  // namespace

const std::vector<Metric>& metric_table() {
  static const std::vector<Metric> kTable = all_metrics();
  return kTable;
}

const Metric* find_metric(std::string_view name) {
  const std::vector<Metric>& table = metric_table();
  const auto found = std::ranges::find(table, name.substr(0, name.find('.')), &Metric::name);
  return found == table.end() ? nullptr : &*found;
}

}  // namespace surefoot::evaluation
