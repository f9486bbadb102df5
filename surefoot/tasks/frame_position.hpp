#pragma once

#include "surefoot/tasks/task.hpp"

namespace surefoot::tasks {

/// The tip T of an arm follows the plan's position, if the operator asks for one.
///
///     J_T u̇ = a_ref + kd (v_ref − v_T) + kp (p_ref − p_T) − J̇_T u     (as Eq. 19, for any frame)
///
/// Writes 3 rows in W [m/s²], or none.
class FramePosition final : public Task {
 public:
  struct Options {
    double kp = 100.0;       ///< [1/s²]
    double kd = 20.0;        ///< [1/s]
    double max_error = 0.1;  ///< limit of the position error [m]
  };

  explicit FramePosition(const Options& options) : options_(options) {}

  void write(const TaskInput& input, solver::Level& level) const noexcept override;
  [[nodiscard]] int max_rows() const override { return 3; }
  [[nodiscard]] std::string_view name() const override { return "frame_position"; }
  [[nodiscard]] std::string row_name(int id) const override {
    return std::string("tip ") + "xyz"[id];
  }

 private:
  Options options_;
};

}  // namespace surefoot::tasks
