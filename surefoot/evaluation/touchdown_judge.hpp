#pragma once

#include "surefoot/base/scale.hpp"
#include "surefoot/evaluation/metrics.hpp"
#include "surefoot/signals/motion_plan.hpp"
#include "surefoot/simulation/ground_truth.hpp"

#include <array>
#include <vector>

namespace surefoot::evaluation {

/// Compares the touchdowns that the controller notices with the true ones. A touchdown is noticed
/// when a leg's phase becomes stance, and false if the foot did not touch for a single physics step
/// within 20 ms before. Its latency starts at the foot's first touch, ignoring gaps of up to 50 ms
/// from bounces, at scale 1.
class TouchdownJudge {
 public:
  /// `scale` of the robot.
  explicit TouchdownJudge(const Scale& scale = {}) : time_scale_(scale.time()) {}

  void add(const simulation::GroundTruth& truth, const MotionPlan& plan);
  void write(Metrics& metrics) const;

 private:
  struct Foot {
    bool was_contact = true;
    double touched_at = kNaN;   // start of this touch [s]
    double touching_at = kNaN;  // last touch [s]
  };
  void judge(const Foot& foot, double time);

  double time_scale_;
  std::array<Foot, kMaxLegs> feet_{};
  std::vector<double> latencies_;  // [s]
  int false_touchdowns_ = 0;
};

}  // namespace surefoot::evaluation
