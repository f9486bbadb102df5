#pragma once

#include "surefoot/tasks/task.hpp"

namespace surefoot::tasks {

/// Keeps every torque within its actuator's limit.
///
///     −s(−q̇) τ_max ≤ τ ≤ s(q̇) τ_max     (Bellicoso 2016, Eq. 28; s is ours)
///
/// s is the `fraction`; with `speed_line: linear` it falls to 0 between the corner speed and the
/// joint's velocity limit, in the direction of motion only: a fast motor can't push on, but can
/// brake. Writes n_τ rows [N·m].
class TorqueLimits final : public Task {
 public:
  enum class SpeedLine { none, linear };

  struct Options {
    double fraction = 1.0;  ///< usable share of the robot's torque limit [–]
    SpeedLine speed_line = SpeedLine::none;
    double corner_speed = 0.5;  ///< start of the line, as a share of the velocity limit [–]
  };

  /// Throws Error unless 0 < fraction ≤ 1 and 0 ≤ corner_speed < 1.
  explicit TorqueLimits(const Options& options);

  void write(const TaskInput& input, solver::Level& level) const noexcept override;
  [[nodiscard]] int max_rows() const override { return num_joints(); }
  [[nodiscard]] std::string_view name() const override { return "torque_limits"; }
  [[nodiscard]] std::string row_name(int id) const override { return joint_name(id); }

 private:
  [[nodiscard]] double usable_fraction(double speed, double speed_limit) const noexcept;

  Options options_;
};

}  // namespace surefoot::tasks
