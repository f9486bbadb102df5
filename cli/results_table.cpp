#include "cli/results_table.hpp"

#include "cli/metric_list.hpp"
#include "surefoot/base/formatted.hpp"
#include "surefoot/base/text_table.hpp"
#include "surefoot/evaluation/metric_table.hpp"
#include "surefoot/signals/leg.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace surefoot::cli {
namespace {

using Json = nlohmann::ordered_json;
using Table = std::vector<std::vector<std::string>>;

using evaluation::ShownUnit;

ShownUnit unit_of(const std::string& metric) {
  const evaluation::Metric* known = evaluation::find_metric(metric);
  return known == nullptr ? ShownUnit{} : known->unit;
}

std::string number(double value, const char* format = "%.3g") { return formatted(format, value); }

std::string rounded(double value) {
  if (std::abs(value) < 1e-12) value = 0.0;
  return number(value, std::abs(value) >= 100.0 ? "%.0f" : "%.3g");
}

std::string with_unit(double value, const ShownUnit& unit) {
  const bool is_apart = !unit.name.empty() && !unit.name.starts_with("°");
  return rounded(unit.scale * value) + (is_apart ? " " : "") + std::string(unit.name);
}

std::string asked(const Json& criterion) {
  const ShownUnit unit = unit_of(criterion.at("metric").get<std::string>());
  std::string text;
  if (criterion.contains("equals")) text = criterion["equals"].get<bool>() ? "yes" : "no";
  if (criterion.contains("min")) text = "≥ " + with_unit(criterion["min"].get<double>(), unit);
  if (criterion.contains("max")) {
    text += (text.empty() ? "≤ " : ", ≤ ") + with_unit(criterion["max"].get<double>(), unit);
  }
  const Json& passed = criterion.at("passed");
  return text + (passed.is_null() ? ", not judged" : passed.get<bool>() ? " ✓" : " ✗");
}

std::string paper_of(const config::Scenario& scenario, const std::string& metric) {
  const auto found = std::ranges::find(scenario.paper, metric, &config::PaperFigure::metric);
  return found == scenario.paper.end() ? "" : found->text;
}

std::string title(const config::Scenario& scenario, const Json& json) {
  return json.at("scenario").get<std::string>() + ", robot " + json.at("robot").get<std::string>() +
         ", stack " + json.at("stack").get<std::string>() + ", estimation " +
         json.at("estimation").get<std::string>() +
         (json.at("foot_force_sensor").get<bool>() ? ", foot force sensors" : "") +
         (scenario.description.empty() ? "" : ": " + scenario.description) + "\n";
}

/// Path of the vector that a drawn value belongs to: "sensors.imu.tilt" for
/// "sensors.imu.tilt.roll". Other paths, and those of the initial pose, unchanged.
std::string vector_of(const std::string& path) {
  constexpr std::array<std::string_view, 6> kNames{"x", "y", "z", "roll", "pitch", "yaw"};
  const std::size_t dot = path.rfind('.');
  if (dot == std::string::npos || path.starts_with("initial.")) return path;
  const std::string name = path.substr(dot + 1);
  const bool is_of_leg = std::ranges::find(kHexapodLegNames, name.substr(0, 2)) !=
                         kHexapodLegNames.end();  // and a quadruped's
  return is_of_leg || std::ranges::find(kNames, name) != kNames.end() ? path.substr(0, dot) : path;
}

/// Single values as they are; those of a vector as a count.
std::vector<std::string> drawn_texts(const Json& drawn) {
  std::vector<std::string> texts;
  std::string vector;
  int count = 0;
  for (const auto& [path, value] : drawn.items()) {
    count = vector == vector_of(path) ? count + 1 : 1;
    vector = vector_of(path);
    if (count == 1) {
      texts.push_back(path + " " + number(value.get<double>()));
    } else {
      texts.back() = vector + " (" + std::to_string(count) + " values)";
    }
  }
  return texts;
}

/// The values drawn by the seed; seed 0 draws none.
std::string seed_line(const Json& run) {
  constexpr std::size_t kTextWidth = 110;
  const auto seed = run.at("seed").get<std::uint64_t>();
  if (seed == 0) return "seed 0: nothing of `randomise:` is drawn (--seed 1 draws)";
  std::string text = "seed " + std::to_string(seed), line;
  for (const std::string& drawn : drawn_texts(run.at("drawn"))) {
    const bool is_full = !line.empty() && line.size() + drawn.size() > kTextWidth;
    if (is_full) text += std::exchange(line, "") + ",\n ";
    line += (!line.empty() ? ", " : is_full ? " " : ": ") + drawn;
  }
  return text + line;
}

std::string not_judged(const Json& run) {
  const Json& needed = run.at("judged_after_s");
  const std::string of = needed.is_number() ? " of the " + number(needed.get<double>()) : "";
  return "not judged: " + run.at("reason").get<std::string>() + " after " +
         number(run.at("duration_s").get<double>()) + of + " s that its criteria need\n";
}

std::string verdict(const Json& run) {
  std::string missed;
  for (const Json& criterion : run.at("criteria")) {
    if (criterion.at("passed") != false) continue;
    missed += (missed.empty() ? "; missed: " : ", ") + criterion.at("metric").get<std::string>();
  }
  if (run.at("succeeded").is_null()) return not_judged(run);
  return (run.at("succeeded").get<bool>() ? "succeeded: " : "did not succeed: ") +
         run.at("reason").get<std::string>() + missed + "\n";
}

/// Note that a run was steered, so that its verdict is not of the scenario alone.
std::string steered(const Json& run) {
  const int changes = run.value("changes_by_hand", 0);
  if (changes == 0) return "";
  return "steered by hand: " + std::to_string(changes) +
         (changes == 1 ? " change or push" : " changes and pushes") +
         " while it ran, so this is no verdict on the scenario alone\n";
}

std::string times(int count) { return count == 1 ? "once" : std::to_string(count) + " times"; }

std::string events_of_run(const Json& run) {
  Table table;
  for (const Json& event : run.value("events", Json::array())) {
    table.push_back({event.at("event").get<std::string>(),
                     event.at("leg").is_null() ? "" : event.at("leg").get<std::string>(),
                     times(event.at("count").get<int>()),
                     "first at " + number(event.at("first_s").get<double>(), "%.4f") + " s"});
  }
  return table.empty() ? "" : "\n" + aligned(table);
}

/// The run's criterion for a metric, and whether it holds: "≤ 0.5 mm ✓"; empty without one.
std::string asked_of(const Json& run, const std::string& metric) {
  for (const Json& criterion : run.at("criteria")) {
    const auto name = criterion.at("metric").get<std::string>();
    if (name == metric) return asked(criterion);
    if (name.starts_with(metric + "."))
      return name.substr(metric.size() + 1) + " " + asked(criterion);
  }
  return "";
}

std::string key(int left_out) {
  const std::string more =
      left_out == 0 ? "" : "; --all shows the other " + std::to_string(left_out);
  return "↓ smaller is better, ↑ larger" + more + "; `list metrics` says what each is\n";
}

}  // namespace

