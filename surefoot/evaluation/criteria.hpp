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
  double value = kNaN;         ///< of the metric; 1 and 0 for booleans
  std::optional<bool> passed;  ///< a NaN never passes; empty: not judged
};

/// How much of the run that the criteria are about there was.
enum class Extent {
  whole,  ///< it came to an end of its own, or was as long as they need
  part,   ///< it was cut off, or shorter
};

/// Throws UnknownNameError if criteria can't limit this metric (the message lists the valid ones),
/// Error if the criterion limits nothing or does not fit its metric. Called when scenarios are
/// read.
void check(const Criterion& criterion);

/// Judges the metrics; throws as `check` does. Of a part of a run only that is judged which the
/// rest could not change: a largest value beyond its limit, a fall.
[[nodiscard]] std::vector<CriterionResult> evaluate(const std::vector<Criterion>& criteria,
                                                    const Metrics& metrics, Extent extent);
/// False if one is missed; else empty if one was not judged.
[[nodiscard]] std::optional<bool> all_passed(const std::vector<CriterionResult>& results);

/// The log's summary,
/// {"metrics":{…},"criteria":[{"metric":…,"min":…,"max":…,"value":…,"passed":…},…]}; `passed` is
/// null if it was not judged.
[[nodiscard]] std::string summary_json(const Metrics& metrics,
                                       const std::vector<CriterionResult>& results);

}  // namespace surefoot::evaluation
