#include "cli/run_cost.hpp"

#include "cli/progress.hpp"
#include "surefoot/base/formatted.hpp"
#include "surefoot/closed_loop/closed_loop.hpp"

#include <cmath>

namespace surefoot::cli {
namespace {

constexpr double kMemoryPerTick = 2.0 * sizeof(double);  // its times, for quantiles [bytes]
constexpr double kLogPerTick = 2900.0;                   // measured, see docs/log.md [bytes]

std::string size(double bytes) {
  return bytes < 1e9 ? formatted("%.0f MB", 1e-6 * bytes) : formatted("%.0f GB", 1e-9 * bytes);
}

}  // namespace

RunCost run_cost(const config::Scenario& scenario) {
  const double ticks = std::ceil(scenario.duration / scenario.controller.period);
  return {.ticks = ticks,
          .wall_seconds = ticks * closed_loop::measure_tick(scenario),
          .memory = ticks * kMemoryPerTick,
          .log = ticks * kLogPerTick};
}

std::string cost_text(const RunCost& cost) {
  constexpr double kMinShownMemory = 1e9;  // [bytes]
  return formatted("at most %.0f ticks: about ", cost.ticks) + duration_text(cost.wall_seconds) +
         " here" + (cost.memory < kMinShownMemory ? "" : ", " + size(cost.memory) + " of memory") +
         ", and " + size(cost.log) + " of log with --record";
}

}  // namespace surefoot::cli
