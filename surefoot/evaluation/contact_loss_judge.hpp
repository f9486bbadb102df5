#pragma once

#include "surefoot/base/scale.hpp"
#include "surefoot/evaluation/metrics.hpp"
#include "surefoot/signals/motion_plan.hpp"
#include "surefoot/simulation/ground_truth.hpp"

#include <array>
#include <vector>

namespace surefoot::evaluation {

/// Compares the contact losses that the controller notices with the true ones. A planned stance
/// foot (LegPhase::stance) truly loses contact if it does not touch the ground for 50 ms at
/// scale 1, longer than a bounce. A loss is noticed when the foot begins to search, missed if it
/// touches again or lifts off as planned before; its latency starts at the last touch. A noticed
/// loss of a foot that touched in the last tick is false.
class ContactLossJudge {
 public:
  /// `scale` of the robot.
  explicit ContactLossJudge(const Scale& scale = {}) : time_scale_(scale.time()) {}

  void add(const simulation::GroundTruth& truth, const MotionPlan& plan);
  void write(Metrics& metrics) const;

 private:
  struct Foot {
    LegPhase phase = LegPhase::stance;
    double touched_at = kNaN;  // last touch in planned stance [s]
    bool is_lost = false;
  };

  double time_scale_;
  std::array<Foot, kMaxLegs> feet_{};
  std::vector<double> latencies_;  // [s]
  int noticed_ = 0, missed_ = 0, false_ = 0;
};

}  // namespace surefoot::evaluation