std::string pretty(const std::string& metric, const Json& value) {
  if (value.is_null()) return "–";
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (value.is_string()) return value.get<std::string>();
  const bool has_unit = !unit_of(metric).name.empty();
  if (value.is_number_integer() && !has_unit) return std::to_string(value.get<std::int64_t>());
  if (value.is_number()) return with_unit(value.get<double>(), unit_of(metric));
  if (value.at("median").is_null()) return "–";
  const auto member = [&](const char* name) { return value.at(name).get<double>(); };
  return "median " + rounded(member("median")) + ", 99 % " + rounded(member("p99")) + ", max " +
         with_unit(member("max"), unit_of(metric));
}

std::string run_table(const config::Scenario& scenario, const Json& run, bool all) {
  Table table{{"", "measured", "", "must be", "paper"}};
  int left_out = 0;
  for (const evaluation::Metric& metric : evaluation::metric_table()) {
    const std::string name(metric.name);
    const auto found = run.find(name);
    if (found == run.end() || metric.place == evaluation::Place::in_the_title) continue;
    const std::string asked = asked_of(run, name), paper = paper_of(scenario, name);
    const bool is_first = metric.place == evaluation::Place::among_the_first;
    if (all || is_first || !asked.empty() || !paper.empty())
      table.push_back({name, pretty(name, *found), arrow_of(metric), asked, paper});
    else
      ++left_out;
  }
  return title(scenario, run) + seed_line(run) + "\n" + verdict(run) + steered(run) + "\n" +
         aligned(table) + key(left_out) + events_of_run(run);
}

}  // namespace surefoot::cli
