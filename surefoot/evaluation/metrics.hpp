#pragma once

#include "surefoot/signals/sensor_reading.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace surefoot {

/// Distribution of a time per tick [µs].
struct Quantiles {
  double median = kNaN, p99 = kNaN, max = kNaN;
};

/// What a run is judged by. The names are those of the program's output and of a scenario's
/// criteria; each carries its unit. All of it is measured on the simulator's truth, except what is
/// called commanded or planned. What is held against the controller's plan or estimate is that
/// until it stops for safety. What could not be measured is NaN.
struct Metrics {
  bool succeeded = false;            ///< all criteria hold
  std::string reason;                ///< why the run ended
  std::optional<bool> goal_reached;  ///< what the scenario is for was done; empty if it names none
  bool fell =
      false;  ///< torso on the ground, base < 0.12 m above the mean stance foot, or tilt > 60°
  double duration_s = 0.0;
  double distance_m = 0.0;  ///< of the base, in the plane, from start to end
  double speed_mps = 0.0;   ///< the same over the time in which walking was commanded

  /// Centre of mass against the desired one, in the plane; what the controller desires relative to
  /// its feet is taken to the true feet (evaluation/belief_frame.hpp). While the robot calibrates
  /// itself on the spot the error counts apart.
  double com_error_max_m = kNaN;
  double com_error_calibrating_max_m = kNaN;
  double com_error_rms_m = kNaN;
  double com_lateral_sway_m =
      kNaN;  ///< half the range of the COM across the heading, seen from the feet's centre
  double com_zmp_slack_max_m = 0.0;  ///< how far the planned ZMP had to leave the support polygon
  /// Of the feet's centre from the commanded path, across it (evaluation/path_judge.hpp) …
  double path_deviation_max_m = kNaN;
  double path_deviation_base_max_m = kNaN;  ///< … and of the base, which sways and leans over them
  double base_height_end_m = kNaN;  ///< base above the mean stance foot sphere's centre, at the end
  double base_height_error_rms_m = kNaN;
  double orientation_error_rms_rad = kNaN;  ///< angle between torso and its reference
  /// Between the torso's z axis and the vertical; while the robot calibrates itself, and tilts to
  /// do so, it counts apart.
  double max_tilt_rad = kNaN;
  double max_tilt_calibrating_rad = kNaN;
  /// Largest change between two ticks, of the torso's reference and of the friction pyramids' frame
  /// (of the control frame, whichever axes they have).
  double torso_reference_step_max_rad = 0.0;
  double torso_reference_step_max_m = 0.0;  ///< … of the reference's height
  double control_frame_step_max_rad = 0.0;

  double velocity_error_rms_mps = kNaN;  ///< believed base velocity against the true one, in B
  double tilt_error_rms_rad = kNaN;      ///< angle between the believed vertical and the true one
  double tilt_error_max_rad = kNaN;
  double position_drift_m = kNaN;         ///< of the believed way since the start, at the end
  double heading_drift_rad = kNaN;        ///< the same of the heading
  double touchdown_latency_p95_s = kNaN;  ///< from a foot's touch to the tick that notices it
  int touchdowns_noticed = 0;             ///< true ones (evaluation/touchdown_judge.hpp)
  int touchdowns_late = 0;                ///< of these, more than 30 ms after the touch
  int false_touchdowns = 0;               ///< noticed, but not there

  /// Of feet that were to stand (evaluation/contact_loss_judge.hpp): true losses of the ground that
  /// were noticed …
  int contact_losses_noticed = 0;
  int contact_losses_missed = 0;             ///< … that were not
  int contact_losses_false = 0;              ///< noticed, but the foot stood
  double contact_loss_latency_p95_s = kNaN;  ///< from the last touch to the tick that notices it

  int slips_detected = 0;            ///< true slips that were noticed (evaluation/slip_judge.hpp)
  int slips_missed = 0;              ///< … that were not
  int slips_false = 0;               ///< noticed, but not there
  double slip_latency_p95_s = kNaN;  ///< from a foot's sliding to the tick that notices it

  int steps_taken = 0;        ///< feet that came to stand, also those that had lost their ground
  int edge_landings = 0;      ///< of these, on an edge (evaluation/landing.hpp)
  int no_ground_events = 0;   ///< feet that were taken back because there was no ground in reach
  double search_max_s = 0.0;  ///< longest time in which a foot looked for ground
  double foot_slip_max_m =
      0.0;  ///< longest tangential path of a stance foot's contact point in one stance
  /// How far the robot was from slipping: min (μ − |f_t| / f_n) over the stance feet, with true
  /// forces and the μ of each contact. By so much the ground could have been more slippery; 0: a
  /// foot slid, as it does for a tick or two at touchdown and lift-off in the best of walks.
  double friction_margin_min = kNaN;
  /// The same over the stance feet that carry at least a tenth of the weight.
  double friction_margin_loaded_min = kNaN;
  double limb_extension_max_m = kNaN;  ///< hip to foot sphere's centre
  double penetration_max_m = 0.0;      ///< of a foot into the ground
  int shank_contacts = 0;  ///< times that a thigh, knee or shank came to touch the ground
  int torso_contacts = 0;  ///< times that the torso did

  double torque_max_nm = 0.0;          ///< applied at a joint
  double torque_command_max_nm = 0.0;  ///< commanded
  double torque_step_max_nm = 0.0;     ///< largest change of a commanded torque between two ticks
  double lifted_s = 0.0;               ///< for which it hung, its legs relaxed
  double torque_lifted_max_nm = kNaN;  ///< applied at a joint meanwhile
  double standing_up_s = 0.0;          ///< for which it got up: from its belly, or put down
  double torque_standing_up_max_nm = kNaN;
  int fallback_ticks = 0;  ///< ticks whose command is not the hierarchy's optimum
  Quantiles tick_us;       ///< wall-clock time of a whole tick
  Quantiles solve_us;      ///< of the solver in it
  double realtime_factor = kNaN;

  std::uint64_t seed = 0;
  std::string version;
};

using MetricValue =
    std::variant<bool, std::optional<bool>, int, double, std::uint64_t, std::string, Quantiles>;

/// All metrics under their names, in the order above.
[[nodiscard]] std::vector<std::pair<std::string_view, MetricValue>> values(const Metrics& metrics);

/// One JSON object, {"succeeded":true, …, "tick_us":{"median":…,"p99":…,"max":…}, …}; NaN becomes
/// null.
[[nodiscard]] std::string to_json(const Metrics& metrics);

}  // namespace surefoot
