#pragma once

#include "surefoot/evaluation/metrics.hpp"
#include "surefoot/evaluation/start_alignment.hpp"

namespace surefoot {

/// Holds the believed base state against the true one. Velocity is compared in B and tilt by the
/// direction of the vertical in B, so that the heading, which can't be observed, plays no part.
/// Drift is what the way since the first tick is off by, begun with the same heading
/// (StartAlignment).
class EstimateJudge {
 public:
  void add(const GroundTruth& truth, const RobotState& state);
  void write(Metrics& metrics) const;

 private:
  long ticks_ = 0;
  double velocity_squares_ = 0.0, tilt_squares_ = 0.0, tilt_max_ = kNaN;
  std::optional<StartAlignment> start_;
  AlignedEstimate end_;
};

}  // namespace surefoot
