#pragma once

#include "surefoot/evaluation/metrics.hpp"
#include "surefoot/signals/motion_plan.hpp"
#include "surefoot/simulation/ground_truth.hpp"

#include <vector>

namespace surefoot {

/// Holds the losses of contact that the controller notices against those that happen. A foot that
/// is to stand (LegPhase::stance) truly loses the ground if it does not touch it for 50 ms; bounces
/// are shorter. A loss is noticed when the foot begins to search, and missed if it touches again,
/// or is lifted as planned, before; its latency runs from the last touch. What is noticed of a foot
/// that touched in the last tick is false.
class ContactLossJudge {
 public:
  void add(const GroundTruth& truth, const MotionPlan& plan);
  void write(Metrics& metrics) const;

 private:
  struct Foot {
    LegPhase phase = LegPhase::stance;
    double touched_at = kNaN;  // last, while it was to stand [s]
    bool is_lost = false;
  };

  PerLeg<Foot> feet_{};
  std::vector<double> latencies_;  // [s]
  int noticed_ = 0, missed_ = 0, false_ = 0;
};

}  // namespace surefoot
