#pragma once

#include "surefoot/signals/joint_command.hpp"
#include "surefoot/signals/sensor_reading.hpp"

namespace surefoot::robot {

/// The port to a robot, real or simulated: sensors out, torques in.
class RobotPort {
 public:
  RobotPort() = default;
  RobotPort(const RobotPort&) = delete;
  RobotPort& operator=(const RobotPort&) = delete;
  virtual ~RobotPort() = default;

  /// The newest sensor readings.
  [[nodiscard]] virtual const SensorReading& read() = 0;
  /// Sends torques; they hold until the next write (zero-order hold).
  virtual void write(const JointCommand& command) = 0;
};

}  // namespace surefoot::robot
