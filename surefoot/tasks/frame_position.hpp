#pragma once

#include "surefoot/tasks/frame_task.hpp"

namespace surefoot::tasks {

/// The origin of a frame F follows its reference in X; see `FrameTask`.
///
///     J_XF u̇ = a_ref + kd (v_ref − v_XF) + kp (p_ref − p_XF) − J̇_XF u     (as Eq. 19) [m/s²]
class FramePosition final : public FrameTask {
 public:
  struct Options {
    std::string frame = {};
    HeldIn held_in = HeldIn::base;
    double kp = 100.0;       ///< [1/s²]
    double kd = 20.0;        ///< [1/s]
    double max_error = 0.1;  ///< limit of the position error [m]
  };

  explicit FramePosition(const Options& options)
      : FrameTask(options.frame, options.held_in), options_(options) {}

  void write(const TaskInput& input, solver::Level& level) const noexcept override;
  [[nodiscard]] std::string_view name() const override { return "frame_position"; }
  [[nodiscard]] std::string row_name(int id) const override {
    return frame_name() + " " + "xyz"[id];
  }

 private:
  Options options_;
};

}  // namespace surefoot::tasks
