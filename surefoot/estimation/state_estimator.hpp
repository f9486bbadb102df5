#pragma once

#include "surefoot/signals/robot_state.hpp"
#include "surefoot/signals/sensor_reading.hpp"
#include "surefoot/signals/tick_context.hpp"

namespace surefoot::estimation {

/// Estimates the state from sensor readings.
class StateEstimator {
 public:
  StateEstimator() = default;
  StateEstimator(const StateEstimator&) = delete;
  StateEstimator& operator=(const StateEstimator&) = delete;
  virtual ~StateEstimator() = default;

  /// One tick. `context` is from the tick before. The ContactForceEstimator fills `foot_force` of
  /// the result later.
  [[nodiscard]] virtual const RobotState& update(const SensorReading& reading,
                                                 const TickContext& context) noexcept = 0;

  /// Before an update: discards all readings so far (FirstReadings).
  virtual void restart() noexcept = 0;
};

}  // namespace surefoot::estimation
