#pragma once

#include "surefoot/model/description.hpp"
#include "surefoot/robot/robot_port.hpp"
#include "surefoot/simulation/ground_truth.hpp"
#include "surefoot/simulation/plant_options.hpp"

#include <memory>
#include <string>
#include <vector>

namespace surefoot::simulation {

/// The simulated robot: MuJoCo with a model from the controller's URDF, plus actuators, sensors,
/// terrain and disturbances.
class Plant final : public robot::RobotPort {
 public:
  /// Throws Error on an invalid option, with its name.
  Plant(const model::RobotDescription& description, const PlantOptions& options);
  ~Plant() override;

  /// Readings at the current time; also before the first write.
  [[nodiscard]] const SensorReading& read() override;
  /// Applies the command through the actuator model and advances the physics by one control period.
  void write(const JointCommand& command) override;

  /// Between two ticks: adds a push; a past start time means now. Throws UnknownNameError, listing
  /// the robot's links, for an unknown body.
  void push(const Push& push);
  /// Names of the bodies that can be pushed.
  [[nodiscard]] std::vector<std::string> bodies() const;

  /// Between two ticks: adds a sensor fault; a past start time means now. Throws Error on one that
  /// makes no sense.
  void fail(const SensorFault& fault);

  [[nodiscard]] const GroundTruth& truth() const;
  [[nodiscard]] double time() const;
  /// The compiled physics model as MJCF text, for the log.
  [[nodiscard]] std::string model_xml() const;
  [[nodiscard]] const std::vector<std::string>& notes() const;
  /// Height of the terrain under (x, y), by a ray from above [m]; NaN without terrain.
  [[nodiscard]] double terrain_height(double x, double y) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace surefoot::simulation
