#pragma once

#include "surefoot/model/description.hpp"
#include "surefoot/simulation/mujoco_handles.hpp"
#include "surefoot/simulation/plant_options.hpp"

#include <string>
#include <vector>

namespace surefoot::simulation {

/// Gives the robot in the spec masses that the controller's model does not know: scales, an offset
/// of the base's centre of mass, a payload. What is fixed to the base link counts as base, the rest
/// as legs.
void disturb_masses(mjsBody& base, const RobotDescription& description,
                    const DisturbanceOptions& options);

/// Pushes by their time. A force acts at the centre of mass of the link it is given for; at the
/// origin of the base link if that link's own inertia was dropped.
class Pushes {
 public:
  /// Throws UnknownNameError, with the robot's links, for a body that does not exist.
  Pushes(const std::vector<Push>& pushes, const mjModel& model, const std::string& base_link);

  /// Sets the external forces of the physics step from `time` on: a push that covers only a part of
  /// the step acts with that share, so that its impulse is exact.
  void apply(double time, double timestep, mjData& data) const noexcept;

 private:
  struct Force {
    Push push;
    int body;
  };
  std::vector<Force> forces_;
};

}  // namespace surefoot::simulation
