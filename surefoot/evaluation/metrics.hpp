#pragma once

#include "surefoot/signals/sensor_reading.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace surefoot::evaluation {

/// Distribution of a time per tick [µs].
struct Quantiles {
  double median = kNaN, p99 = kNaN, max = kNaN;
};

/// Results of a run; metric_table.cpp says what each is. NaN and empty: not measured.
struct Metrics {
  std::optional<bool> succeeded;  ///< empty: not judged
  std::string reason;
  std::optional<bool> goal_reached;
  bool fell = false;
  double duration_s = 0.0;
  double distance_m = 0.0;
  double speed_mps = 0.0;
  double com_error_max_m = kNaN;
  double com_error_calibrating_max_m = kNaN;
  double com_error_rms_m = kNaN;
  double com_lateral_sway_m = kNaN;
  double com_zmp_slack_max_m = 0.0;
  double path_deviation_max_m = kNaN;
  double path_deviation_base_max_m = kNaN;
  double command_error_rms_mps = kNaN;
  double turn_error_rms_radps = kNaN;
  double base_height_end_m = kNaN;
  double base_height_error_rms_m = kNaN;
  double orientation_error_rms_rad = kNaN;
  double max_tilt_rad = kNaN;
  double max_tilt_calibrating_rad = kNaN;
  double torso_reference_step_max_rad = 0.0;
  double torso_reference_step_max_m = 0.0;
  double control_frame_step_max_rad = 0.0;
  double reach_error_max_m = kNaN;
  double velocity_error_rms_mps = kNaN;
  double tilt_error_rms_rad = kNaN;
  double tilt_error_max_rad = kNaN;
  double velocity_nees = kNaN;
  double tilt_nees = kNaN;
  double position_drift_m = kNaN;
  double heading_drift_rad = kNaN;
  double touchdown_latency_p95_s = kNaN;
  int touchdowns_noticed = 0;
  int touchdowns_late = 0;
  int false_touchdowns = 0;
  int contact_losses_noticed = 0;
  int contact_losses_missed = 0;
  int contact_losses_false = 0;
  double contact_loss_latency_p95_s = kNaN;
  int slips_detected = 0;
  int slips_missed = 0;
  int slips_false = 0;
  double slip_latency_p95_s = kNaN;
  int steps_taken = 0;
  int edge_landings = 0;
  int no_ground_events = 0;
  double search_max_s = 0.0;
  double foot_slip_max_m = 0.0;
  double friction_margin_min = kNaN;
  double friction_margin_loaded_min = kNaN;
  double limb_extension_max_m = kNaN;
  double penetration_max_m = 0.0;
  int shank_contacts = 0;
  int torso_contacts = 0;
  double torque_max_nm = 0.0;
  double torque_command_max_nm = 0.0;
  double torque_step_max_nm = 0.0;
  double joint_speed_max_radps = 0.0;
  double cost_of_transport = kNaN;
  double lifted_s = 0.0;
  double torque_lifted_max_nm = kNaN;
  double standing_up_s = 0.0;
  double torque_standing_up_max_nm = kNaN;
  int fallback_ticks = 0;
  Quantiles tick_us;
  Quantiles solve_us;
  double realtime_factor = kNaN;
  std::uint64_t seed = 0;
  std::string version;
};

using MetricValue =
    std::variant<bool, std::optional<bool>, int, double, std::uint64_t, std::string, Quantiles>;

/// All metrics by name, in the order of the table.
[[nodiscard]] std::vector<std::pair<std::string_view, MetricValue>> values(const Metrics& metrics);

/// One JSON object, {"succeeded":true, …, "tick_us":{"median":…,"p99":…,"max":…}, …}; what was not
/// measured becomes null.
[[nodiscard]] std::string to_json(const Metrics& metrics);

}  // namespace surefoot::evaluation
