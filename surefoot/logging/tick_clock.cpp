#include "surefoot/logging/tick_clock.hpp"

#include <cmath>

namespace surefoot::logging {

void TickClock::lose(std::optional<double> from) {
  loses_ = true;
  if (!last_ && !begin_) begin_ = from;
}

void TickClock::add(double time) {
  const double late = time - expected();
  const bool goes_on = !(std::abs(late) >= 0.5 * period_);
  follows_ = goes_on || !loses_;
  if (!follows_) end(time - period_);
  if (!goes_on && follows_) {
    if (!last_) skips_.begin = time;
    if (last_ && skips_.count++ == 0) {
      skips_.from = *last_;
      skips_.to = time;
    }
  }
  last_ = time;
  loses_ = false;
}

void TickClock::end(double time) {
  if (!last_ && !begin_) return;  // the clock may start at any time
  const double missing = (time + period_ - expected()) / period_;
  if (!(missing > 0.5)) return;
  lost_ += static_cast<std::uint64_t>(std::llround(missing));
  last_ = time;
}

}  // namespace surefoot::logging
