#pragma once

#include "surefoot/tasks/task.hpp"

namespace surefoot::tasks {

/// Joints go to the robot's nominal posture and stay there.
///
///     q̈_j = kp (q_nominal − q)_j − kd q̇_j     (ours)
///
/// Writes a row for each joint that it is for [rad/s²]; which arm reaches says the plan.
class Posture final : public Task {
 public:
  enum class Joints { arms, legs, all, idle_arms, reaching_arm };

  struct Options {
    Joints joints = Joints::arms;
    double kp = 60.0;         ///< [1/s²]
    double kd = 15.0;         ///< [1/s]
    double max_error = 0.15;  ///< limit of each joint's error [rad]
  };

  explicit Posture(const Options& options) : options_(options) {}

  void write(const TaskInput& input, solver::Level& level) const noexcept override;
  [[nodiscard]] int max_rows() const override { return num_joints(); }
  [[nodiscard]] std::string_view name() const override { return "posture"; }
  [[nodiscard]] std::string row_name(int id) const override { return joint_name(id); }

 private:
  void write(const TaskInput& input, int first, int count, solver::Level& level) const;

  Options options_;
};

}  // namespace surefoot::tasks
