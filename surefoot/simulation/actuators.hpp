#pragma once

#include "surefoot/simulation/plant_options.hpp"
#include "surefoot/simulation/series_elastic_drive.hpp"

#include <vector>

namespace surefoot::simulation {

/// Turns commanded torques into torques at the joints.
///
/// `ideal`: the command, clipped to the robot's torque limits.
///
/// `sea`: the clipped command times the gains arrives `delay_ticks` control ticks later; before the
/// first there is no torque, or that of `rest_at`. At level 1 it passes a first-order lag
/// τ̇ = 2πf (τ_command − τ), integrated exactly over each physics step, the torque–speed line at the
/// joint's speed and the torque quantum. At level 2 it is the reference of each joint's
/// SeriesElasticDrive.
class Actuators {
 public:
  Actuators(const ActuatorOptions& options, const JointVector& torque_limit, double timestep,
            Eigen::Index num_leg_joints = kNumLegJoints);

  /// At rest under torques [N·m] commanded for long, with the joints at `q` [rad].
  void rest_at(const JointVector& q, const JointVector& torque) noexcept;
  /// A new command [N·m], once a control tick.
  void command(const JointVector& torque) noexcept;
  /// Current torques at the joints, at joint angles `q` and velocities `qd` [N·m].
  [[nodiscard]] JointVector torque(const JointVector& q, const JointVector& qd) const noexcept;
  /// Advances by one physics step, after which the joints are at `q`.
  void advance(const JointVector& q) noexcept;

 private:
  ActuatorOptions options_;
  JointVector limit_;
  JointVector gain_;
  JointVector quantum_;  ///< of legs; a leg's is more than the light bodies of an arm need
  double lag_;           ///< share of the gap closed in one physics step
  std::vector<JointVector> delayed_;  ///< ring of the last commands
  std::size_t oldest_ = 0;
  JointVector commanded_;                   ///< the command that has arrived
  JointVector motor_;                       ///< after the lag
  std::vector<SeriesElasticDrive> drives_;  ///< one a joint at level 2, otherwise none
};

}  // namespace surefoot::simulation
