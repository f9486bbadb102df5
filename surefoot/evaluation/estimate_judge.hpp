#pragma once

#include "surefoot/evaluation/metrics.hpp"
#include "surefoot/evaluation/start_alignment.hpp"

namespace surefoot::evaluation {

/// Mean of a normalised squared error (NEES).
class Nees {
 public:
  void add(double value);
  [[nodiscard]] double mean() const;

 private:
  double sum_ = 0.0;
  long count_ = 0;
};

/// Compares the estimated base state with the truth. Compares velocity in B and tilt by the
/// direction of the vertical in B, as the heading is not observable. Drift is the error of the way
/// since the first tick, from the same initial heading (StartAlignment).
class EstimateJudge {
 public:
  void add(const simulation::GroundTruth& truth, const RobotState& state);
  void write(Metrics& metrics) const;

 private:
  long ticks_ = 0;
  double velocity_squares_ = 0.0, tilt_squares_ = 0.0, tilt_max_ = kNaN;
  Nees velocity_nees_, tilt_nees_;
  std::optional<StartAlignment> start_;
  AlignedEstimate end_;
};

}  // namespace surefoot::evaluation
