#pragma once

#include "surefoot/tasks/task.hpp"

namespace surefoot::tasks {

/// Wants zero torques, so that a low level of the hierarchy minimizes them.
///
///     w_j τ_j = 0     (Bellicoso 2016, Eq. 20; the weights are ours)
///
/// Writes n_τ rows [N·m]. Legs with flat feet weigh 1.
class TorqueMinimisation final : public Task {
 public:
  struct Options {
    double weight_HAA = 1.0;  ///< of the hip abduction joints [–]
    double weight_HFE = 1.0;  ///< of the hip flexion joints [–]
    double weight_KFE = 1.0;  ///< of the knees [–]
    double weight_arm = 1.0;  ///< of the joints of arms [–]
  };

  explicit TorqueMinimisation(const Options& options)
      : legs_(options.weight_HAA, options.weight_HFE, options.weight_KFE),
        arms_(options.weight_arm) {}

  void write(const TaskInput& input, solver::Level& level) const noexcept override;
  [[nodiscard]] int max_rows() const override { return num_joints(); }
  [[nodiscard]] std::string_view name() const override { return "torque_minimisation"; }
  [[nodiscard]] std::string row_name(int id) const override { return joint_name(id); }

 private:
  Vec3 legs_;
  double arms_;
};

}  // namespace surefoot::tasks
