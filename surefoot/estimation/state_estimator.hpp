#pragma once

#include "surefoot/signals/robot_state.hpp"
#include "surefoot/signals/sensor_reading.hpp"
#include "surefoot/signals/tick_context.hpp"

namespace surefoot::estimation {

/// Estimates the state from sensor readings. `LegInertialEstimator` is the library's; derive one of
/// your own for other sensors. If it throws, the controller acts as without a state.
class StateEstimator {
 public:
  StateEstimator() = default;
  StateEstimator(const StateEstimator&) = delete;
  StateEstimator& operator=(const StateEstimator&) = delete;
  virtual ~StateEstimator() = default;

  /// One tick. `context` is from the tick before. Joint vectors of the result have the robot's
  /// size. The ContactForceEstimator fills `foot_force` later; NaN in time, base or joints, while
  /// all sensors are there, counts as an error as above. Must not allocate.
  [[nodiscard]] virtual const RobotState& update(const SensorReading& reading,
                                                 const TickContext& context) = 0;

  /// Before an update: discards all readings so far (FirstReadings).
  virtual void restart() = 0;

  /// Is it one of your own? A log says so, as others can't compute its states again.
  [[nodiscard]] virtual bool is_own() const noexcept { return true; }
};

}  // namespace surefoot::estimation
