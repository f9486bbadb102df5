#pragma once

#include "surefoot/tasks/task.hpp"

namespace surefoot::tasks {

/// Wants zero contact forces, so that a low level of the hierarchy minimizes internal forces.
///
///     W C_λ_i = 0,   λ = Λ x + λ₀     (Bellicoso 2016, Eq. 21; the weights are ours)
///
/// Writes 3 rows for each leg in contact, along the axes of the control frame C [N].
class ContactForceMinimisation final : public Task {
 public:
  struct Options {
    double weight_tangential = 1.0;  ///< of the forces along the ground [–]
    double weight_normal = 1.0;      ///< of the forces along the terrain normal [–]
  };

  explicit ContactForceMinimisation(const Options& options)
      : weights_(options.weight_tangential, options.weight_tangential, options.weight_normal) {}

  void write(const TaskInput& input, solver::Level& level) const noexcept override;
  [[nodiscard]] int max_rows() const override { return 3 * num_legs(); }
  [[nodiscard]] std::string_view name() const override { return "contact_force_minimisation"; }
  [[nodiscard]] std::string row_name(int id) const override { return leg_axis_name(id); }

 private:
  Vec3 weights_;
};

}  // namespace surefoot::tasks
