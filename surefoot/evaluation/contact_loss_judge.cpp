#include "surefoot/evaluation/contact_loss_judge.hpp"

#include "surefoot/evaluation/quantile.hpp"

namespace surefoot::evaluation {
namespace {

constexpr double kMinLossTime = 0.05;  // without a touch [s]

}  // namespace

void ContactLossJudge::add(const simulation::GroundTruth& truth, const MotionPlan& plan) {
  for (const Leg leg : truth.feet.legs()) {
    Foot& foot = feet_[index(leg)];
    const bool touches = truth.feet[index(leg)].touched;
    const LegPhase phase = plan.feet[index(leg)].phase;
    const bool stood = foot.phase == LegPhase::stance;
    if (stood && phase == LegPhase::search) {
      if (touches) {
        ++false_;
      } else {
        ++noticed_;
        latencies_.push_back(truth.time - foot.touched_at);
      }
      foot.is_lost = false;
    } else if (foot.is_lost && (touches || phase != LegPhase::stance)) {
      ++missed_;
      foot.is_lost = false;
    }
    const bool stands = phase == LegPhase::stance;
    if (stands && (touches || !stood)) foot.touched_at = truth.time;
    const double away = truth.time - foot.touched_at;
    foot.is_lost = foot.is_lost || (stands && away >= time_scale_ * kMinLossTime);
    foot.phase = phase;
  }
}

void ContactLossJudge::write(Metrics& metrics) const {
  metrics.contact_losses_noticed = noticed_;
  metrics.contact_losses_missed = missed_;
  metrics.contact_losses_false = false_;
  metrics.contact_loss_latency_p95_s = quantile_of(latencies_, 0.95);
}

}  // namespace surefoot::evaluation
