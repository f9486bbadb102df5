#pragma once

#include "surefoot/evaluation/metric_table.hpp"
#include "surefoot/evaluation/metrics.hpp"

#include <nanobind/nanobind.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>

#include <optional>
#include <string>
#include <type_traits>
#include <variant>

namespace surefoot::python {

namespace nb = nanobind;

using Metrics = nb::typed<nb::dict, std::string, nb::any>;

inline nb::object as_object(const evaluation::MetricValue& value) {
  return std::visit(
      [](const auto& given) -> nb::object {
        using T = std::decay_t<decltype(given)>;
        if constexpr (std::is_same_v<T, evaluation::Quantiles>) {
          nb::dict quantiles;
          quantiles["median"] = given.median;
          quantiles["p99"] = given.p99;
          quantiles["max"] = given.max;
          return quantiles;
        } else if constexpr (std::is_same_v<T, std::optional<bool>>) {
          return given ? nb::object(nb::bool_(*given)) : nb::none();
        } else {
          return nb::cast(given);
        }
      },
      value);
}

/// By name, each with its unit in it.
inline Metrics as_dict(const evaluation::Metrics& metrics) {
  Metrics result;
  for (const auto& [name, value] : values(metrics)) result[nb::cast(name)] = as_object(value);
  return result;
}

/// The reverse. Throws on one that is missing.
inline evaluation::Metrics metrics_of(const nb::dict& given) {
  evaluation::Metrics metrics;
  for (const evaluation::Metric& metric : evaluation::metric_table()) {
    const nb::object value = given[nb::cast(metric.name)];
    std::visit(
        [&](auto member) {
          using T = std::decay_t<decltype(metrics.*member)>;
          if constexpr (std::is_same_v<T, evaluation::Quantiles>) {
            metrics.*member = {.median = nb::cast<double>(value["median"]),
                               .p99 = nb::cast<double>(value["p99"]),
                               .max = nb::cast<double>(value["max"])};
          } else {
            metrics.*member = nb::cast<T>(value);
          }
        },
        metric.member);
  }
  return metrics;
}

}  // namespace surefoot::python
