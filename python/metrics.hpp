#pragma once

#include "surefoot/evaluation/metrics.hpp"

#include <nanobind/nanobind.h>
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

}  // namespace surefoot::python
