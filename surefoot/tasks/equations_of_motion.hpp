#pragma once

#include "surefoot/tasks/task.hpp"

namespace surefoot::tasks {

/// Keeps accelerations and torques consistent with the dynamics, contact forces eliminated.
///
///     Q_uᵀ [−M  Sᵀ] x = Q_uᵀ h     (Bellicoso 2016, Eq. 15)
///
/// Writes n_u − rank(J_s) rows (n_u − 3 n_c unless a leg is singular) in mixed units of force and
/// torque [N, N·m].
class EquationsOfMotion final : public Task {
 public:
  void write(const TaskInput& input, solver::Level& level) const noexcept override;
  [[nodiscard]] int max_rows() const override { return 6 + num_joints(); }
  [[nodiscard]] std::string_view name() const override { return "equations_of_motion"; }
  [[nodiscard]] std::string row_name(int id) const override;
};

}  // namespace surefoot::tasks
