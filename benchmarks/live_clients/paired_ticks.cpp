#include "benchmarks/live_clients/paired_ticks.hpp"

#include <algorithm>
#include <numeric>
#include <random>

namespace surefoot {
namespace {

constexpr int kDraws = 2000;  // of the bootstrap

/// A time [µs], and how often it counts: as often as its unit was drawn.
struct Drawn {
  float time;
  int unit;
};

/// The time that a share `share` of all is below, where each unit counts as often as its weight.
/// `sorted` goes from the longest to the shortest.
double weighted_quantile(const std::vector<Drawn>& sorted, double share,
                         const std::vector<int>& weights) {
  long all = 0, passed = 0;
  for (const Drawn& drawn : sorted) all += weights[static_cast<std::size_t>(drawn.unit)];
  const double beyond = (1.0 - share) * static_cast<double>(all);
  for (const Drawn& drawn : sorted) {
    passed += weights[static_cast<std::size_t>(drawn.unit)];
    if (static_cast<double>(passed) > beyond) return drawn.time;
  }
  return 0.0;  // none was drawn
}

void sort_longest_first(std::vector<Drawn>& times) {
  std::ranges::sort(times, std::ranges::greater{}, &Drawn::time);
}

/// A quantile as a function of how often each unit counts.
template <typename Quantile>
QuantileRatio bootstrap(const Quantile& without, const Quantile& with, int units) {
  const auto count = static_cast<std::size_t>(units);
  const std::vector<int> once(count, 1);
  std::mt19937 random(1);
  std::uniform_int_distribution<std::size_t> any(0, count - 1);
  std::vector<double> ratios;
  for (int draw = 0; draw < kDraws; ++draw) {
    std::vector<int> weights(count, 0);
    for (int i = 0; i < units; ++i) ++weights[any(random)];
    ratios.push_back(with(weights) / without(weights));
  }
  std::ranges::sort(ratios);
  return {without(once), with(once), ratios[static_cast<std::size_t>(0.025 * kDraws)],
          ratios[static_cast<std::size_t>(0.975 * kDraws)]};
}

int largest(const TickPairs& ticks, int TimedTick::* member) {
  int most = -1;
  for (const auto& list : ticks) {
    for (const TimedTick& tick : list) most = std::max(most, tick.*member);
  }
  return most;
}

/// Times of each tick of the walk, from the longest to the shortest; a unit is a pair of walks.
std::vector<std::vector<Drawn>> by_index(const std::vector<TimedTick>& ticks,
                                         float TimedTick::* time, int indices) {
  std::vector<std::vector<Drawn>> times(static_cast<std::size_t>(indices));
  for (const TimedTick& tick : ticks) {
    times[static_cast<std::size_t>(tick.index)].push_back({tick.*time, tick.pair});
  }
  for (auto& list : times) sort_longest_first(list);
  return times;
}

/// The quantile `share` of the medians of all ticks that were drawn.
class TypicalQuantile {
 public:
  TypicalQuantile(const std::vector<TimedTick>& ticks, float TimedTick::* time, int indices,
                  double share)
      : times_(by_index(ticks, time, indices)), share_(share) {}

  double operator()(const std::vector<int>& weights) const {
    std::vector<Drawn> medians;
    for (const auto& list : times_) {
      const auto median = static_cast<float>(weighted_quantile(list, 0.5, weights));
      if (median > 0.0F) medians.push_back({median, 0});
    }
    sort_longest_first(medians);
    return weighted_quantile(medians, share_, {1});
  }

 private:
  std::vector<std::vector<Drawn>> times_;
  double share_;
};

/// The quantile `share` of all ticks.
class PlainQuantile {
 public:
  PlainQuantile(const std::vector<TimedTick>& ticks, float TimedTick::* time, int in_walk,
                int stretch, double share)
      : share_(share) {
    for (const TimedTick& tick : ticks) {
      times_.push_back({tick.*time, tick.pair * in_walk + tick.index / stretch});
    }
    sort_longest_first(times_);
  }

  double operator()(const std::vector<int>& weights) const {
    return weighted_quantile(times_, share_, weights);
  }

 private:
  std::vector<Drawn> times_;
  double share_;
};

template <typename Counted>
std::array<double, 2> per_million(const TickPairs& ticks, const Counted& counted) {
  std::array<double, 2> shares{};
  for (std::size_t side = 0; side < ticks.size(); ++side) {
    shares[side] = 1e6 * static_cast<double>(std::ranges::count_if(ticks[side], counted)) /
                   static_cast<double>(ticks[side].size());
  }
  return shares;
}

}  // namespace

QuantileRatio compare_all(const TickPairs& ticks, float TimedTick::* time, double share,
                          int stretch) {
  const int in_walk = largest(ticks, &TimedTick::index) / stretch + 1;
  const int pairs = largest(ticks, &TimedTick::pair) + 1;
  return bootstrap(PlainQuantile(ticks[0], time, in_walk, stretch, share),
                   PlainQuantile(ticks[1], time, in_walk, stretch, share), pairs * in_walk);
}

QuantileRatio compare_typical(const TickPairs& ticks, float TimedTick::* time, double share) {
  const int indices = largest(ticks, &TimedTick::index) + 1;
  const int pairs = largest(ticks, &TimedTick::pair) + 1;
  return bootstrap(TypicalQuantile(ticks[0], time, indices, share),
                   TypicalQuantile(ticks[1], time, indices, share), pairs);
}

std::array<double, 2> late_per_million(const TickPairs& ticks, float delay) {
  const int indices = largest(ticks, &TimedTick::index) + 1;
  const std::vector<int> once(static_cast<std::size_t>(largest(ticks, &TimedTick::pair) + 1), 1);
  std::vector<double> usual;
  for (const auto& list : by_index(ticks[0], &TimedTick::wall, indices)) {
    usual.push_back(weighted_quantile(list, 0.5, once));
  }
  return per_million(ticks, [&](const TimedTick& tick) {
    return tick.wall > usual[static_cast<std::size_t>(tick.index)] + delay;
  });
}

std::array<double, 2> interrupted_per_million(const TickPairs& ticks) {
  return per_million(ticks, [](const TimedTick& tick) { return tick.interrupted; });
}

}  // namespace surefoot
