#pragma once

#include "surefoot/base/scale.hpp"
#include "surefoot/evaluation/metrics.hpp"
#include "surefoot/simulation/ground_truth.hpp"

namespace surefoot::evaluation {

/// Largest torques and joint speeds, and the mechanical cost of transport
///
///     ∫ Σ_j max(0, τ_j q̇_j) dt / (m g s)
///
/// of the robot's mass m over the way s in the plane from the start of walking to its end.
class EffortJudge {
 public:
  /// `mass` [kg]; NaN: no cost of transport.
  EffortJudge(double period, double mass, const Scale& scale)
      : period_(period), mass_(mass), shortest_(scale.length * kShortest) {}

  /// Every tick, with the torques that it commands.
  void add(const simulation::GroundTruth& truth, const JointVector& command);
  /// A tick with commanded walking, besides.
  void add_walk(const simulation::GroundTruth& truth);
  /// `way` [m].
  void write(double way, Metrics& metrics) const;

 private:
  static constexpr double kShortest = 0.5;  // way with a cost, at scale 1 [m]

  double period_, mass_, shortest_;
  double work_ = 0.0;  // [J]
  double torque_ = 0.0, torque_command_ = 0.0, torque_step_ = 0.0, speed_ = 0.0;
  JointVector command_;  // of the tick before
};

}  // namespace surefoot::evaluation
