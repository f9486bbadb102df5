#include "surefoot/logging/clock_text.hpp"

#include "surefoot/base/formatted.hpp"

#include <cmath>

namespace surefoot::logging {
namespace {

std::string seconds(double time) { return formatted("%.4f s", time); }

}  // namespace

std::string clock_text(const ClockSkips& clock) {
  std::string out;
  if (clock.begin != 0.0)
    out += "The clock begins at " + seconds(clock.begin) + "; nothing before it is lost.\n";
  if (clock.count == 0) return out;
  out += "The clock goes from " + seconds(clock.from) + " to " + seconds(clock.to) +
         " without a tick between";
  if (clock.count > 1) out += ", and skips at " + std::to_string(clock.count - 1) + " more places";
  return out + ": nothing is lost there, the controller was not called.\n";
}

void add_clock(const ClockSkips& clock, nlohmann::ordered_json& json) {
  if (clock.begin == 0.0 && clock.count == 0) return;
  json["clock"] = {{"begin", clock.begin}, {"skips", clock.count}};
  if (clock.count > 0) json["clock"]["first_skip"] = {clock.from, clock.to};
}

double to_nanosecond(double time) { return std::round(time * 1e9) / 1e9; }

}  // namespace surefoot::logging
