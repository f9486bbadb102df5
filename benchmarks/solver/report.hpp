#pragma once

#include "benchmarks/solver/measure.hpp"

#include <nlohmann/json.hpp>

#include <string>

namespace surefoot::benchmarks {

/// A table for people: one row a solver, times in µs and Q and as a multiple of the first row's.
[[nodiscard]] std::string table(const SetResult& result);

[[nodiscard]] nlohmann::ordered_json to_json(const SetResult& result);

}  // namespace surefoot::benchmarks
