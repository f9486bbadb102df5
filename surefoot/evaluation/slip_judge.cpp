#include "surefoot/evaluation/slip_judge.hpp"

#include "surefoot/evaluation/quantile.hpp"

namespace surefoot::evaluation {
namespace {

constexpr double kSlipSpeed = 0.05;    // of a sliding foot [m/s]
constexpr double kCreepSpeed = 0.025;  // a detection above it is not false [m/s]
constexpr double kMinLoad = 20.0;      // normal force of a foot that can slip [N]
constexpr double kMinDuration = 0.01;  // of a slip [s]
constexpr double kRestTime = 0.05;     // between two slips [s]
constexpr double kRounding = 1e-9;     // of summed times [s]

}  // namespace

void SlipJudge::add(const simulation::GroundTruth& truth, const TickRecord& tick) {
  for (const Leg leg : truth.feet.legs()) {
    const std::size_t k = index(leg);
    Foot& foot = feet_[k];
    const simulation::TrueContact& contact = truth.feet[k];
    const bool stands = tick.plan.contact(leg) && contact.touching;
    const double speed = stands ? contact.slip_velocity.norm() : 0.0;
    const double load = contact.normal.dot(contact.force);
    follow(foot, truth.time, speed, load > scale_.force() * kMinLoad);
    notice(foot, truth.time, tick.state.slips[k]);
    if (foot.is_slip && !(truth.time - foot.last_at <= scale_.time() * kRestTime)) close(foot);
  }
}

void SlipJudge::follow(Foot& foot, double time, double speed, bool loaded) const {
  if (speed > scale_.speed() * kCreepSpeed) foot.crept_at = time;
  if (!(speed > scale_.speed() * kSlipSpeed && loaded)) {
    foot.slides_for = 0.0;
    return;
  }
  foot.slides_for += period_;
  foot.last_at = time;
  if (foot.is_slip) return;
  if (foot.slides_for <= period_ + kRounding) foot.began_at = time;
  foot.is_slip = foot.slides_for >= scale_.time() * kMinDuration - kRounding;
}

void SlipJudge::notice(Foot& foot, double time, bool believed) {
  const bool is_new = believed && !foot.was_believed;
  foot.was_believed = believed;
  if (is_new && !(time - foot.crept_at <= scale_.time() * kRestTime)) ++false_;
  if (!believed || !foot.is_slip || foot.is_noticed) return;
  foot.is_noticed = true;
  latencies_.push_back(time - foot.began_at);
}

void SlipJudge::close(Foot& foot) {
  ++(foot.is_noticed ? detected_ : missed_);
  foot.is_slip = foot.is_noticed = false;
}

void SlipJudge::write(Metrics& metrics) const {
  metrics.slips_detected = detected_;
  metrics.slips_missed = missed_;
  for (const Foot& foot : feet_) {  // slips at the end of the run
    if (foot.is_slip) ++(foot.is_noticed ? metrics.slips_detected : metrics.slips_missed);
  }
  metrics.slips_false = false_;
  metrics.slip_latency_p95_s = quantile_of(latencies_, 0.95);
}

}  // namespace surefoot::evaluation
