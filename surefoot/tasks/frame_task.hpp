#pragma once

#include "surefoot/tasks/task.hpp"

#include <optional>
#include <string>

namespace surefoot::tasks {

enum class HeldIn { base, world };

/// A task by which a frame F follows the plan's reference in X, which is the base B or W: held
/// where it was, commanded, or by a planner. In B only the joints move the frame: the base does not
/// help. Without a frame: the tip of the arm that reaches, in W. Three rows in the axes of X, or
/// none if no arm reaches.
class FrameTask : public Task {
 public:
  [[nodiscard]] int max_rows() const override { return 3; }
  [[nodiscard]] model::FollowedFrame follows() const override { return frame_; }

 protected:
  /// The motion and its reference, both in X.
  struct Motion {
    model::FrameKinematics now;
    FramePlan reference;
  };

  FrameTask(const std::string& frame, HeldIn held_in) : name_(frame), held_in_(held_in) {}

  /// Without a reference in the plan the frame is to stay where it is. None: no arm reaches.
  [[nodiscard]] std::optional<Motion> motion(const TaskInput& input) const noexcept;
  /// For the names of rows.
  [[nodiscard]] std::string frame_name() const { return name_.empty() ? "tip" : name_; }

 private:
  void find_parts(const model::RobotDescription& robot) override;

  std::string name_;
  HeldIn held_in_;
  model::FollowedFrame frame_;
};

}  // namespace surefoot::tasks
