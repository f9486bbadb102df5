#pragma once

#include "surefoot/model/description.hpp"
#include "surefoot/robot/robot_port.hpp"
#include "surefoot/simulation/ground_truth.hpp"
#include "surefoot/simulation/plant_options.hpp"

#include <memory>
#include <string>
#include <vector>

namespace surefoot {

/// The robot's stand-in: MuJoCo on a model built from the same URDF that the controller reads, with
/// actuators, sensors, terrain and disturbances.
class Plant final : public RobotPort {
 public:
  /// Throws Error on options that make no sense, naming the one.
  Plant(const RobotDescription& description, const PlantOptions& options);
  ~Plant() override;

  /// Readings at the current time. The first is available before the first write.
  [[nodiscard]] const SensorReading& read() override;
  /// Applies the command through the actuator model and advances the physics by one control period.
  void write(const JointCommand& command) override;

  /// Between two ticks: a push beside those of the options; one whose time is past begins now.
  /// Throws UnknownNameError, with the robot's links, for a body that does not exist.
  void push(const Push& push);
  /// Between two ticks: pulls from now on, in the place of what pulled before; a force of 0 ends
  /// it. Throws UnknownNameError as `push` does.
  void pull(const Pull& pull);
  /// What can be pushed.
  [[nodiscard]] std::vector<std::string> bodies() const;

  [[nodiscard]] const GroundTruth& truth() const;
  [[nodiscard]] double time() const;
  /// The compiled physics model as MJCF text, for the log.
  [[nodiscard]] std::string model_xml() const;
  [[nodiscard]] const std::vector<std::string>& notes() const;
  /// Height of the terrain under (x, y), by a ray from above [m]; NaN where there is none.
  [[nodiscard]] double terrain_height(double x, double y) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace surefoot
