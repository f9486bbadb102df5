#pragma once

#include "surefoot/evaluation/metrics.hpp"

#include <optional>
#include <string>
#include <vector>

namespace surefoot {

/// A limit that a metric must keep, e.g. com_error_max_m ≤ 0.0005 or fell = false.
struct Criterion {
  std::string metric;              ///< its name; of a distribution one member, e.g. "tick_us.p99"
  std::optional<double> min, max;  ///< inclusive
  std::optional<bool> equals;      ///< for metrics that are true or false
};

struct CriterionResult {
  Criterion criterion;
  double value = kNaN;  ///< of the metric; 1 and 0 for true and false
  bool passed = false;  ///< a NaN never passes
};

/// Throws UnknownNameError if the metric is not one that criteria can limit (the message lists
/// them), Error if the criterion limits nothing or not in the way of its metric. For the reading of
/// scenarios.
void check(const Criterion& criterion);

/// Judges the metrics; throws as `check` does.
[[nodiscard]] std::vector<CriterionResult> evaluate(const std::vector<Criterion>& criteria,
                                                    const Metrics& metrics);
[[nodiscard]] bool all_passed(const std::vector<CriterionResult>& results);

/// The log's summary,
/// {"metrics":{…},"criteria":[{"metric":…,"min":…,"max":…,"value":…,"passed":…},…]}.
[[nodiscard]] std::string summary_json(const Metrics& metrics,
                                       const std::vector<CriterionResult>& results);

}  // namespace surefoot
