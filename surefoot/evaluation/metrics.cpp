#include "surefoot/evaluation/metrics.hpp"

#include "surefoot/evaluation/metric_table.hpp"
#include "surefoot/logging/json_text.hpp"

namespace surefoot::evaluation {
namespace {

void write(logging::JsonText& json, const MetricValue& value) {
  std::visit(
      [&json](const auto& content) {
        using T = std::decay_t<decltype(content)>;
        if constexpr (std::is_same_v<T, Quantiles>) {
          json.object().member("median", content.median).member("p99", content.p99);
          json.member("max", content.max).end_object();
        } else if constexpr (std::is_same_v<T, std::string>) {
          json.value(std::string_view(content));
        } else if constexpr (std::is_same_v<T, std::optional<bool>>) {
          content ? json.value(*content) : json.null();
        } else {
          json.value(content);
        }
      },
      value);
}

}  // namespace

std::vector<std::pair<std::string_view, MetricValue>> values(const Metrics& metrics) {
  std::vector<std::pair<std::string_view, MetricValue>> all;
  for (const Metric& metric : metric_table()) {
    const auto value = [&](auto member) { return MetricValue(metrics.*member); };
    all.emplace_back(metric.name, std::visit(value, metric.member));
  }
  return all;
}

std::string to_json(const Metrics& metrics) {
  std::string out;
  logging::JsonText json(out);
  json.object();
  for (const auto& [name, value] : values(metrics)) {
    json.key(name);
    write(json, value);
  }
  json.end_object();
  return out;
}

}  // namespace surefoot::evaluation
