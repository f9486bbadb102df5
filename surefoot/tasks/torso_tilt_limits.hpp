#pragma once

#include "surefoot/tasks/motion_bound.hpp"
#include "surefoot/tasks/task.hpp"

namespace surefoot::tasks {

/// Bounds the torso's lean against gravity, by the rule of Bellicoso 2016, Eq. 27.
///
///     |s_i| ≤ sin(max_i),   s_i = a_iᵀ n,   n = R_WB e_z,
///     ṡ_i = (n × a_i)ᵀ w,   s̈_i = (n × a_i)ᵀ ẇ + a_iᵀ (w × (w × n))
///
/// a_i are the horizontal forward and left directions of the control frame C: a forward lean is
/// pitch, a sideways lean is roll. Sines make the rows exact. Writes 2 rows [rad/s²].
class TorsoTiltLimits final : public Task {
 public:
  struct Options {
    double max_roll = 0.35;   ///< [rad], below π/2
    double max_pitch = 0.45;  ///< [rad], below π/2
    double dt = 0.1;          ///< δt of Eq. 27 [s]
    BoundResponse response = BoundResponse::paper;
  };

  /// Throws Error unless 0 < max_roll, max_pitch < π/2 and dt > 0.
  explicit TorsoTiltLimits(const Options& options);

  void write(const TaskInput& input, solver::Level& level) const noexcept override;
  [[nodiscard]] int max_rows() const override { return 2; }
  [[nodiscard]] std::string_view name() const override { return "torso_tilt_limits"; }
  [[nodiscard]] std::string row_name(int id) const override;

 private:
  Options options_;
  MotionBound bound_;
};

}  // namespace surefoot::tasks
