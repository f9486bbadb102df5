#pragma once

#include "surefoot/evaluation/metrics.hpp"
#include "surefoot/signals/user_command.hpp"
#include "surefoot/simulation/ground_truth.hpp"

namespace surefoot {

/// How far the robot comes off the path that it is asked to walk. The path begins under the centre
/// of the feet where the walk begins, and goes on with the commanded velocity and yaw rate. Only
/// what lies across its direction counts: who is late is still on the path.
class PathJudge {
 public:
  explicit PathJudge(double period) : period_(period) {}

  /// A tick at which walking is commanded; `heading` is that of the torso's reference in the true
  /// world.
  void add(const GroundTruth& truth, const UserCommand& user, const Vec3& heading);
  void write(Metrics& metrics) const;

 private:
  void go_on(const UserCommand& user);

  double period_;
  bool begun_ = false;
  double yaw_ = 0.0;
  Vec2 point_ = Vec2::Zero(), direction_ = Vec2::UnitX();  // of the path, in the true W
  double feet_ = 0.0, base_ = 0.0;                         // farthest [m]
};

}  // namespace surefoot
