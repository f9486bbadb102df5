#pragma once

#include "surefoot/evaluation/metrics.hpp"
#include "surefoot/signals/user_command.hpp"
#include "surefoot/simulation/ground_truth.hpp"

namespace surefoot::evaluation {

/// Measures the robot's deviation from the commanded path. The path starts under the feet's centre
/// when the walk begins, and follows the commanded velocity and yaw rate. Only deviation across the
/// path counts, not delay along it.
class PathJudge {
 public:
  explicit PathJudge(double period) : period_(period) {}

  /// A tick with commanded walking; `heading` of the torso's reference in the true world.
  void add(const simulation::GroundTruth& truth, const UserCommand& user, const Vec3& heading);
  void write(Metrics& metrics) const;

 private:
  void advance(const UserCommand& user);

  double period_;
  bool begun_ = false;
  double yaw_ = 0.0;
  Vec2 point_ = Vec2::Zero(), direction_ = Vec2::UnitX();  // of the path, in S
  double feet_ = 0.0, base_ = 0.0;                         // largest deviations [m]
};

}  // namespace surefoot::evaluation
