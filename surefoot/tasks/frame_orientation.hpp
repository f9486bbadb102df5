#pragma once

#include "surefoot/tasks/task.hpp"

namespace surefoot::tasks {

/// The tip T of an arm follows the plan's orientation, while the operator asks for a place.
///
///     J_R u̇ = kd (w_ref − w_T) + kp (q_ref ⊟ q_T) − J̇_R u     (as Eq. 18, for any frame)
///
/// Writes 3 rows in W [rad/s²], or none.
class FrameOrientation final : public Task {
 public:
  struct Options {
    double kp = 100.0;       ///< [1/s²]
    double kd = 20.0;        ///< [1/s]
    double max_error = 0.3;  ///< limit of the orientation error [rad]
  };

  explicit FrameOrientation(const Options& options) : options_(options) {}

  void write(const TaskInput& input, solver::Level& level) const noexcept override;
  [[nodiscard]] int max_rows() const override { return 3; }
  [[nodiscard]] std::string_view name() const override { return "frame_orientation"; }
  [[nodiscard]] std::string row_name(int id) const override {
    return std::string("tip about ") + "xyz"[id];
  }

 private:
  Options options_;
};

}  // namespace surefoot::tasks
