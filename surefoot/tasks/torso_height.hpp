#pragma once

#include "surefoot/tasks/task.hpp"

namespace surefoot::tasks {

/// The base follows its desired height in W.
///
///     e_zᵀ J_B u̇ = z̈_ref + kd (ż_ref − ż) + kp (z_ref − z) − e_zᵀ J̇_B u
///
/// The row of Bellicoso 2016, Eq. 24, for a height. Writes 1 row [m/s²].
class TorsoHeight final : public Task {
 public:
  struct Options {
    double kp = 200.0;        ///< [1/s²]
    double kd = 28.0;         ///< [1/s]
    double max_error = 0.02;  ///< limit of the height error [m]
  };

  explicit TorsoHeight(const Options& options) : options_(options) {}

  void write(const TaskInput& input, solver::Level& level) const noexcept override;
  [[nodiscard]] int max_rows() const override { return 1; }
  [[nodiscard]] std::string_view name() const override { return "torso_height"; }
  [[nodiscard]] std::string row_name(int id) const override;

 private:
  Options options_;
};

}  // namespace surefoot::tasks
