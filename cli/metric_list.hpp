#pragma once

#include "surefoot/evaluation/metric_table.hpp"

#include <nlohmann/json.hpp>

#include <string>

namespace surefoot::cli {

/// What is known of each metric, by name: `unit` and `scale` from the value to it, which way is
/// `better` ("smaller", "larger", "none"), which value is the `worst`, whether it stands among the
/// `first`, depends on the machine's clock, and what it is.
[[nodiscard]] nlohmann::ordered_json metrics_json();

/// The same of those that are numbers; of distributions each member.
[[nodiscard]] nlohmann::ordered_json numbers_json();

/// A line each, for people.
[[nodiscard]] std::string metrics_text();

/// "↓": smaller is better; "↑": larger is; empty: neither.
[[nodiscard]] std::string arrow_of(const evaluation::Metric& metric);

}  // namespace surefoot::cli
