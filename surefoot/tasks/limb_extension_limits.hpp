#pragma once

#include "surefoot/tasks/motion_bound.hpp"
#include "surefoot/tasks/task.hpp"

namespace surefoot::tasks {

/// Bounds the distance between hip H and foot F of every leg, in stance and in swing, so that the
/// torso follows a foot that reaches down (Bellicoso 2016, Eq. 35, by the rule of Eq. 27).
///
///     paper:     r = z_H − z_F,   ṙ = ż_H,          r̈ = e_zᵀ (J_H u̇ + J̇_H u)
///     relative:  r = z_H − z_F,   ṙ = ż_H − ż_F,    r̈ = e_zᵀ ((J_H − J_F) u̇ + (J̇_H − J̇_F) u)
///     radial:    r = ‖p_H − p_F‖, ṙ = eᵀ(v_H − v_F), e = (p_H − p_F)/r,
///                r̈ = eᵀ((J_H − J_F) u̇ + (J̇_H − J̇_F) u) + (‖v_H − v_F‖² − ṙ²)/r
///
/// `paper` ignores the foot's motion: lowering a foot at v violates the bound by δt·v. `relative`
/// includes it, but like `paper` sees only the vertical distance, so a leg that reaches sideways
/// can become straight; `radial` bounds the leg itself. Writes a row for each leg [m/s²].
class LimbExtensionLimits final : public Task {
 public:
  enum class Form { paper, relative, radial };

  struct Options {
    Form form = Form::relative;
    double min = 0.15;  ///< [m]
    double max = 0.52;  ///< [m]; `radial` on ANYmal B: 0.535
    double dt = 0.1;    ///< δt of Eq. 27 [s]
    BoundResponse response = BoundResponse::paper;
  };

  /// Throws Error unless 0 ≤ min < max and dt > 0.
  explicit LimbExtensionLimits(const Options& options);

  void write(const TaskInput& input, solver::Level& level) const noexcept override;
  [[nodiscard]] int max_rows() const override { return num_legs(); }
  [[nodiscard]] std::string_view name() const override { return "limb_extension_limits"; }
  [[nodiscard]] std::string row_name(int id) const override;

 private:
  Options options_;
  MotionBound bound_;
};

}  // namespace surefoot::tasks
