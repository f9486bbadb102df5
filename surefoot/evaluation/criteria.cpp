#include "surefoot/evaluation/criteria.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/logging/json_text.hpp"

#include <algorithm>

namespace surefoot::evaluation {
namespace {

// A metric with a possible limit.
struct Limitable {
  std::string name;
  double value;
  bool is_truth;  // true or false
};

std::vector<Limitable> limitables(const Metrics& metrics) {
  std::vector<Limitable> all;
  for (const auto& [metric, value] : values(metrics)) {
    const std::string name(metric);
    if (const bool* truth = std::get_if<bool>(&value))
      all.push_back({name, *truth ? 1.0 : 0.0, true});
    if (const auto* perhaps = std::get_if<std::optional<bool>>(&value))
      all.push_back({name, perhaps->has_value() ? double(**perhaps) : kNaN, true});
    if (const int* count = std::get_if<int>(&value)) all.push_back({name, double(*count), false});
    if (const double* number = std::get_if<double>(&value)) all.push_back({name, *number, false});
    if (const Quantiles* times = std::get_if<Quantiles>(&value)) {
      all.push_back({name + ".median", times->median, false});
      all.push_back({name + ".p99", times->p99, false});
      all.push_back({name + ".max", times->max, false});
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

CriterionResult judge(const Criterion& criterion, const Limitable& metric) {
  check(criterion, metric);
  const bool passed = (!criterion.min || metric.value >= *criterion.min) &&
                      (!criterion.max || metric.value <= *criterion.max) &&
                      (!criterion.equals || metric.value == (*criterion.equals ? 1.0 : 0.0));
  return {criterion, metric.value, passed};
}

}  // namespace

void check(const Criterion& criterion) {
  check(criterion, find(limitables(Metrics()), criterion.metric));
}

std::vector<CriterionResult> evaluate(const std::vector<Criterion>& criteria,
                                      const Metrics& metrics) {
  const std::vector<Limitable> all = limitables(metrics);
  std::vector<CriterionResult> results;
  for (const Criterion& criterion : criteria) {
    results.push_back(judge(criterion, find(all, criterion.metric)));
  }
  return results;
}

bool all_passed(const std::vector<CriterionResult>& results) {
  return std::all_of(results.begin(), results.end(),
                     [](const auto& result) { return result.passed; });
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
    json.member("value", result.value).member("passed", result.passed).end_object();
  }
  json.end_array().end_object();
  return out;
}

}  // namespace surefoot::evaluation
