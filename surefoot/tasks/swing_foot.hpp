#pragma once

#include "surefoot/tasks/task.hpp"

namespace surefoot::tasks {

/// Swing feet follow their references like a mass on spring and damper.
///
///     J_F u̇ = a_ref + kd (v_ref − v_F) + kp (p_ref − p_F) − J̇_F u     (Bellicoso 2016, Eq. 19)
///
/// F is the centre of the foot sphere. Writes 3 rows for each leg without contact, in W [m/s²];
/// rotating the three rows into C would not change the task.
class SwingFoot final : public Task {
 public:
  struct Options {
    double kp = 800.0;        ///< [1/s²]
    double kd = 56.0;         ///< [1/s]
    double max_error = 0.02;  ///< limit of the position error [m]
  };

  explicit SwingFoot(const Options& options) : options_(options) {}

  void write(const TaskInput& input, solver::Level& level) const noexcept override;
  [[nodiscard]] int max_rows() const override { return 3 * num_legs(); }
  [[nodiscard]] std::string_view name() const override { return "swing_foot"; }
  [[nodiscard]] std::string row_name(int id) const override { return leg_axis_name(id); }

 private:
  Options options_;
};

}  // namespace surefoot::tasks
