#pragma once

#include "surefoot/signals/sensor_reading.hpp"

namespace surefoot {

/// What is wrong with the sample of a tick.
enum class SampleFault : int {
  none = 0,
  silent = 1,        ///< no new sample for longer than is usual
  late = 2,          ///< new samples, but too old
  not_a_number = 3,  ///< or infinite
  out_of_range = 4,  ///< beyond what can be
  jump = 5,          ///< a change that no body makes in the time
  repeats = 6,       ///< the very same numbers again, as new samples
  contradicts = 7,   ///< what the other sensors say, or what was commanded
};

/// How one group of sensors is at a tick.
struct GroupHealth {
  SampleFault fault = SampleFault::none;
  /// Since the last good sample of each of its values, by sample times, or for how long it has been
  /// late, frozen or in contradiction [s]; NaN before the first.
  double age = kNaN;
  int joint = -1;  ///< the only one that is at fault, as in a JointVector; −1: none, or several
};

/// How the readings of a tick are. A group that never gave a good sample has no age: the robot
/// does not have it, or has it not yet.
struct SensorHealth {
  GroupHealth encoders, joint_torques, imu;
};

}  // namespace surefoot
