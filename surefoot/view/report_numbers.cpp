#include "surefoot/view/report_numbers.hpp"

#include "surefoot/view/report_page.hpp"
#include "surefoot/view/svg.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace surefoot::report {
namespace {

// A metric in the unit that people read it in.
struct Quantity {
  std::string_view metric;
  std::string_view name;
  std::string_view basis = "";  // whose number it is
  std::string_view over = "";   // which part of the run; empty: all of it
  double scale = 1.0;
  int decimals = 3;
  std::string_view unit = "";
  bool always_shown = true;  // also where nothing is required of it
};

constexpr std::string_view kTruth = "truth", kTruthPlan = "truth against plan",
                           kTruthCommand = "truth against command",
                           kBelief = "belief against truth", kPlan = "plan", kCommand = "command",
                           kClock = "wall clock", kRunTime = "time of the run";
constexpr std::string_view kWhole = "", kCalibrated = "without calibration",
                           kCalibrating = "calibration alone", kWalking = "while it walks";

constexpr double kDegrees = 57.29577951308232;
constexpr std::array kQuantities{
    Quantity{"goal_reached", "goal reached", kTruth, kWhole},
    Quantity{"fell", "fell", kTruth, kWhole},
    Quantity{"com_error_max_m", "COM tracking error, largest", kTruthPlan, kCalibrated, 1e3, 3,
             "mm"},
    Quantity{"com_error_rms_m", "COM tracking error, rms", kTruthPlan, kCalibrated, 1e3, 3, "mm"},
    Quantity{"com_lateral_sway_m", "lateral COM sway", kTruth, kWalking, 1e3, 1, "mm"},
    Quantity{"com_zmp_slack_max_m", "planned ZMP outside its polygon by", kPlan, kWhole, 1e3, 1,
             "mm", false},
    Quantity{"com_error_calibrating_max_m", "COM tracking error while calibrating, largest",
             kTruthPlan, kCalibrating, 1e3, 3, "mm", false},
    Quantity{"path_deviation_max_m", "distance from the path, largest", kTruthCommand, kWalking,
             1e3, 1, "mm", false},
    Quantity{"path_deviation_base_max_m", "distance of the base from the path, largest",
             kTruthCommand, kWalking, 1e3, 1, "mm", false},
    Quantity{"duration_s", "duration", kRunTime, kWhole, 1.0, 2, "s"},
    Quantity{"distance_m", "distance", kTruth, kWhole, 1.0, 3, "m"},
    Quantity{"speed_mps", "speed", kTruth, kWalking, 1.0, 3, "m/s"},
    Quantity{"steps_taken", "steps", kPlan, kWhole, 1.0, 0},
    Quantity{"no_ground_events", "feet taken back for want of ground", kPlan, kWhole, 1.0, 0},
    Quantity{"edge_landings", "landings on an edge", kTruth, kWhole, 1.0, 0},
    Quantity{"search_max_s", "longest search for ground", kPlan, kWhole, 1.0, 2, "s"},
    Quantity{"orientation_error_rms_rad", "torso orientation error, rms", kTruthPlan, kWhole,
             kDegrees, 2, "°"},
    Quantity{"base_height_error_rms_m", "torso height error, rms", kTruthPlan, kWhole, 1e3, 2,
             "mm"},
    Quantity{"base_height_end_m", "torso above the feet at the end", kTruth, kWhole, 1.0, 3, "m",
             false},
    Quantity{"max_tilt_rad", "largest tilt", kTruth, kCalibrated, kDegrees, 1, "°"},
    Quantity{"max_tilt_calibrating_rad", "largest tilt while calibrating", kTruth, kCalibrating,
             kDegrees, 1, "°"},
    Quantity{"torso_reference_step_max_rad", "largest turn of the torso's reference in a tick",
             kPlan, kCalibrated, kDegrees, 3, "°", false},
    Quantity{"torso_reference_step_max_m", "largest way of the torso's reference in a tick", kPlan,
             kCalibrated, 1e3, 3, "mm", false},
    Quantity{"control_frame_step_max_rad", "largest turn of the control frame in a tick", kPlan,
             kCalibrated, kDegrees, 3, "°", false},
    Quantity{"velocity_error_rms_mps", "error of the believed velocity, rms", kBelief, kWhole, 1.0,
             3, "m/s", false},
    Quantity{"tilt_error_rms_rad", "error of the believed tilt, rms", kBelief, kWhole, kDegrees, 2,
             "°", false},
    Quantity{"tilt_error_max_rad", "error of the believed tilt, largest", kBelief, kWhole, kDegrees,
             2, "°", false},
    Quantity{"position_drift_m", "drift of the believed position", kBelief, kWhole, 1e3, 1, "mm",
             false},
    Quantity{"heading_drift_rad", "drift of the believed heading", kBelief, kWhole, kDegrees, 2,
             "°", false},
    Quantity{"touchdown_latency_p95_s", "touchdowns noticed after, 95 %", kBelief, kWhole, 1.0, 3,
             "s", false},
    Quantity{"touchdowns_noticed", "touchdowns noticed", kBelief, kWhole, 1.0, 0, "", false},
    Quantity{"touchdowns_late", "touchdowns noticed after more than 30 ms", kBelief, kWhole, 1.0, 0,
             "", false},
    Quantity{"false_touchdowns", "touchdowns that were none", kBelief, kWhole, 1.0, 0, "", false},
    Quantity{"contact_losses_noticed", "losses of contact noticed", kBelief, kWhole, 1.0, 0, "",
             false},
    Quantity{"contact_losses_missed", "losses of contact missed", kBelief, kWhole, 1.0, 0, "",
             false},
    Quantity{"contact_losses_false", "losses of contact that were none", kBelief, kWhole, 1.0, 0,
             "", false},
    Quantity{"contact_loss_latency_p95_s", "losses of contact noticed after, 95 %", kBelief, kWhole,
             1.0, 3, "s", false},
    Quantity{"slips_detected", "slips noticed", kBelief, kWhole, 1.0, 0, "", false},
    Quantity{"slips_missed", "slips missed", kBelief, kWhole, 1.0, 0, "", false},
    Quantity{"slips_false", "slips that were none", kBelief, kWhole, 1.0, 0, "", false},
    Quantity{"slip_latency_p95_s", "slips noticed after, 95 %", kBelief, kWhole, 1.0, 3, "s",
             false},
    Quantity{"limb_extension_max_m", "longest leg, hip to foot", kTruth, kWhole, 1.0, 3, "m"},
    Quantity{"torque_max_nm", "largest joint torque", kTruth, kWhole, 1.0, 1, "N·m"},
    Quantity{"torque_command_max_nm", "largest commanded torque", kCommand, kWhole, 1.0, 1, "N·m",
             false},
    Quantity{"torque_step_max_nm", "largest torque step in a tick", kCommand, kWhole, 1.0, 2,
             "N·m"},
    Quantity{"friction_margin_min", "smallest friction margin of any foot", kTruth, kWhole, 1.0, 2,
             "", false},
    Quantity{"friction_margin_loaded_min", "smallest friction margin of a loaded foot", kTruth,
             kWhole, 1.0, 2},
    Quantity{"foot_slip_max_m", "longest slip in a stance", kTruth, kWhole, 1e3, 1, "mm"},
    Quantity{"penetration_max_m", "deepest penetration", kTruth, kWhole, 1e3, 2, "mm"},
    Quantity{"shank_contacts", "shin or knee contacts", kTruth, kWhole, 1.0, 0},
    Quantity{"torso_contacts", "torso contacts", kTruth, kWhole, 1.0, 0, "", false},
    Quantity{"lifted_s", "time off the ground, lifted", kBelief, kWhole, 1.0, 2, "s", false},
    Quantity{"torque_lifted_max_nm", "largest joint torque while lifted", kTruth, kWhole, 1.0, 1,
             "N·m", false},
    Quantity{"standing_up_s", "time to stand up", kBelief, kWhole, 1.0, 2, "s", false},
    Quantity{"torque_standing_up_max_nm", "largest joint torque while standing up", kTruth, kWhole,
             1.0, 1, "N·m", false},
    Quantity{"fallback_ticks", "ticks without the hierarchy's optimum", kCommand, kWhole, 1.0, 0,
             "", false},
    Quantity{"tick_us.median", "time per tick, median", kClock, kWhole, 1.0, 0, "µs"},
    Quantity{"tick_us.p99", "time per tick, 99 %", kClock, kWhole, 1.0, 0, "µs"},
    Quantity{"tick_us.max", "time per tick, longest", kClock, kWhole, 1.0, 0, "µs", false},
    Quantity{"solve_us.median", "of it the solver, median", kClock, kWhole, 1.0, 0, "µs"},
    Quantity{"solve_us.p99", "of it the solver, 99 %", kClock, kWhole, 1.0, 0, "µs", false},
    Quantity{"solve_us.max", "of it the solver, longest", kClock, kWhole, 1.0, 0, "µs", false},
    Quantity{"realtime_factor", "speed of the simulation", kClock, kWhole, 1.0, 1, "× real time"},
};

std::string measure(double value, const Quantity& quantity) {
  return plot::decimal(quantity.scale * value, quantity.decimals) +
         (quantity.unit.empty() || quantity.unit == "°" ? "" : " ") + std::string(quantity.unit);
}

std::string yes_no(bool truth) { return truth ? "yes" : "no"; }

std::string value_text(const Metric* metric, const Quantity& quantity) {
  if (metric == nullptr) return "–";
  if (const bool* truth = std::get_if<bool>(&metric->value)) return yes_no(*truth);
  if (const double* number = std::get_if<double>(&metric->value)) return measure(*number, quantity);
  if (const auto* text = std::get_if<std::string>(&metric->value)) return *text;
  return "–";
}

std::string limits(const Requirement& criterion, const Quantity& quantity) {
  if (criterion.equals) return yes_no(*criterion.equals);
  std::string text;
  if (criterion.min) text = "≥ " + measure(*criterion.min, quantity);
  if (criterion.max) text += (text.empty() ? "≤ " : ", ≤ ") + measure(*criterion.max, quantity);
  return text;
}

Cell required(const Requirement* criterion, const Quantity& quantity) {
  if (criterion == nullptr) return {""};
  const std::string text = limits(*criterion, quantity);
  if (!criterion->passed) return {text + "  (not judged)", "soft"};
  return *criterion->passed ? Cell{text + "  ✓ holds", "good nowrap"}
                            : Cell{text + "  ✗ missed", "bad nowrap"};
}

bool is_compared(const Outcome& outcome, const std::string& metric) {
  return outcome.criterion(metric) != nullptr || outcome.figure_of_paper(metric) != nullptr;
}

// All quantities, and what criteria and paper name besides them, under its own name.
std::vector<Quantity> quantities(const Outcome& outcome) {
  std::vector<Quantity> all(kQuantities.begin(), kQuantities.end());
  const auto add = [&all](const std::string& metric) {
    const auto same = [&](const Quantity& quantity) { return quantity.metric == metric; };
    if (std::ranges::none_of(all, same)) all.push_back({.metric = metric, .name = metric});
  };
  for (const Requirement& criterion : outcome.criteria) add(criterion.metric);
  for (const auto& [metric, figure] : outcome.paper) add(metric);
  std::ranges::stable_partition(all, [&](const Quantity& quantity) {
    return is_compared(outcome, std::string(quantity.metric));
  });
  return all;
}

bool calibrates(const Outcome& outcome) {
  const Metric* metric = outcome.metric("com_error_calibrating_max_m");
  return metric != nullptr && std::holds_alternative<double>(metric->value);
}

std::string basis(const Outcome& outcome, const Quantity& quantity) {
  std::string text(quantity.basis);
  if (quantity.over.empty() || (quantity.over == kCalibrated && !calibrates(outcome))) return text;
  return text + ", " + std::string(quantity.over);
}

std::vector<Cell> row(const Outcome& outcome, const Quantity& quantity) {
  const std::string metric(quantity.metric);
  const std::string* figure = outcome.figure_of_paper(metric);
  return {{std::string(quantity.name)},
          {value_text(outcome.metric(metric), quantity), "number"},
          {basis(outcome, quantity), "basis"},
          required(outcome.criterion(metric), quantity),
          {figure == nullptr ? "" : *figure, "soft"}};
}

// What only a run that calibrates has is left out of others.
bool is_known(const Metric* metric, const Quantity& quantity) {
  if (metric == nullptr) return false;
  return quantity.over != kCalibrating || !std::holds_alternative<std::monostate>(metric->value);
}

constexpr const char* kBases =
    "<p class=\"soft\">Truth is the simulator's, belief the controller's estimate; plan and "
    "command "
    "are the controller's, too. Where nothing else is said a number is of the whole run, with its "
    "calibration.</p>\n";

std::string all_metrics(const Outcome& outcome) {
  std::vector<std::vector<Cell>> rows;
  for (const Metric& metric : outcome.metrics) {
    rows.push_back({{metric.name},
                    {value_text(&metric, {.metric = "", .name = "", .decimals = 6}), "number"}});
  }
  return "<details><summary>All metrics under their names</summary>\n" +
         table({"metric", "value"}, rows) + "</details>\n";
}

}  // namespace

std::string name_of(const std::string& metric) {
  const auto found = std::ranges::find(kQuantities, metric, &Quantity::metric);
  return found == kQuantities.end() ? metric : std::string(found->name);
}

std::string numbers(const Outcome& outcome) {
  std::vector<std::vector<Cell>> rows;
  std::size_t compared = 0;
  for (const Quantity& quantity : quantities(outcome)) {
    const std::string metric(quantity.metric);
    const bool asked = is_compared(outcome, metric);
    const bool shown = quantity.always_shown && is_known(outcome.metric(metric), quantity);
    // Without a goal it is said to be reached.
    if (!asked && (!shown || (metric == "goal_reached" && outcome.goal.empty()))) continue;
    rows.push_back(row(outcome, quantity));
    compared += asked ? 1 : 0;
  }
  return table({"quantity", "this run", "measured on", "required", "paper"}, rows, compared) +
         kBases + (outcome.known ? all_metrics(outcome) : "");
}

}  // namespace surefoot::report
