#include "surefoot/runtime/stage_timer.hpp"

namespace surefoot {
namespace {

double microseconds(std::chrono::steady_clock::duration duration) {
  return std::chrono::duration<double, std::micro>(duration).count();
}

}  // namespace

void StageTimer::tick_begins() noexcept {
  timing_ = TickTiming{};
  begin_ = last_ = Clock::now();
}

void StageTimer::stage_ends(Stage stage) noexcept {
  const Clock::time_point now = Clock::now();
  const double duration = microseconds(now - last_);
  switch (stage) {
    case Stage::estimate:
      timing_.estimate = duration;
      break;
    case Stage::model:
      timing_.model = duration;
      break;
    case Stage::plan:
      timing_.plan = duration;
      break;
    case Stage::stack:
      timing_.stack = duration;
      break;
    case Stage::solve:
      timing_.solve = duration;
      break;
    case Stage::command:
      break;  // a share of the total
  }
  timing_.total = microseconds(now - begin_);
  last_ = now;
}

}  // namespace surefoot
