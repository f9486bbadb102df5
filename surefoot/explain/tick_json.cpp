#include "surefoot/evaluation/estimate_fields.hpp"
#include "surefoot/evaluation/truth_fields.hpp"
#include "surefoot/explain/explanation_json.hpp"
#include "surefoot/explain/gave_way.hpp"
#include "surefoot/explain/lying_text.hpp"
#include "surefoot/logging/hierarchy_status.hpp"
#include "surefoot/logging/logged_model.hpp"
#include "surefoot/logging/message_codec.hpp"
#include "surefoot/logging/stop_text.hpp"
#include "surefoot/math/rotation.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace surefoot::explain {
namespace {

using Json = nlohmann::ordered_json;

template <typename Signal>
Json message(const Signal& signal) {
  std::string text;
  logged::encode(signal, text);
  return Json::parse(text);
}

/// NaN is null.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json yielding_levels(const TickExplanation& explanation) {
  Json list = Json::array();
  for (const LevelThatGaveWay& level : gave_way(explanation)) {
    Json to = Json::array();
    for (const CostlyRow& row : level.to) {
      to.push_back({{"level", row.level}, {"row", row.row}, {"cost", number(row.cost)}});
      for (const CostlyRow& same : row.same)
        to.back()["same"].push_back({{"level", same.level}, {"row", same.row}});
    }
    list.push_back({{"level", level.name},
                    {"residual", level.residual},
                    {"unit", level.unit},
                    {"never_content", level.is_minimised},
                    {"to", std::move(to)}});
  }
  return list;
}

Json feet_json(const TickExplanation& explanation) {
  const TickRecord& tick = explanation.tick;
  const bool is_solved = logging::was_used(tick);
  Json feet = Json::object();
  for (const Leg leg : tick.plan.feet.legs()) {
    const std::size_t k = index(leg);
    const FootPlan& foot = tick.plan.feet[k];
    Json one = {
        {"phase",
         is_solved ? Json(logged::kPhaseNames[static_cast<std::size_t>(foot.phase)]) : Json()},
        {"normal_force", number(explanation.forces.normal[k])},
        {"friction_use", number(explanation.forces.friction_use[k])}};
    if (explanation.truth) {
      const simulation::TrueContact& contact = explanation.truth->feet[k];
      one["true_normal_force"] = contact.normal.dot(contact.force);
      one["true_friction_use"] =
          number(true_friction_use(contact, explanation.header.robot.least_load()));
    }
    feet[leg_name(leg, explanation.header.robot.num_legs)] = std::move(one);
  }
  return feet;
}

/// Of a level that was not solved there are name and unit.
Json levels_json(const TickExplanation& explanation) {
  const HierarchyReport& report = explanation.tick.hierarchy;
  Json list = Json::array();
  if (!logging::was_used(explanation.tick)) return list;
  const std::size_t solved = logging::solved_levels(explanation.tick, explanation.order).size();
  for (const std::int16_t number_of_level : explanation.order) {
    const auto k = static_cast<std::size_t>(number_of_level);
    const LevelReport& level = report.levels[k];
    const auto known = [is_solved = list.size() < solved](const Json& value) {
      return is_solved ? value : Json();
    };
    list.push_back({{"name", explanation.header.level_name(number_of_level)},
                    {"unit", explanation.header.level_unit(number_of_level)},
                    {"status", logging::name_of(level_status(explanation, list.size()))},
                    {"residual", known(number(level.residual))},
                    {"rows", known(level.num_rows)},
                    {"at_bound", known(level.num_active)},
                    {"freedom_left", known(level.degrees_of_freedom_left)},
                    {"iterations", known(level.iterations)},
                    {"time_us", known(number(level_time(explanation, k)))}});
  }
  return list;
}

/// Rows have something to say; otherwise null.
bool is_any_level_solved(const TickExplanation& explanation) {
  const bool is_any_solved = !logging::solved_levels(explanation.tick, explanation.order).empty();
  return logging::was_used(explanation.tick) && (is_any_solved || explanation.order.empty());
}

Json row_json(const TickExplanation& explanation, std::int16_t level, std::int32_t id) {
  return {{"level", explanation.header.level_name(level)},
          {"row", row_name(explanation, level, id)}};
}

/// Of the levels that were solved.
Json missed_json(const TickExplanation& explanation) {
  if (!is_any_level_solved(explanation)) return {};
  Json list = Json::array();
  for (const MissedEquality& row : missed_rows(explanation)) {
    list.push_back(row_json(explanation, row.level, row.id));
    list.back()["by"] = number(row.by);
  }
  return list;
}

