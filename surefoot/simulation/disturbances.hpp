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

/// Pushes by their time, and what pulls beside them. A push acts at the centre of mass of the link
/// it is given for; at the origin of the base link if that link's own inertia was dropped.
class Pushes {
 public:
  /// Throws UnknownNameError, with the robot's links, for a body that does not exist.
  Pushes(const std::vector<Push>& pushes, const mjModel& model, const std::string& base_link);

  /// One more; those that are long over at `time` [s], which is now, are forgotten. Throws as the
  /// constructor.
  void add(const Push& push, double time);
  /// In the place of what pulled before. Throws as the constructor.
  void set(const Pull& pull);
  /// What there is to push, by name.
  [[nodiscard]] std::vector<std::string> bodies() const;

  /// Sets the external forces of the physics step that comes: a push that covers only a part of the
  /// step acts with that share, so that its impulse is exact.
  void apply(double timestep, mjData& data) const noexcept;

 private:
  struct Force {
    Push push;
    int body;
  };

  void apply_pull(mjData& data) const noexcept;
  [[nodiscard]] int body_of(const std::string& body, const std::string& key) const;

  const mjModel& model_;
  std::string base_link_;
  std::vector<Force> forces_;
  Pull pull_;
  int pulled_ = -1;            // body that `pull_` acts on; −1: none
  std::vector<int> released_;  // bodies that it acted on before
};

}  // namespace surefoot::simulation
