#pragma once

#include "surefoot/signals/sensor_reading.hpp"

namespace surefoot {

/// The fault of a tick's sample.
enum class SampleFault : int {
  none = 0,
  silent = 1,        ///< no new sample for longer than usual
  late = 2,          ///< new samples, but too old
  not_a_number = 3,  ///< or infinite
  out_of_range = 4,  ///< physically impossible
  jump = 5,          ///< changed faster than any body can
  repeats = 6,       ///< frozen: the very same numbers, as new samples
  contradicts = 7,   ///< disagrees with the other sensors or the command
};

/// Health of one group of sensors at a tick.
struct GroupHealth {
  SampleFault fault = SampleFault::none;
  /// Time since the last good sample of each of its values, by sample times, or for how long it has
  /// been late, frozen or in contradiction [s]; NaN before the first.
  double age = kNaN;
  int joint = -1;  ///< the only faulty one, as in a JointVector; −1: none, or several
};

/// Health of a tick's readings. A group without a good sample so far has no age: the robot lacks
/// it, or it has not started yet.
struct SensorHealth {
  GroupHealth encoders, joint_torques, imu;
};

}  // namespace surefoot
