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

/// Results of a run. The names are those of the program's output and of a scenario's criteria; each
/// carries its unit. All are measured on the simulator's truth, except commanded and planned
/// values. Comparisons with the controller's plan or estimate end when it stops for safety. NaN:
/// not measured.
struct Metrics {
  bool succeeded = false;            ///< all criteria hold
  std::string reason;                ///< why the run ended
  std::optional<bool> goal_reached;  ///< was the scenario's goal reached? Empty without a goal
  /// Torso on the ground, hips < 0.12 m (ANYmal B; 0.21 of the leg) above the mean stance foot, or
  /// tilt > 60°.
  bool fell = false;
  double duration_s = 0.0;
  double distance_m = 0.0;  ///< of the base, in the plane, from start to end
  double speed_mps = 0.0;   ///< the same over the time in which walking was commanded

  /// Centre of mass against its reference, in the plane; the reference relative to the controller's
  /// feet is moved to the true feet (model/belief_frame.hpp). Calibration on the spot counts
  /// separately.
  double com_error_max_m = kNaN;
  double com_error_calibrating_max_m = kNaN;
  double com_error_rms_m = kNaN;
  /// Half the range of the COM across the heading, relative to the feet's centre.
  double com_lateral_sway_m = kNaN;
  double com_zmp_slack_max_m = 0.0;  ///< distance of the planned ZMP outside the support polygon
  /// Distance of the feet's centre from the commanded path (evaluation/path_judge.hpp).
  double path_deviation_max_m = kNaN;
  double path_deviation_base_max_m = kNaN;  ///< of the base, which sways and leans over the feet
  /// Velocity of the COM and yaw rate of the torso against a command that has not changed for 3 s
  /// (evaluation/command_judge.hpp).
  double command_error_rms_mps = kNaN, turn_error_rms_radps = kNaN;
  double base_height_end_m = kNaN;  ///< base above the mean stance foot sphere's centre, at the end
  double base_height_error_rms_m = kNaN;
  double orientation_error_rms_rad = kNaN;  ///< angle between torso and its reference
  /// Between the torso's z axis and the vertical; calibration, which tilts the torso, counts
  /// separately.
  double max_tilt_rad = kNaN;
  double max_tilt_calibrating_rad = kNaN;
  /// Largest change between two ticks, of the torso's orientation reference, its height reference
  /// and the control frame (which friction pyramids may use).
  double torso_reference_step_max_rad = 0.0;
  double torso_reference_step_max_m = 0.0;
  double control_frame_step_max_rad = 0.0;

  /// Tip of an arm against its reference, both relative to the base, from 6 s after a new command
  /// of the operator (ANYmal B's; in proportion to √(l/g)).
  double reach_error_max_m = kNaN;

  double velocity_error_rms_mps = kNaN;  ///< estimated against true base velocity, in B
  double tilt_error_rms_rad = kNaN;      ///< angle between the estimated and the true vertical
  double tilt_error_max_rad = kNaN;
  double position_drift_m = kNaN;         ///< of the estimated way since the start, at the end
  double heading_drift_rad = kNaN;        ///< the same for the heading
  double touchdown_latency_p95_s = kNaN;  ///< from a foot's touch to the tick that notices it
  int touchdowns_noticed = 0;             ///< true ones (evaluation/touchdown_judge.hpp)
  int touchdowns_late = 0;                ///< noticed more than 30 ms after the touch
  int false_touchdowns = 0;               ///< noticed without a touch

  /// Of planned stance feet (evaluation/contact_loss_judge.hpp).
  int contact_losses_noticed = 0;            ///< true ones
  int contact_losses_missed = 0;             ///< true ones, not noticed
  int contact_losses_false = 0;              ///< noticed, but the foot stood
  double contact_loss_latency_p95_s = kNaN;  ///< from the last touch to the tick that notices it

  int slips_detected = 0;            ///< true ones (evaluation/slip_judge.hpp)
  int slips_missed = 0;              ///< true ones, not detected
  int slips_false = 0;               ///< detected without a slip
  double slip_latency_p95_s = kNaN;  ///< from the slip's start to the tick that detects it

  int steps_taken = 0;        ///< touchdowns, also after a contact loss
  int edge_landings = 0;      ///< touchdowns on an edge (evaluation/landing.hpp)
  int no_ground_events = 0;   ///< feet that returned without ground in reach
  double search_max_s = 0.0;  ///< longest search of a foot for ground
  /// Longest tangential path of a stance foot's contact point in one stance.
  double foot_slip_max_m = 0.0;
  /// Margin to slipping: min (μ − |f_t| / f_n) over the stance feet, with true forces and the μ of
  /// each contact. So much less friction would still hold; 0: a foot slid, as it does for a tick or
  /// two at touchdown and lift-off in the best of walks.
  double friction_margin_min = kNaN;
  /// The same over the stance feet that carry at least a tenth of the weight.
  double friction_margin_loaded_min = kNaN;
  double limb_extension_max_m = kNaN;  ///< hip to foot sphere's centre
  double penetration_max_m = 0.0;      ///< of a foot into the ground
  int shank_contacts = 0;  ///< times that a thigh, knee or shank began to touch the ground
  int torso_contacts = 0;  ///< times that the torso did

  double torque_max_nm = 0.0;          ///< applied at a joint
  double torque_command_max_nm = 0.0;  ///< commanded
  double torque_step_max_nm = 0.0;     ///< largest change of a commanded torque between two ticks
  double lifted_s = 0.0;               ///< time lifted, with relaxed legs
  double torque_lifted_max_nm = kNaN;  ///< applied at a joint meanwhile
  double standing_up_s = 0.0;          ///< time of getting up
  double torque_standing_up_max_nm = kNaN;
  int fallback_ticks = 0;  ///< ticks whose command is not the hierarchy's optimum
  Quantiles tick_us;       ///< wall-clock time of a whole tick
  Quantiles solve_us;      ///< of the solver
  double realtime_factor = kNaN;

  std::uint64_t seed = 0;
  std::string version;
};

using MetricValue =
    std::variant<bool, std::optional<bool>, int, double, std::uint64_t, std::string, Quantiles>;

/// All metrics by name, in the order above.
[[nodiscard]] std::vector<std::pair<std::string_view, MetricValue>> values(const Metrics& metrics);

/// One JSON object, {"succeeded":true, …, "tick_us":{"median":…,"p99":…,"max":…}, …}; NaN becomes
/// null.
[[nodiscard]] std::string to_json(const Metrics& metrics);

}  // namespace surefoot::evaluation
