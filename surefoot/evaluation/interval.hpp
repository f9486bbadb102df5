#pragma once

namespace surefoot {

/// An interval of rates, 0 … 1.
struct Interval {
  double low = 0.0, high = 1.0;
};

/// Wilson's 95 % interval of the success rate from `successes` of `trials`; 0 … 1 without trials.
///
///     (p + z²/2n ± z √(p (1 − p)/n + z²/4n²)) / (1 + z²/n)
///     p = successes/trials, n = trials, z = 1.96
[[nodiscard]] Interval wilson_interval(int successes, int trials);

}  // namespace surefoot
