#pragma once

#include "surefoot/evaluation/metrics.hpp"
#include "surefoot/signals/motion_plan.hpp"
#include "surefoot/simulation/ground_truth.hpp"

#include <vector>

namespace surefoot {

/// Holds the touchdowns that the controller notices against those that happen. A touchdown is
/// noticed when a leg's phase becomes stance; it is false if the foot did not touch within 20 ms
/// before, not even for a single physics step. Its latency runs from the foot's first touch, gaps
/// of up to 50 ms, as a bouncing foot makes them, left aside.
class TouchdownJudge {
 public:
  void add(const GroundTruth& truth, const MotionPlan& plan);
  void write(Metrics& metrics) const;

 private:
  struct Foot {
    bool was_contact = true;
    double touched_at = kNaN;   // when this touch began [s]
    double touching_at = kNaN;  // when it was last seen [s]
  };
  void judge(const Foot& foot, double time);

  PerLeg<Foot> feet_{};
  std::vector<double> latencies_;  // [s]
  int false_touchdowns_ = 0;
};

}  // namespace surefoot
