#include "surefoot/runtime/stage_timer.hpp"

#include <cmath>

namespace surefoot::runtime {
namespace {

double microseconds(std::chrono::steady_clock::duration duration) {
  return std::chrono::duration<double, std::micro>(duration).count();
}

}  // namespace

LevelTimes in_microseconds(const std::array<double, kMaxLevels>& seconds) noexcept {
  LevelTimes times = kNoLevelTimes;
  for (std::size_t k = 0; k < times.size(); ++k) {
    if (seconds[k] > 0.0) times[k] = static_cast<float>(std::round(1e9 * seconds[k]) / 1e3);
  }
  return times;
}

void StageTimer::tick_begins() noexcept {
  timing_ = TickTiming{};
  begin_ = last_ = Clock::now();
}

void StageTimer::stage_ends(control::Stage stage) noexcept {
  const Clock::time_point now = Clock::now();
  const double duration = microseconds(now - last_);
  switch (stage) {
    case control::Stage::estimate:
      timing_.estimate = duration;
      break;
    case control::Stage::model:
      timing_.model = duration;
      break;
    case control::Stage::plan:
      timing_.plan = duration;
      break;
    case control::Stage::stack:
      timing_.stack = duration;
      break;
    case control::Stage::solve:
      timing_.solve = duration;
      break;
    case control::Stage::command:
      break;  // counts in the total only
  }
  timing_.total = microseconds(now - begin_);
  last_ = now;
}

}  // namespace surefoot::runtime
