#include "surefoot/view/outcome.hpp"

#include "surefoot/view/svg.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace surefoot::report {
namespace {

using json = nlohmann::ordered_json;

json parse(const std::string& text) {
  json parsed = json::parse(text, nullptr, false);
  return parsed.is_object() ? parsed : json::object();
}

json member(const json& object, const char* name) {
  const auto found = object.find(name);
  return found != object.end() && found->is_object() ? *found : json::object();
}

/// Null where the run had no such thing, as a goal.
bool is_true(const json& metrics, const char* name) {
  const auto found = metrics.find(name);
  return found != metrics.end() && found->is_boolean() && found->get<bool>();
}

Metric metric_of(const std::string& name, const json& value) {
  if (value.is_boolean()) return {name, value.get<bool>()};
  if (value.is_number()) return {name, value.get<double>()};
  if (value.is_string()) return {name, value.get<std::string>()};
  return {name, std::monostate()};
}

std::vector<Metric> read_metrics(const json& metrics) {
  std::vector<Metric> result;
  for (const auto& [name, value] : metrics.items()) {
    if (!value.is_object()) result.push_back(metric_of(name, value));
    if (!value.is_object()) continue;
    for (const auto& [part, number] : value.items())
      result.push_back(metric_of(name + "." + part, number));
  }
  return result;
}

template <typename T>
std::optional<T> optional(const json& object, const char* name) {
  const auto found = object.find(name);
  return found == object.end() || found->is_null() ? std::nullopt : std::optional(found->get<T>());
}

std::vector<Requirement> judged(const json& criteria) {
  std::vector<Requirement> result;
  for (const json& one : criteria) {
    result.push_back({.metric = one.at("metric").get<std::string>(),
                      .min = optional<double>(one, "min"),
                      .max = optional<double>(one, "max"),
                      .equals = optional<bool>(one, "equals"),
                      .passed = optional<bool>(one, "passed")});
  }
  return result;
}

// As the scenario gives them: `fell: false`, `speed_mps: {min: 0.18}`.
std::vector<Requirement> asked(const json& criteria) {
  std::vector<Requirement> result;
  for (const auto& [metric, limit] : criteria.items()) {
    Requirement one{.metric = metric, .min = {}, .max = {}, .equals = {}, .passed = {}};
    if (limit.is_boolean()) one.equals = limit.get<bool>();
    if (limit.is_object()) one.min = optional<double>(limit, "min");
    if (limit.is_object()) one.max = optional<double>(limit, "max");
    if (one.min || one.max || one.equals) result.push_back(one);
  }
  return result;
}

std::string goal_of(const json& goal) {
  const std::optional<double> beyond = optional<double>(goal, "feet_beyond_x");
  if (!beyond) return "";
  const double walk_on = optional<double>(goal, "walk_on").value_or(0.0);
  return "all four feet on the ground beyond x = " + plot::decimal(*beyond, 3) + " m" +
         (walk_on > 0.0 ? ", and " + plot::decimal(walk_on, 3) + " m further" : "");
}

void read_options(const json& options, Outcome& outcome) {
  outcome.criteria = asked(member(options, "criteria"));
  outcome.goal = goal_of(member(options, "goal"));
  const json paper = member(options, "paper");
  for (const auto& [metric, figure] : paper.items()) {
    if (figure.is_null()) continue;
    outcome.paper.emplace_back(metric,
                               figure.is_string() ? figure.get<std::string>() : figure.dump());
  }
}

void read_summary(const json& summary, Outcome& outcome) {
  outcome.criteria = judged(summary.at("criteria"));
  const json& metrics = summary.at("metrics");
  outcome.reason = metrics.value("reason", "");
  outcome.metrics = read_metrics(metrics);
  outcome.succeeded = is_true(metrics, "succeeded");
  outcome.goal_reached = is_true(metrics, "goal_reached");
  outcome.interrupted = outcome.reason == "interrupted" || outcome.reason == "begun again";
  outcome.known = true;
}

/// What is read of JSON, as far as `outcome` was before where it is of another shape.
void read_whole(void (*read)(const json&, Outcome&), const std::string& text, Outcome& outcome) {
  Outcome more = outcome;
  try {
    read(parse(text), more);
    outcome = std::move(more);
  } catch (const json::exception&) {
  }
}

template <typename List, typename Match>
auto find(const List& list, const Match& match) {
  const auto found = std::ranges::find_if(list, match);
  return found == list.end() ? nullptr : &*found;
}

}  // namespace

const Metric* Outcome::metric(const std::string& name) const {
  return find(metrics, [&](const Metric& one) { return one.name == name; });
}

const Requirement* Outcome::criterion(const std::string& name) const {
  return find(criteria, [&](const Requirement& one) { return one.metric == name; });
}

const std::string* Outcome::figure_of_paper(const std::string& name) const {
  const auto* found = find(paper, [&](const auto& figure) { return figure.first == name; });
  return found == nullptr ? nullptr : &found->second;
}

Outcome read_outcome(const std::string& summary_text, const std::string& options_text) {
  Outcome outcome;
  read_whole(read_options, options_text, outcome);
  read_whole(read_summary, summary_text, outcome);
  if (outcome.interrupted) {
    for (Requirement& one : outcome.criteria) one.passed.reset();
  }
  return outcome;
}

}  // namespace surefoot::report
