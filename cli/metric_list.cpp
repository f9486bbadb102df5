#include "cli/metric_list.hpp"

#include "surefoot/base/text_table.hpp"

#include <array>

namespace surefoot::cli {
namespace {

using evaluation::Metric;
using evaluation::Metrics;
using evaluation::Sense;
using Json = nlohmann::ordered_json;

Json json_of(const Metric& metric) {
  constexpr std::array kSenses{"none", "smaller", "larger"};
  return {{"unit", metric.unit.name},
          {"scale", metric.unit.scale},
          {"better", kSenses[static_cast<std::size_t>(metric.sense)]},
          {"worst", metric.sense == Sense::larger ? "least" : "greatest"},
          {"first", metric.place == evaluation::Place::among_the_first},
          {"by_clock", metric.is_by_clock},
          {"help", metric.help}};
}

}  // namespace

Json metrics_json() {
  Json all = Json::object();
  for (const Metric& metric : evaluation::metric_table())
    all[std::string(metric.name)] = json_of(metric);
  return all;
}

Json numbers_json() {
  Json numbers = Json::object();
  for (const Metric& metric : evaluation::metric_table()) {
    const std::string name(metric.name);
    if (std::holds_alternative<double Metrics::*>(metric.member) ||
        std::holds_alternative<int Metrics::*>(metric.member))
      numbers[name] = json_of(metric);
    if (!std::holds_alternative<evaluation::Quantiles Metrics::*>(metric.member)) continue;
    for (const char* member : {".median", ".p99", ".max"}) numbers[name + member] = json_of(metric);
  }
  return numbers;
}

std::string metrics_text() {
  std::vector<std::vector<std::string>> table{{"", "shown in", "better", ""}};
  for (const Metric& metric : evaluation::metric_table())
    table.push_back({std::string(metric.name), std::string(metric.unit.name), arrow_of(metric),
                     std::string(metric.help)});
  return aligned(table);
}

std::string arrow_of(const Metric& metric) {
  return metric.sense == Sense::smaller ? "↓" : metric.sense == Sense::larger ? "↑" : "";
}

}  // namespace surefoot::cli
