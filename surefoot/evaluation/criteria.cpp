#include "surefoot/evaluation/criteria.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/evaluation/metric_table.hpp"
#include "surefoot/logging/json_text.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::evaluation {
namespace {

// A metric with a possible limit.
struct Limitable {
  std::string name;
  double value;
  bool is_truth;  // true or false
  Course course;
};

std::vector<Limitable> limitables(const Metrics& metrics) {
  std::vector<Limitable> all;
  for (const auto& [metric, value] : values(metrics)) {
    const std::string name(metric);
    const Course course = find_metric(metric)->course;
    const auto add = [&](const std::string& member, double number, bool is_truth = false) {
      all.push_back({name + member, number, is_truth, course});
    };
    if (const bool* truth = std::get_if<bool>(&value)) add("", *truth ? 1.0 : 0.0, true);
    if (const auto* perhaps = std::get_if<std::optional<bool>>(&value))
      add("", perhaps->has_value() ? double(**perhaps) : kNaN, true);
    if (const int* count = std::get_if<int>(&value)) add("", double(*count));
    if (const double* number = std::get_if<double>(&value)) add("", *number);
    if (const Quantiles* times = std::get_if<Quantiles>(&value)) {
      add(".median", times->median);
      add(".p99", times->p99);
      add(".max", times->max);
    }
  }
  // The criteria decide it.
  std::erase_if(all, [](const Limitable& metric) { return metric.name == "succeeded"; });
  return all;
}

const Limitable& find(const std::vector<Limitable>& all, const std::string& name) {
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&](const Limitable& metric) { return metric.name == name; });
  if (found != all.end()) return *found;
  std::string message = "unknown metric \"" + name + "\"; criteria can limit:";
  for (const Limitable& metric : all) message += " " + metric.name;
  throw UnknownNameError(message);
}

void check(const Criterion& criterion, const Limitable& metric) {
  const bool limited = criterion.min || criterion.max;
  if (metric.is_truth && (limited || !criterion.equals)) {
    throw Error("criterion " + criterion.metric + ": it is true or false; \"" + criterion.metric +
                ": false\" would be valid");
  }
  if (!metric.is_truth && (!limited || criterion.equals)) {
    throw Error("criterion " + criterion.metric +
                ": it is a number; limits would be valid, e.g. \"" + criterion.metric +
                ": {max: 1}\"");
  }
}

/// Will the verdict stay the same however the run goes on?
bool is_decided(const Criterion& criterion, const Limitable& metric, bool passed) {
  if (std::isnan(metric.value)) return false;
  if (criterion.equals) return metric.course == Course::grows && metric.value == 1.0;
  const bool is_beyond_max = criterion.max && metric.value > *criterion.max;
  const bool is_below_min = criterion.min && metric.value < *criterion.min;
  if (metric.course == Course::grows) return is_beyond_max || (passed && !criterion.max);
  if (metric.course == Course::falls) return is_below_min || (passed && !criterion.min);
  return false;
}

CriterionResult judge(const Criterion& criterion, const Limitable& metric, Extent extent) {
  check(criterion, metric);
  const bool passed = (!criterion.min || metric.value >= *criterion.min) &&
                      (!criterion.max || metric.value <= *criterion.max) &&
                      (!criterion.equals || metric.value == (*criterion.equals ? 1.0 : 0.0));
  if (extent == Extent::part && !is_decided(criterion, metric, passed))
    return {criterion, metric.value, std::nullopt};
  return {criterion, metric.value, passed};
}

}  // namespace

void check(const Criterion& criterion) {
  check(criterion, find(limitables(Metrics()), criterion.metric));
}

std::vector<CriterionResult> evaluate(const std::vector<Criterion>& criteria,
                                      const Metrics& metrics, Extent extent) {
  const std::vector<Limitable> all = limitables(metrics);
  std::vector<CriterionResult> results;
  for (const Criterion& criterion : criteria) {
    results.push_back(judge(criterion, find(all, criterion.metric), extent));
  }
  return results;
}

std::optional<bool> all_passed(const std::vector<CriterionResult>& results) {
  const auto any = [&](std::optional<bool> passed) {
    return std::ranges::find(results, passed, &CriterionResult::passed) != results.end();
  };
  if (any(false)) return false;
  return any(std::nullopt) ? std::nullopt : std::optional(true);
}

std::string summary_json(const Metrics& metrics, const std::vector<CriterionResult>& results) {
  std::string out;
  logging::JsonText json(out);
  json.object().key("metrics").raw(to_json(metrics)).key("criteria").array();
  for (const CriterionResult& result : results) {
    const Criterion& criterion = result.criterion;
    json.object().member("metric", std::string_view(criterion.metric));
    if (criterion.min) json.member("min", *criterion.min);
    if (criterion.max) json.member("max", *criterion.max);
    if (criterion.equals) json.member("equals", *criterion.equals);
    json.member("value", result.value).key("passed");
    result.passed ? json.value(*result.passed) : json.null();
    json.end_object();
  }
  json.end_array().end_object();
  return out;
}

}  // namespace surefoot::evaluation
