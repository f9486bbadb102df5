#include "surefoot/logging/logged_timing.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::logged {

Timing timing_of(const TickTiming& timing, const std::vector<std::string>& names) {
  Timing result{.stages = timing, .levels = {}};
  const auto is_known = [](float time) { return !std::isnan(time); };
  if (std::ranges::none_of(timing.levels, is_known)) return result;
  const std::size_t count = std::min(names.size(), timing.levels.size());
  for (std::size_t k = 0; k < count; ++k) {
    const double nanoseconds = std::round(1e3 * static_cast<double>(timing.levels[k]));
    result.levels.push_back({names[k], nanoseconds / 1e3});
  }
  return result;
}

TickTiming timing_from(const Timing& timing, const std::vector<std::string>& names) {
  TickTiming result = timing.stages;
  result.levels = kNoLevelTimes;
  for (const LevelTime& level : timing.levels) {
    const auto place =
        static_cast<std::size_t>(std::ranges::find(names, level.name) - names.begin());
    if (place >= std::min(names.size(), result.levels.size())) continue;
    result.levels[place] = static_cast<float>(level.solve);
  }
  return result;
}

}  // namespace surefoot::logged
