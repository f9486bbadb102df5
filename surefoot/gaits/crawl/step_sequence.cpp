#include "surefoot/gaits/crawl/step_sequence.hpp"

#include "surefoot/base/error.hpp"

#include <algorithm>
#include <string>

namespace surefoot {
namespace {

/// The gait goes from leg to leg until it comes to the one that is looked for.
const GaitOptions& checked(const GaitOptions& gait) {
  for (const Leg k : kLegs) {
    const auto count = std::ranges::count(gait.order, k);
    if (count == 1) continue;
    throw Error("gait.order has " + std::string(kLegNames[index(k)]) + " " + std::to_string(count) +
                " times; it must have each of LF, RF, LH, RH once");
  }
  return gait;
}

}  // namespace

StepSequence::StepSequence(const GaitOptions& gait, const ProbeOptions& probe)
    : gait_(checked(gait)), probe_(probe) {}

Leg StepSequence::next(int ahead) const {
  const Leg k = gait_.order[static_cast<std::size_t>((cursor_ + ahead) % kNumLegs)];
  return backward_ ? same_side(k) : k;
}

void StepSequence::go_on_with(Leg leg) {
  while (next() != leg) advance();
}

double StepSequence::support_duration(double pace, int ahead) const {
  const bool same_side = is_left(next(ahead)) == is_left(next(ahead + kNumLegs - 1));
  return pace * (same_side ? gait_.same_side_duration : gait_.switch_duration);
}

double StepSequence::swing_duration(double pace, Leg leg) const {
  return pace * gait_.swing_duration + (probes(probe_, leg) ? probe_.duration : 0.0);
}

double StepSequence::cycle_duration(double pace) const {
  double sum = 0.0;
  for (int i = 0; i < kNumLegs; ++i)
    sum += support_duration(pace, i) + swing_duration(pace, next(i));
  return sum;
}

}  // namespace surefoot
