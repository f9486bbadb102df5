#pragma once

#include "surefoot/tasks/chosen_joints.hpp"
#include "surefoot/tasks/task.hpp"

#include <string>

namespace surefoot::tasks {

/// Slows joints down, without a place for them: beside a task in its level they are slow where it
/// asks for much of them, as near a singular posture, and it goes where it wants to.
///
///     q̈_j = −kd q̇_j     (ours; damped least squares on the speed)
///
/// Writes a row for each joint that it is for [rad/s²].
class JointDamping final : public Task {
 public:
  struct Options {
    std::string joints = "arms";  ///< words of `ChosenJoints`
    double kd = 10.0;             ///< [1/s]
  };

  explicit JointDamping(const Options& options) : options_(options) {}

  void write(const TaskInput& input, solver::Level& level) const noexcept override;
  [[nodiscard]] int max_rows() const override { return num_joints(); }
  [[nodiscard]] std::string_view name() const override { return "joint_damping"; }
  [[nodiscard]] std::string row_name(int id) const override { return joint_name(id); }

 private:
  void find_parts(const model::RobotDescription& robot) override;

  Options options_;
  ChosenJoints joints_;
};

}  // namespace surefoot::tasks
