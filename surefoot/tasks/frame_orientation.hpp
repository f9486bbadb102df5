#pragma once

#include "surefoot/tasks/frame_task.hpp"

namespace surefoot::tasks {

/// A frame F turns as its reference in X does; see `FrameTask`.
///
///     J_R u̇ = kd (w_ref − w_XF) + kp (q_ref ⊟ q_XF) − J̇_R u     (as Eq. 18) [rad/s²]
class FrameOrientation final : public FrameTask {
 public:
  struct Options {
    std::string frame = {};
    HeldIn held_in = HeldIn::base;
    double kp = 100.0;       ///< [1/s²]
    double kd = 20.0;        ///< [1/s]
    double max_error = 0.3;  ///< limit of the orientation error [rad]
  };

  explicit FrameOrientation(const Options& options)
      : FrameTask(options.frame, options.held_in), options_(options) {}

  void write(const TaskInput& input, solver::Level& level) const noexcept override;
  [[nodiscard]] std::string_view name() const override { return "frame_orientation"; }
  [[nodiscard]] std::string row_name(int id) const override {
    return frame_name() + " about " + "xyz"[id];
  }

 private:
  Options options_;
};

}  // namespace surefoot::tasks
