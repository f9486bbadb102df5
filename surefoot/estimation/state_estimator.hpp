#pragma once

#include "surefoot/signals/robot_state.hpp"
#include "surefoot/signals/sensor_reading.hpp"
#include "surefoot/signals/tick_context.hpp"

namespace surefoot {

/// Makes the state that the controller believes from sensor readings.
class StateEstimator {
 public:
  StateEstimator() = default;
  StateEstimator(const StateEstimator&) = delete;
  StateEstimator& operator=(const StateEstimator&) = delete;
  virtual ~StateEstimator() = default;

  /// One tick. `context` is what the tick before left. `foot_force` of the result is filled later,
  /// by the ContactForceEstimator.
  [[nodiscard]] virtual const RobotState& update(const SensorReading& reading,
                                                 const TickContext& context) noexcept = 0;

  /// Before an update: all readings so far are worth nothing (FirstReadings).
  virtual void begin_anew() noexcept = 0;
};

}  // namespace surefoot
