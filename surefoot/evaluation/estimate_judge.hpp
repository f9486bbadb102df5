#pragma once

#include "surefoot/evaluation/metrics.hpp"
#include "surefoot/signals/robot_state.hpp"
#include "surefoot/simulation/ground_truth.hpp"

namespace surefoot {

/// Holds the believed base state against the true one. Velocity is compared in B and tilt by the
/// direction of the vertical in B, so that the heading, which can't be observed, plays no part.
/// Drift is what the way since the first tick is off by, begun with the same heading.
class EstimateJudge {
 public:
  void add(const GroundTruth& truth, const RobotState& state);
  void write(Metrics& metrics) const;

 private:
  struct Pose {
    Vec3 p = Vec3::Zero();
    Mat3 R = Mat3::Identity();
  };

  long ticks_ = 0;
  double velocity_squares_ = 0.0, tilt_squares_ = 0.0, tilt_max_ = kNaN;
  Pose true_start_, true_end_, believed_start_, believed_end_;
};

}  // namespace surefoot
