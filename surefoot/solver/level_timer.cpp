#include "surefoot/solver/level_timer.hpp"

#include <algorithm>

namespace surefoot::solver {

void LevelTimer::reset() noexcept { std::ranges::fill(seconds_, 0.0); }

void LevelTimer::take(int level) noexcept {
  const double now = clock_();
  const auto place = static_cast<std::size_t>(level);
  if (place < seconds_.size()) seconds_[place] += now - last_;
  last_ = now;
}

}  // namespace surefoot::solver
