#pragma once

#include "surefoot/tasks/chosen_joints.hpp"
#include "surefoot/tasks/motion_bound.hpp"
#include "surefoot/tasks/task.hpp"

#include <string>

namespace surefoot::tasks {

/// Keeps joints inside the robot's ranges, by the rule of Bellicoso 2016, Eq. 27.
///
///     q_min + margin ≤ q ≤ q_max − margin
///
/// Writes a row for each joint that it is for [rad/s²].
class JointPositionLimits final : public Task {
 public:
  struct Options {
    std::string joints = "all";  ///< words of `ChosenJoints`
    double margin = 0.05;        ///< distance kept from the ends of the range [rad]
    double dt = 0.1;             ///< δt of Eq. 27 [s]
    BoundResponse response = BoundResponse::no_overshoot;
  };

  /// Throws Error unless margin ≥ 0 and dt > 0.
  explicit JointPositionLimits(const Options& options);

  void write(const TaskInput& input, solver::Level& level) const noexcept override;
  [[nodiscard]] int max_rows() const override { return num_joints(); }
  [[nodiscard]] std::string_view name() const override { return "joint_position_limits"; }
  [[nodiscard]] std::string row_name(int id) const override { return joint_name(id); }

 private:
  void find_parts(const model::RobotDescription& robot) override;

  Options options_;
  MotionBound bound_;
  ChosenJoints joints_;
};

}  // namespace surefoot::tasks
