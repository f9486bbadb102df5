#pragma once

#include "surefoot/tasks/task.hpp"

namespace surefoot::tasks {

/// The centre of mass follows its horizontal reference.
///
///     J_com u̇ = a_ref + kd (v_ref − v) + kp (p_ref − p) − J̇_com u
///
/// (Bellicoso 2016, Eq. 17, with the Jacobian of the centre of mass instead of the base's.) Two
/// rows along the x and y axes of the control frame C, projected into the horizontal plane [m/s²].
/// Two point feet can't push the centre of mass off their line without turning the torso. So with
/// two feet down there is only the row along that line, and none with fewer. A flat foot can.
class ComXy final : public Task {
 public:
  struct Options {
    double kp = 500.0;        ///< [1/s²]
    double kd = 45.0;         ///< [1/s]
    double max_error = 0.02;  ///< limit of the position error [m]
  };

  explicit ComXy(const Options& options) : options_(options) {}

  void write(const TaskInput& input, solver::Level& level) const noexcept override;
  [[nodiscard]] int max_rows() const override { return 2; }
  [[nodiscard]] int num_ids() const override { return 3; }
  [[nodiscard]] std::string_view name() const override { return "com_xy"; }
  [[nodiscard]] std::string row_name(int id) const override;

 private:
  void write_row(const TaskInput& input, const Vec2& direction, int id,
                 solver::Level& level) const noexcept;

  Options options_;
};

}  // namespace surefoot::tasks
