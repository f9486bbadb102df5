#include "surefoot/evaluation/touchdown_judge.hpp"

#include "surefoot/evaluation/quantile.hpp"

#include <algorithm>

namespace surefoot::evaluation {
namespace {

constexpr double kMaxBounce = 0.05;    // a longer gap between touches ends the contact [s]
constexpr double kMaxTouchAge = 0.02;  // of a noticed touchdown [s]
constexpr double kMaxLatency = 0.03;   // of a touchdown that is not late [s]

}  // namespace

void TouchdownJudge::add(const simulation::GroundTruth& truth, const MotionPlan& plan) {
  const double time = truth.time;
  for (const Leg leg : truth.feet.legs()) {
    Foot& foot = feet_[index(leg)];
    const bool contact = plan.contact(leg);
    if (truth.feet[index(leg)].touched) {
      const bool is_new = !(time - foot.touching_at <= time_scale_ * kMaxBounce);
      if (is_new || foot.was_contact) foot.touched_at = time;
      foot.touching_at = time;
    }
    if (contact && !foot.was_contact) judge(foot, time);
    foot.was_contact = contact;
  }
}

void TouchdownJudge::judge(const Foot& foot, double time) {
  if (time - foot.touching_at <= kMaxTouchAge) {
    latencies_.push_back(time - foot.touched_at);
  } else {
    ++false_touchdowns_;
  }
}

void TouchdownJudge::write(Metrics& metrics) const {
  metrics.false_touchdowns = false_touchdowns_;
  metrics.touchdown_latency_p95_s = quantile_of(latencies_, 0.95);
  metrics.touchdowns_noticed = static_cast<int>(latencies_.size());
  metrics.touchdowns_late = static_cast<int>(std::ranges::count_if(
      latencies_, [](double latency) { return latency > kMaxLatency + 1e-9; }));
}

}  // namespace surefoot::evaluation
