#pragma once

#include "surefoot/signals/robot_state.hpp"
#include "surefoot/signals/sensor_reading.hpp"

namespace surefoot {

/// Makes the state that the controller believes from sensor readings.
class StateEstimator {
 public:
  StateEstimator() = default;
  StateEstimator(const StateEstimator&) = delete;
  StateEstimator& operator=(const StateEstimator&) = delete;
  virtual ~StateEstimator() = default;

  /// One tick. `foot_force` of the result is filled later, by the ContactForceEstimator.
  [[nodiscard]] virtual const RobotState& update(const SensorReading& reading) noexcept = 0;
};

}  // namespace surefoot
