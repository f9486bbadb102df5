#pragma once

#include "surefoot/evaluation/metrics.hpp"

#include <optional>
#include <string>
#include <vector>

namespace surefoot::evaluation {

/// A limit on a metric, e.g. com_error_max_m ≤ 0.0005 or fell = false.
struct Criterion {
  std::string metric;              ///< its name; for a distribution a member, e.g. "tick_us.p99"
  std::optional<double> min, max;  ///< inclusive
  std::optional<bool> equals;      ///< for boolean metrics
};

struct CriterionResult {
  Criterion criterion;
  double value = kNaN;  ///< of the metric; 1 and 0 for booleans
  bool passed = false;  ///< a NaN never passes
};

/// Throws UnknownNameError if criteria can't limit this metric (the message lists the valid ones),
/// Error if the criterion limits nothing or does not fit its metric. Called when scenarios are
/// read.
void check(const Criterion& criterion);

/// Judges the metrics; throws as `check` does.
[[nodiscard]] std::vector<CriterionResult> evaluate(const std::vector<Criterion>& criteria,
                                                    const Metrics& metrics);
[[nodiscard]] bool all_passed(const std::vector<CriterionResult>& results);

/// The log's summary,
/// {"metrics":{…},"criteria":[{"metric":…,"min":…,"max":…,"value":…,"passed":…},…]}.
[[nodiscard]] std::string summary_json(const Metrics& metrics,
                                       const std::vector<CriterionResult>& results);

}  // namespace surefoot::evaluation
