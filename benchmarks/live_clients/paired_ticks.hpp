#pragma once

#include <array>
#include <vector>

namespace surefoot {

/// A tick of a walk that is made again and again, every second time under other circumstances.
struct TimedTick {
  int index = 0;                  // in the walk
  int pair = 0;                   // of walks, of which each has every tick once, one so and one so
  float wall = 0.0F, cpu = 0.0F;  // [µs]
  bool interrupted = false;       // another thread had the processor meanwhile
};

/// The same ticks without and with what is asked about.
using TickPairs = std::array<std::vector<TimedTick>, 2>;

/// A quantile without and with, and the 95 % interval of with / without.
struct QuantileRatio {
  double without = 0.0, with = 0.0;  // [µs]
  double low = 0.0, high = 0.0;
  [[nodiscard]] double value() const { return with / without; }
};

/// Of all ticks, each as long as it was. The interval is from drawing pairs of `stretch` ticks
/// again (bootstrap), as what else the machine does comes in stretches, too.
QuantileRatio compare_all(const TickPairs& ticks, float TimedTick::* time, double share,
                          int stretch);

/// Of the walk's ticks, each as long as its median over all walks: what the machine does at times
/// is not in it, nor is a delay that befalls a tick in fewer than half of the walks. The interval
/// is from drawing pairs of walks again.
QuantileRatio compare_typical(const TickPairs& ticks, float TimedTick::* time, double share);

/// How many of a million ticks were longer by `delay` [µs] than their median of the walks without.
std::array<double, 2> late_per_million(const TickPairs& ticks, float delay);

std::array<double, 2> interrupted_per_million(const TickPairs& ticks);

}  // namespace surefoot
