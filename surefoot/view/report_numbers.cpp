#include "surefoot/view/report_numbers.hpp"

#include "surefoot/view/report_page.hpp"
#include "surefoot/view/svg.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace surefoot::report {
namespace {

using nlohmann::json;

// A line of the table: a metric in the unit that people read it in.
struct Quantity {
  const char* metric;  // "tick_us/median": a member of a distribution
  const char* name;
  double scale;
  int decimals;
  const char* unit;
};

constexpr double kDegrees = 57.29577951308232;
constexpr std::array kQuantities{
    Quantity{"com_error_max_m", "COM tracking error, largest", 1e3, 3, "mm"},
    Quantity{"com_error_rms_m", "COM tracking error, rms", 1e3, 3, "mm"},
    Quantity{"com_lateral_sway_m", "lateral COM sway", 1e3, 1, "mm"},
    Quantity{"duration_s", "duration", 1.0, 2, "s"},
    Quantity{"distance_m", "distance", 1.0, 3, "m"},
    Quantity{"speed_mps", "speed", 1.0, 3, "m/s"},
    Quantity{"steps_taken", "steps", 1.0, 0, ""},
    Quantity{"no_ground_events", "feet taken back for want of ground", 1.0, 0, ""},
    Quantity{"edge_landings", "landings on an edge", 1.0, 0, ""},
    Quantity{"orientation_error_rms_rad", "torso orientation error, rms", kDegrees, 2, "°"},
    Quantity{"base_height_error_rms_m", "torso height error, rms", 1e3, 2, "mm"},
    Quantity{"max_tilt_rad", "largest tilt", kDegrees, 1, "°"},
    Quantity{"limb_extension_max_m", "longest leg, hip to foot", 1.0, 3, "m"},
    Quantity{"torque_max_nm", "largest joint torque", 1.0, 1, "N·m"},
    Quantity{"torque_step_max_nm", "largest torque step in a tick", 1.0, 2, "N·m"},
    Quantity{"friction_margin_loaded_min", "smallest friction margin of a loaded foot", 1.0, 2, ""},
    Quantity{"foot_slip_max_m", "longest slip in a stance", 1e3, 1, "mm"},
    Quantity{"penetration_max_m", "deepest penetration", 1e3, 2, "mm"},
    Quantity{"shank_contacts", "shin or knee contacts", 1.0, 0, ""},
    Quantity{"tick_us/median", "time per tick, median", 1.0, 0, "µs"},
    Quantity{"tick_us/p99", "time per tick, 99 %", 1.0, 0, "µs"},
    Quantity{"solve_us/median", "of it the solver, median", 1.0, 0, "µs"},
    Quantity{"realtime_factor", "speed of the simulation", 1.0, 1, "× real time"},
};

std::string measure(const json& value, double scale, int decimals, const std::string& unit) {
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (!value.is_number()) return "–";
  return plot::decimal(scale * value.get<double>(), decimals) +
         (unit.empty() || unit == "°" ? "" : " ") + unit;
}

const json* criterion_of(const json& summary, const std::string& metric) {
  std::string name = metric;
  std::replace(name.begin(), name.end(), '/', '.');
  for (const json& criterion : summary.at("criteria")) {
    if (criterion.at("metric") == name) return &criterion;
  }
  return nullptr;
}

std::string limits(const json& criterion, const Quantity& quantity) {
  std::string text;
  for (const auto& [member, sign] : {std::pair{"min", "≥ "}, std::pair{"max", "≤ "}}) {
    const auto limit = criterion.find(member);
    if (limit == criterion.end()) continue;
    text += (text.empty() ? "" : ", ") + std::string(sign) +
            measure(*limit, quantity.scale, quantity.decimals, quantity.unit);
  }
  return text;
}

// The scenario's figures of the paper, metric by metric, from all that was set.
json paper_figures(const std::string& options) {
  const json parsed = json::parse(options, nullptr, false);
  const bool has_paper = parsed.is_object() && parsed.contains("paper");
  return has_paper && parsed.at("paper").is_object() ? parsed.at("paper") : json::object();
}

// What the paper says of a metric; empty where it says nothing.
std::string figure_of(const json& paper, const char* metric) {
  const auto found = paper.find(metric);
  if (found == paper.end() || found->is_null()) return "";
  return found->is_string() ? found->get<std::string>() : found->dump();
}

std::vector<Cell> row(const json& summary, const json& paper, const Quantity& quantity,
                      const json& value) {
  Cell required;
  if (const json* criterion = criterion_of(summary, quantity.metric)) {
    const bool passed = criterion->at("passed").get<bool>();
    required = {limits(*criterion, quantity) + (passed ? "  ✓ holds" : "  ✗ missed"),
                passed ? "good" : "bad"};
  }
  return {{quantity.name},
          {measure(value, quantity.scale, quantity.decimals, quantity.unit), "number"},
          required,
          {figure_of(paper, quantity.metric), "soft"}};
}

std::string all_metrics(const json& metrics) {
  std::vector<std::vector<Cell>> rows;
  for (const auto& [name, value] : metrics.items()) {
    rows.push_back(
        {{name}, {value.is_string() ? value.get<std::string>() : value.dump(), "number"}});
  }
  return "<details><summary>All metrics under their names</summary>\n" +
         table({"metric", "value"}, rows) + "</details>\n";
}

// The summary if it is one of a finished run; null otherwise.
json parse(const std::string& summary) {
  json parsed = json::parse(summary, nullptr, false);
  const bool usable =
      parsed.is_object() && parsed.contains("metrics") && parsed.contains("criteria");
  return usable ? parsed : json();
}

}  // namespace

std::string numbers(const std::string& summary, const std::string& options) {
  const json parsed = parse(summary);
  if (parsed.is_null())
    return "<p>The log holds no summary: its run did not end in the usual way.</p>\n";
  const json& metrics = parsed.at("metrics");
  const json paper = paper_figures(options);
  std::vector<std::vector<Cell>> rows;
  for (const Quantity& quantity : kQuantities) {
    const json::json_pointer pointer("/" + std::string(quantity.metric));
    if (!metrics.contains(pointer)) continue;
    rows.push_back(row(parsed, paper, quantity, metrics.at(pointer)));
  }
  return table({"quantity", "this run", "required", "paper"}, rows) + all_metrics(metrics);
}

std::string verdict(const std::string& summary) {
  const json parsed = parse(summary);
  if (parsed.is_null()) return "";
  const json& metrics = parsed.at("metrics");
  const bool succeeded = metrics.value("succeeded", false);
  const std::string reason = metrics.value("reason", std::string());
  return std::string("<div class=\"verdict ") +
         (succeeded ? "good\">✓ all criteria hold" : "bad\">✗ not all criteria hold") +
         "</div>\n<p>" + (reason.empty() ? "" : "How it ended: " + plot::escape(reason) + ".") +
         "</p>\n";
}

}  // namespace surefoot::report
