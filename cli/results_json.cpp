#include "cli/results_json.hpp"

#include "surefoot/base/build_info.hpp"
#include "surefoot/base/formatted.hpp"
#include "surefoot/evaluation/interval.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string_view>

namespace surefoot {
namespace {

using Json = nlohmann::ordered_json;

/// Counted over several seeds.
constexpr std::array<std::string_view, 5> kRates{"succeeded", "fell", "goal_reached", "safety_stop",
                                                 "crashed"};

/// Of these the smallest value is the worst.
constexpr std::array<std::string_view, 5> kMoreIsBetter{"distance_m", "speed_mps",
                                                        "friction_margin_loaded_min",
                                                        "friction_margin_min", "realtime_factor"};

/// What the machine's clock decides, so that it differs between any two runs.
constexpr std::array<std::string_view, 3> kByClock{"tick_us", "solve_us", "realtime_factor"};

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

/// Also where the key is missing, or null: then it is not.
bool is(const Json& run, const char* key) {
  const auto found = run.find(key);
  return found != run.end() && found->is_boolean() && found->get<bool>();
}

Json rate_json(const std::vector<Json>& runs, const char* name) {
  const auto successes =
      std::ranges::count_if(runs, [&](const Json& run) { return is(run, name); });
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

/// Paths of the metrics that are numbers; of a distribution each member, as criteria call them.
std::vector<std::string> numeric_metrics() {
  std::vector<std::string> names;
  for (const auto& [name, example] : values(Metrics())) {
    const std::string metric(name);
    if (std::holds_alternative<double>(example) || std::holds_alternative<int>(example))
      names.push_back(metric);
    if (std::holds_alternative<Quantiles>(example))
      for (const char* member : {".median", ".p99", ".max"}) names.push_back(metric + member);
  }
  return names;
}

bool more_is_better(const std::string& metric) {
  return std::ranges::find(kMoreIsBetter, metric) != kMoreIsBetter.end();
}

bool is_by_clock(const std::string& metric) {
  return std::ranges::find(kByClock, metric.substr(0, metric.find('.'))) != kByClock.end();
}

std::string hex(std::uint64_t number) {
  return formatted("%016llx", static_cast<unsigned long long>(number));
}

/// Median and worst of every metric that is a number.
Json metrics_json(const std::vector<Json>& runs) {
  Json summaries = Json::object();
  for (const std::string& name : numeric_metrics()) {
    std::string path = "/" + name;
    std::ranges::replace(path, '.', '/');
    const Json::json_pointer pointer(path);
    std::vector<double> values;
    for (const Json& run : runs) {
      if (run.contains(pointer) && run.at(pointer).is_number())
        values.push_back(run.at(pointer).get<double>());
    }
    if (values.empty()) continue;
    summaries[name] = summary_json(std::move(values), more_is_better(name));
  }
  return summaries;
}

/// What happened to feet, sensors and torques, in the order in which it happened first.
Json run_events_json(const RunResult& result) {
  std::vector<Json> list;
  for (const EventCount& event : result.events) {
    list.push_back({{"event", name(event.event)},
                    {"leg", event.leg ? Json(kLegNames[index(*event.leg)]) : Json()},
                    {"count", event.count},
                    {"first_s", event.first}});
  }
  for (const TroubleCount& trouble : result.troubles) {
    list.push_back({{"event", trouble.what},
                    {"leg", nullptr},
                    {"count", trouble.count},
                    {"first_s", trouble.first}});
  }
  std::ranges::stable_sort(list, {},
                           [](const Json& event) { return event.at("first_s").get<double>(); });
  return list;
}

/// Each kind of event of several runs, all legs together: in how many runs, and how often in all.
Json event_totals_json(const std::vector<Json>& runs) {
  Json totals = Json::array();
  for (const Json& run : runs) {
    std::set<std::string> seen;
    for (const Json& event : run.value("events", Json::array())) {
      const auto same = [&](const Json& total) { return total["event"] == event["event"]; };
      auto total = std::ranges::find_if(totals, same);
      if (total == totals.end()) {
        totals.push_back({{"event", event["event"]}, {"runs", 0}, {"count", 0}});
        total = totals.end() - 1;
      }
      (*total)["count"] = (*total)["count"].get<int>() + event["count"].get<int>();
      if (seen.insert(event["event"].get<std::string>()).second)
        (*total)["runs"] = (*total)["runs"].get<int>() + 1;
    }
  }
  return totals;
}

/// Without what differs between any two runs.
Json outcome_of(Json run) {
  run.erase("seed");
  for (const std::string_view key : kByClock) run.erase(std::string(key));
  return run;
}

}  // namespace

Json run_json(const Scenario& scenario, const RunResult& result) {
  Json json = heading(scenario);
  json.update(Json::parse(to_json(result.metrics)));
  json["safety_stop"] = result.safety_stop;
  if (result.changes) json["changes_by_hand"] = *result.changes;
  json["criteria"] = criteria_json(result.criteria);
  json["events"] = run_events_json(result);
  json["drawn"] = Json::object();
  for (const RandomDraw& draw : result.drawn) json["drawn"][draw.path] = draw.value;
  json["notes"] = result.notes;
  json["torques_hash"] = hex(result.torques_hash);
  json["sources_hash"] = hex(scenario.sources_hash);
  return json;
}

Json check_json(const Scenario& scenario) {
  Json json = heading(scenario);
  json["version"] = build_info().version;
  json["commit"] = build_info().commit;
  json["sources_hash"] = hex(scenario.sources_hash);
  json["notes"] = scenario.notes;
  json["metrics"] = Json::object();
  for (const std::string& metric : numeric_metrics()) {
    json["metrics"][metric] = {{"worst", more_is_better(metric) ? "least" : "greatest"},
                               {"by_clock", is_by_clock(metric)}};
  }
  return json;
}

Json crash_json(std::uint64_t seed, const std::string& reason) {
  return {{"seed", seed}, {"succeeded", false}, {"crashed", true}, {"reason", reason}};
}

Json seeds_json(const Scenario& scenario, std::vector<Json> runs) {
  Json json = heading(scenario);
  json["version"] = build_info().version;
  const bool has_goal = std::isfinite(scenario.goal.feet_beyond_x);
  for (const std::string_view rate : kRates) {
    if (rate == "goal_reached" && !has_goal) continue;
    json["rates"][std::string(rate)] = rate_json(runs, rate.data());
  }
  json["metrics"] = metrics_json(runs);
  json["events"] = event_totals_json(runs);
  json["runs"] = std::move(runs);
  return json;
}

bool all_the_same(const std::vector<Json>& runs) {
  return runs.size() > 1 && std::ranges::all_of(runs, [&](const Json& run) {
           return !run.contains("crashed") && outcome_of(run) == outcome_of(runs.front());
         });
}

bool enough_succeeded(const Scenario& scenario, const std::vector<Json>& runs) {
  const auto succeeded =
      std::ranges::count_if(runs, [](const Json& run) { return run.value("succeeded", false); });
  return static_cast<double>(succeeded) >= scenario.success_rate * static_cast<double>(runs.size());
}

}  // namespace surefoot
