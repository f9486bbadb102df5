#pragma once

#include "surefoot/base/scale.hpp"
#include "surefoot/evaluation/metrics.hpp"
#include "surefoot/signals/user_command.hpp"
#include "surefoot/simulation/ground_truth.hpp"

namespace surefoot::evaluation {

/// Compares the true velocity of the centre of mass, and the torso's yaw rate, with the command, in
/// heading axes of the torso. (The base alone swings against the legs.) Only while the command has
/// not changed for `kSettled`, at scale 1, so that the robot has reached it.
class CommandJudge {
 public:
  static constexpr double kSettled = 3.0;  ///< [s]

  CommandJudge(double period, const Scale& scale)
      : period_(period), settled_(scale.time() * kSettled) {}

  /// A tick with commanded walking.
  void add(const simulation::GroundTruth& truth, const UserCommand& user);
  void write(Metrics& metrics) const;

 private:
  double period_, settled_;
  UserCommand command_;      // of the tick before
  double steady_for_ = 0.0;  // [s]
  double velocity_squares_ = 0.0, turn_squares_ = 0.0;
  long ticks_ = 0;
};

}  // namespace surefoot::evaluation
