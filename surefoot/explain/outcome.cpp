#include "surefoot/explain/outcome.hpp"

#include <nlohmann/json.hpp>

namespace surefoot::explain {
namespace {

using json = nlohmann::ordered_json;

/// Null where the run was not judged.
bool is_true(const json& object, const char* name) {
  const auto found = object.find(name);
  return found != object.end() && !found->is_null() && found->get<bool>();
}

Outcome outcome_of(const json& summary) {
  const json& metrics = summary.at("metrics");
  Outcome outcome;
  outcome.known = true;
  outcome.reason = metrics.value("reason", "");
  outcome.judged = metrics.contains("succeeded") && !metrics.at("succeeded").is_null();
  outcome.succeeded = is_true(metrics, "succeeded");
  outcome.interrupted = outcome.reason == "interrupted" || outcome.reason == "begun again";
  for (const json& criterion : summary.at("criteria")) {
    (void)criterion.at("metric").get<std::string>();
    ++outcome.num_criteria;
    outcome.held += is_true(criterion, "passed") ? 1 : 0;
  }
  return outcome;
}

}  // namespace

Outcome read_outcome(const std::string& summary) {
  try {
    return outcome_of(json::parse(summary));
  } catch (const json::exception&) {
    return {};
  }
}

}  // namespace surefoot::explain
