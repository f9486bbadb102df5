#pragma once

#include "surefoot/tasks/motion_bound.hpp"
#include "surefoot/tasks/task.hpp"

namespace surefoot::tasks {

/// Bounds the height of the base above its footprint.
///
///     min ≤ z_B − h_z ≤ max,   h_z = (1/n_c) Σ_k (p_Fk)_z over the legs in contact
///
/// (Bellicoso 2016, Eqs. 32–34, by the rule of Eq. 27.) F is the centre of the foot sphere. Writes
/// 1 row [m/s²], none without contact.
class BodyHeightLimits final : public Task {
 public:
  struct Options {
    double min = 0.25;  ///< [m]
    double max = 0.52;  ///< [m]
    double dt = 0.1;    ///< δt of Eq. 27 [s]
    BoundResponse response = BoundResponse::paper;
  };

  /// Throws Error unless min < max and dt > 0.
  explicit BodyHeightLimits(const Options& options);

  void write(const TaskInput& input, solver::Level& level) const noexcept override;
  [[nodiscard]] int max_rows() const override { return 1; }
  [[nodiscard]] std::string_view name() const override { return "body_height_limits"; }
  [[nodiscard]] std::string row_name(int id) const override;

 private:
  Options options_;
  MotionBound bound_;
};

}  // namespace surefoot::tasks
