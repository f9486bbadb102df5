#pragma once

#include "surefoot/simulation/plant_options.hpp"

#include <vector>

namespace surefoot::simulation {

/// From commanded torques to torques at the joints.
///
/// `ideal`: the command, clipped to the robot's torque limits.
///
/// `sea`: the clipped command times the gain arrives `delay_ticks` control ticks later, passes a
/// first-order lag τ̇ = 2πf (τ_command − τ), integrated exactly over each physics step, is limited
/// by the torque–speed line
///
///     τ ≤ stall · clip(1 − q̇/no_load, 0, 1),   τ ≥ −stall · clip(1 + q̇/no_load, 0, 1)
///
/// and is rounded to the torque's quantum. It starts with no torque.
class Actuators {
 public:
  Actuators(const ActuatorOptions& options, const JointVector& torque_limit, double timestep);

  /// A new command [N·m], once a control tick.
  void command(const JointVector& torque) noexcept;
  /// Torques at the joints now, at joint velocities `qd` [N·m].
  [[nodiscard]] JointVector torque(const JointVector& qd) const noexcept;
  /// Time goes on by one physics step.
  void advance() noexcept;

 private:
  ActuatorOptions options_;
  JointVector limit_;
  double lag_;                        ///< share of the gap that is closed in one physics step
  std::vector<JointVector> delayed_;  ///< ring of the last commands
  std::size_t oldest_ = 0;
  JointVector commanded_ = JointVector::Zero();  ///< the command that has arrived
  JointVector motor_ = JointVector::Zero();      ///< after the lag
};

}  // namespace surefoot::simulation
