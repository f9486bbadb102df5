#pragma once

#include "surefoot/tasks/chosen_joints.hpp"
#include "surefoot/tasks/task.hpp"

#include <string>

namespace surefoot::tasks {

/// Joints go to a posture and stay there: the robot's nominal one, or the plan's.
///
///     q̈_j = kp (q_ref − q)_j − kd q̇_j     (ours)
///
/// Writes a row for each joint that it is for [rad/s²]; which arm reaches says the plan.
class Posture final : public Task {
 public:
  enum class Target { nominal, plan };

  struct Options {
    std::string joints = "arms";  ///< words of `ChosenJoints`
    Target target = Target::nominal;
    double kp = 60.0;         ///< [1/s²]
    double kd = 15.0;         ///< [1/s]
    double max_error = 0.15;  ///< limit of each joint's error [rad]
  };

  explicit Posture(const Options& options) : options_(options) {}

  void write(const TaskInput& input, solver::Level& level) const noexcept override;
  [[nodiscard]] int max_rows() const override { return num_joints(); }
  [[nodiscard]] std::string_view name() const override { return "posture"; }
  [[nodiscard]] std::string row_name(int id) const override { return joint_name(id); }
  [[nodiscard]] bool follows_joints() const override { return options_.target == Target::plan; }

 private:
  void find_parts(const model::RobotDescription& robot) override;
  void write(const TaskInput& input, int joint, solver::Level& level) const;

  Options options_;
  ChosenJoints joints_;
};

}  // namespace surefoot::tasks
