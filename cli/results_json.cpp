#include "cli/results_json.hpp"

#include "cli/metric_list.hpp"
#include "surefoot/base/build_info.hpp"
#include "surefoot/base/formatted.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace surefoot::cli {
namespace {

using Json = nlohmann::ordered_json;

/// What a result depends on, of which robot it is; says so if the estimate is the truth, or uses
/// sensors that the robot lacks.
Json heading(const config::Scenario& scenario) {
  return {{"scenario", scenario.name},
          {"robot", scenario.robot.name},
          {"stack", scenario.controller.stack.name},
          {"estimation", name(scenario.estimation)},
          {"foot_force_sensor", scenario.controller.contact_force.use_foot_sensor}};
}

Json criteria_json(const std::vector<evaluation::CriterionResult>& results) {
  Json list = Json::array();
  for (const evaluation::CriterionResult& result : results) {
    Json entry{{"metric", result.criterion.metric}};
    if (result.criterion.min) entry["min"] = *result.criterion.min;
    if (result.criterion.max) entry["max"] = *result.criterion.max;
    if (result.criterion.equals) entry["equals"] = *result.criterion.equals;
    entry["value"] = result.value;
    entry["passed"] = result.passed ? Json(*result.passed) : Json();
    list.push_back(entry);
  }
  return list;
}

std::string hex(std::uint64_t number) {
  return formatted("%016llx", static_cast<unsigned long long>(number));
}

/// Events of feet, sensors and torques, by their first times.
Json run_events_json(const closed_loop::RunResult& result, int num_legs) {
  std::vector<Json> list;
  for (const evaluation::EventCount& event : result.events) {
    list.push_back({{"event", name(event.event)},
                    {"leg", event.leg ? Json(leg_name(*event.leg, num_legs)) : Json()},
                    {"count", event.count},
                    {"first_s", event.first}});
  }
  for (const closed_loop::TroubleCount& trouble : result.troubles) {
    list.push_back({{"event", trouble.what},
                    {"leg", nullptr},
                    {"count", trouble.count},
                    {"first_s", trouble.first}});
  }
  std::ranges::stable_sort(list, {},
                           [](const Json& event) { return event.at("first_s").get<double>(); });
  return list;
}

}  // namespace

Json run_json(const config::Scenario& scenario, const closed_loop::RunResult& result) {
  Json json = heading(scenario);
  json.update(Json::parse(to_json(result.metrics)));
  json["judged_after_s"] = scenario.judged_after;
  json["safety_stop"] = result.safety_stop;
  if (result.changes) json["changes_by_hand"] = *result.changes;
  json["criteria"] = criteria_json(result.criteria);
  json["events"] = run_events_json(result, scenario.robot.num_legs());
  json["drawn"] = Json::object();
  for (const config::RandomDraw& draw : result.drawn) json["drawn"][draw.path] = draw.value;
  json["notes"] = result.notes;
  json["torques_hash"] = hex(result.torques_hash);
  json["sources_hash"] = hex(scenario.sources_hash);
  return json;
}

Json check_json(const config::Scenario& scenario) {
  Json json = heading(scenario);
  json["version"] = build_info().version;
  json["commit"] = build_info().commit;
  json["sources_hash"] = hex(scenario.sources_hash);
  json["notes"] = scenario.notes;
  json["description"] = scenario.description;
  json["has_goal"] = std::isfinite(scenario.goal.feet_beyond_x);
  json["success_rate"] = scenario.success_rate;
  json["paper"] = Json::object();
  for (const config::PaperFigure& figure : scenario.paper)
    json["paper"][figure.metric] = figure.text;
  json["metrics"] = numbers_json();
  return json;
}

}  // namespace surefoot::cli
