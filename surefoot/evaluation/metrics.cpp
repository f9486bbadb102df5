#include "surefoot/evaluation/metrics.hpp"

#include "surefoot/logging/json_text.hpp"

namespace surefoot::evaluation {
namespace {

void write(logging::JsonText& json, const MetricValue& value) {
  std::visit(
      [&json](const auto& content) {
        using T = std::decay_t<decltype(content)>;
        if constexpr (std::is_same_v<T, Quantiles>) {
          json.object().member("median", content.median).member("p99", content.p99);
          json.member("max", content.max).end_object();
        } else if constexpr (std::is_same_v<T, std::string>) {
          json.value(std::string_view(content));
        } else if constexpr (std::is_same_v<T, std::optional<bool>>) {
          content ? json.value(*content) : json.null();
        } else {
          json.value(content);
        }
      },
      value);
}

}  // namespace

std::vector<std::pair<std::string_view, MetricValue>> values(const Metrics& metrics) {
  return {
      {"succeeded", metrics.succeeded},
      {"reason", metrics.reason},
      {"goal_reached", metrics.goal_reached},
      {"fell", metrics.fell},
      {"duration_s", metrics.duration_s},
      {"distance_m", metrics.distance_m},
      {"speed_mps", metrics.speed_mps},
      {"com_error_max_m", metrics.com_error_max_m},
      {"com_error_calibrating_max_m", metrics.com_error_calibrating_max_m},
      {"com_error_rms_m", metrics.com_error_rms_m},
      {"com_lateral_sway_m", metrics.com_lateral_sway_m},
      {"com_zmp_slack_max_m", metrics.com_zmp_slack_max_m},
      {"path_deviation_max_m", metrics.path_deviation_max_m},
      {"path_deviation_base_max_m", metrics.path_deviation_base_max_m},
      {"command_error_rms_mps", metrics.command_error_rms_mps},
      {"turn_error_rms_radps", metrics.turn_error_rms_radps},
      {"base_height_end_m", metrics.base_height_end_m},
      {"base_height_error_rms_m", metrics.base_height_error_rms_m},
      {"orientation_error_rms_rad", metrics.orientation_error_rms_rad},
      {"max_tilt_rad", metrics.max_tilt_rad},
      {"max_tilt_calibrating_rad", metrics.max_tilt_calibrating_rad},
      {"torso_reference_step_max_rad", metrics.torso_reference_step_max_rad},
      {"torso_reference_step_max_m", metrics.torso_reference_step_max_m},
      {"control_frame_step_max_rad", metrics.control_frame_step_max_rad},
      {"reach_error_max_m", metrics.reach_error_max_m},
      {"velocity_error_rms_mps", metrics.velocity_error_rms_mps},
      {"tilt_error_rms_rad", metrics.tilt_error_rms_rad},
      {"tilt_error_max_rad", metrics.tilt_error_max_rad},
      {"position_drift_m", metrics.position_drift_m},
      {"heading_drift_rad", metrics.heading_drift_rad},
      {"touchdown_latency_p95_s", metrics.touchdown_latency_p95_s},
      {"touchdowns_noticed", metrics.touchdowns_noticed},
      {"touchdowns_late", metrics.touchdowns_late},
      {"false_touchdowns", metrics.false_touchdowns},
      {"contact_losses_noticed", metrics.contact_losses_noticed},
      {"contact_losses_missed", metrics.contact_losses_missed},
      {"contact_losses_false", metrics.contact_losses_false},
      {"contact_loss_latency_p95_s", metrics.contact_loss_latency_p95_s},
      {"slips_detected", metrics.slips_detected},
      {"slips_missed", metrics.slips_missed},
      {"slips_false", metrics.slips_false},
      {"slip_latency_p95_s", metrics.slip_latency_p95_s},
      {"steps_taken", metrics.steps_taken},
      {"edge_landings", metrics.edge_landings},
      {"no_ground_events", metrics.no_ground_events},
      {"search_max_s", metrics.search_max_s},
      {"foot_slip_max_m", metrics.foot_slip_max_m},
      {"friction_margin_min", metrics.friction_margin_min},
      {"friction_margin_loaded_min", metrics.friction_margin_loaded_min},
      {"limb_extension_max_m", metrics.limb_extension_max_m},
      {"penetration_max_m", metrics.penetration_max_m},
      {"shank_contacts", metrics.shank_contacts},
      {"torso_contacts", metrics.torso_contacts},
      {"torque_max_nm", metrics.torque_max_nm},
      {"torque_command_max_nm", metrics.torque_command_max_nm},
      {"torque_step_max_nm", metrics.torque_step_max_nm},
      {"lifted_s", metrics.lifted_s},
      {"torque_lifted_max_nm", metrics.torque_lifted_max_nm},
      {"standing_up_s", metrics.standing_up_s},
      {"torque_standing_up_max_nm", metrics.torque_standing_up_max_nm},
      {"fallback_ticks", metrics.fallback_ticks},
      {"tick_us", metrics.tick_us},
      {"solve_us", metrics.solve_us},
      {"realtime_factor", metrics.realtime_factor},
      {"seed", metrics.seed},
      {"version", metrics.version},
  };
}

std::string to_json(const Metrics& metrics) {
  std::string out;
  logging::JsonText json(out);
  json.object();
  for (const auto& [name, value] : values(metrics)) {
    json.key(name);
    write(json, value);
  }
  json.end_object();
  return out;
}

}  // namespace surefoot::evaluation
