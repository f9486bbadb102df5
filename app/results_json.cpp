#include "app/results_json.hpp"

#include "surefoot/evaluation/interval.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <string_view>

namespace surefoot {
namespace {

using Json = nlohmann::ordered_json;

/// Counted over several seeds.
constexpr std::array<const char*, 5> kRates{"succeeded", "fell", "goal_reached", "safety_stop",
                                            "crashed"};

/// Of these the smallest value is the worst.
constexpr std::array<std::string_view, 5> kMoreIsBetter{"distance_m", "speed_mps",
                                                        "friction_margin_loaded_min",
                                                        "friction_margin_min", "realtime_factor"};

/// What a result must say of itself: truth and sensors that the robot does not have are no secret.
Json heading(const Scenario& scenario) {
  return {{"scenario", scenario.name},
          {"stack", scenario.controller.stack.name},
          {"estimation", name(scenario.estimation)},
          {"foot_force_sensor", scenario.controller.contact_force.use_foot_sensor}};
}

Json criteria_json(const std::vector<CriterionResult>& results) {
  Json list = Json::array();
  for (const CriterionResult& result : results) {
    Json entry{{"metric", result.criterion.metric}};
    if (result.criterion.min) entry["min"] = *result.criterion.min;
    if (result.criterion.max) entry["max"] = *result.criterion.max;
    if (result.criterion.equals) entry["equals"] = *result.criterion.equals;
    entry["value"] = result.value;
    entry["passed"] = result.passed;
    list.push_back(entry);
  }
  return list;
}

Json rate_json(const std::vector<Json>& runs, const char* name) {
  const auto successes =
      std::ranges::count_if(runs, [&](const Json& run) { return run.value(name, false); });
  const auto trials = static_cast<int>(runs.size());
  const Interval interval = wilson_interval(static_cast<int>(successes), trials);
  return {
      {"successes", successes}, {"trials", trials}, {"interval", {interval.low, interval.high}}};
}

Json summary_json(std::vector<double> values, bool more_is_better) {
  std::ranges::sort(values);
  const std::size_t half = values.size() / 2;
  const double median =
      values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2.0;
  return {{"median", median}, {"worst", more_is_better ? values.front() : values.back()}};
}

/// Median and worst of every metric that is a number.
Json metrics_json(const std::vector<Json>& runs) {
  Json summaries = Json::object();
  for (const auto& [name, example] : values(Metrics())) {
    if (!std::holds_alternative<double>(example) && !std::holds_alternative<int>(example)) continue;
    std::vector<double> values;
    for (const Json& run : runs) {
      const auto value = run.find(std::string(name));
      if (value != run.end() && value->is_number()) values.push_back(value->get<double>());
    }
    if (values.empty()) continue;
    const bool more_is_better = std::ranges::find(kMoreIsBetter, name) != kMoreIsBetter.end();
    summaries[std::string(name)] = summary_json(std::move(values), more_is_better);
  }
  return summaries;
}

}  // namespace

Json run_json(const Scenario& scenario, const RunResult& result) {
  Json json = heading(scenario);
  json.update(Json::parse(to_json(result.metrics)));
  json["safety_stop"] = result.safety_stop;
  json["criteria"] = criteria_json(result.criteria);
  json["drawn"] = Json::object();
  for (const RandomDraw& draw : result.drawn) json["drawn"][draw.path] = draw.value;
  json["notes"] = result.notes;
  return json;
}

Json crash_json(std::uint64_t seed, const std::string& reason) {
  return {{"seed", seed}, {"succeeded", false}, {"crashed", true}, {"reason", reason}};
}

Json seeds_json(const Scenario& scenario, std::vector<Json> runs) {
  Json json = heading(scenario);
  for (const char* rate : kRates) json["rates"][rate] = rate_json(runs, rate);
  json["metrics"] = metrics_json(runs);
  json["runs"] = std::move(runs);
  return json;
}

bool enough_succeeded(const Scenario& scenario, const std::vector<Json>& runs) {
  const auto succeeded =
      std::ranges::count_if(runs, [](const Json& run) { return run.value("succeeded", false); });
  return static_cast<double>(succeeded) >= scenario.success_rate * static_cast<double>(runs.size());
}

}  // namespace surefoot