/// The same.
Json limits_json(const TickExplanation& explanation) {
  if (!is_any_level_solved(explanation)) return {};
  Json list = Json::array();
  for (const ActiveRow& row : rows_at_bounds(explanation)) {
    list.push_back(row_json(explanation, row.level, row.id));
    list.back()["bound"] = row.state < 0 ? "lower" : "upper";
    list.back()["beyond"] = std::abs(row.state) > 1;
    list.back()["by"] = number(row.by);
  }
  return list;
}

/// Null of a tick that is in no blend of two hierarchies.
Json blend_json(const TickExplanation& explanation) {
  if (!explanation.blend) return {};
  const HierarchyBlend& blend = *explanation.blend;
  const auto time_of = [](const std::optional<NeighbourTick>& tick) {
    return tick ? Json(tick->tick.reading.time) : Json();
  };
  return {{"share", explanation.tick.hierarchy.transition_share},
          {"until", number(blend.until)},
          {"change", blend.change},
          {"before", time_of(blend.before)},
          {"behind", time_of(blend.after)}};
}

Json applied_json(const TickExplanation& explanation) {
  Json list = Json::array();
  for (const logging::AppliedForce& force : explanation.applied)
    list.push_back({{"body", force.body < explanation.bodies.size() ? explanation.bodies[force.body]
                                                                    : std::to_string(force.body)},
                    {"force", {force.force.x(), force.force.y(), force.force.z()}},
                    {"size", force.force.norm()},
                    {"angle_from_ahead", number(logging::angle_from_ahead(force))}});
  return list;
}

}  // namespace

Json events_json(const std::vector<NearbyEvent>& events) {
  Json list = Json::array();
  for (const NearbyEvent& event : events)
    list.push_back({{"time", event.time},
                    {"text", event.text},
                    {"leg", event.leg.empty() ? Json() : Json(event.leg)},
                    {"by", event.by}});
  return list;
}

Json gave_way_json(const TickExplanation& explanation) {
  Json levels = yielding_levels(explanation);
  const std::vector<LevelThatGaveWay> gave = gave_way(explanation);
  for (std::size_t i = 0; i < levels.size(); ++i) levels[i]["told"] = gave[i].num_shown;
  return {{"time", explanation.tick.reading.time},
          {"sentence", explanation.sentence()},
          {"gave_way", std::move(levels)},
          {"costs_are_exact", explanation.exact.has_value()},
          {"why_estimates", explanation.why_estimates}};
}

Json explanation_json(const TickExplanation& explanation) {
  const TickRecord& tick = explanation.tick;
  const bool is_solved = logging::was_used(tick);
  const bool is_exact = explanation.exact.has_value();
  const Mat3 R_WB = tick.state.q_WB.toRotationMatrix();
  Json json = {
      {"log", explanation.log},
      {"scenario", explanation.header.scenario},
      {"seed", explanation.header.seed},
      {"stack", explanation.header.stack},
      {"asked", explanation.asked},
      {"time", tick.reading.time},
      {"solved", is_solved},
      {"sentence", explanation.sentence()},
      {"gave_way", yielding_levels(explanation)},
      {"costs_are_exact", is_exact},
      {"blocking_is_known", tick.hierarchy.blocking_is_known || is_exact},
      {"blend", blend_json(explanation)},
      {"tilt", number(std::acos(std::clamp(R_WB(2, 2), -1.0, 1.0)))},
      {"feet", feet_json(explanation)},
      {"levels", levels_json(explanation)},
      {"limits", limits_json(explanation)},
      {"missed", missed_json(explanation)},
      {"events", events_json(explanation.events)},
      {"why_stopped", logging::text_of_stop(tick, explanation.header.robot.joints())},
      {"readings", message(tick.reading)},
      {"health", message(tick.health)},
      {"user", message(tick.user)},
      {"state", message(tick.state)},
      {"plan", is_solved ? message(tick.plan) : Json()},
      {"model",
       is_solved ? message(logged::model_of(tick, explanation.header.robot.least_load())) : Json()},
      {"command", message(tick.command)}};
  if (explanation.touch) json["lies_on"] = lying_text(*explanation.touch);
  if (explanation.truth) json["pushed_by"] = applied_json(explanation);
  if (explanation.truth) json["truth"] = message(*explanation.truth);
  if (explanation.estimate) json["estimate"] = message(*explanation.estimate);
  if (!explanation.why_estimates.empty()) json["why_estimates"] = explanation.why_estimates;
  if (!explanation.problem.empty()) json["problem"] = explanation.problem;
  return json;
}

std::string TickExplanation::json() const { return text_of(explanation_json(*this)); }

}  // namespace surefoot::explain
