#pragma once

#include "surefoot/tasks/task.hpp"

namespace surefoot::tasks {

/// Four faces that bound a foot's force.
struct FrictionPyramid {
  Mat3 axes = Mat3::Identity();  ///< ĥ, l̂, n̂ as columns, in W
  double mu = 0.0;               ///< μ'

  [[nodiscard]] Vec3 normal() const { return axes.col(2); }
  /// Share of it that a force λ in W uses: max(|ĥᵀλ|, |l̂ᵀλ|) / (μ' n̂ᵀλ). 1 at a face, more beyond
  /// it; not finite if n̂ᵀλ is 0.
  [[nodiscard]] double use(const Vec3& force) const;
};

/// Keeps contact forces inside a friction pyramid and their normal part within the plan's limits.
///
///     |ĥᵀλ_i| ≤ μ_i' n̂ᵀλ_i,   |l̂ᵀλ_i| ≤ μ_i' n̂ᵀλ_i           (Bellicoso 2016, Eq. 29)
///     min(f_min, f_max(t)) ≤ n̂ᵀλ_i ≤ f_max(t)               (Eq. 30)
///     λ = Λ x + λ₀                                           (Eq. 31)
///
/// ĥ, l̂, n̂ are the axes of the control frame C, μ_i the plan's friction of foot i. The pyramid with
/// μ' = μ touches the cone from outside and exceeds it on the diagonals by √2; with μ' = μ/√2 it
/// lies inside. If n̂ is inclined by more than 0.8 atan μ', a foot could hardly carry load inside
/// the pyramid: its axes are turned towards the vertical to that angle. Writes 5 rows for each leg
/// in contact [N].
///
/// A flat foot with half length X and half width Y bears a moment (τ_x, τ_y, τ_z) about its centre,
/// too, as four forces inside the pyramid at its corners do (Caron, Pham, Nakamura, "Stability of
/// surface contacts for humanoid robots", ICRA 2015, in the foot's axes, with X and Y times
/// `sole`):
///
///     |τ_x| ≤ Y f_z,   |τ_y| ≤ X f_z                        (centre of pressure in the sole)
///     |τ_z ∓ …| : −μ(X+Y) f_z + |Y f_x − μ τ_x| + |X f_y − μ τ_y| ≤ τ_z
///                 ≤ μ(X+Y) f_z − |Y f_x + μ τ_x| − |X f_y + μ τ_y|
///
/// which are 12 rows more for each leg in contact [N·m].
class FrictionCone final : public Task {
 public:
  enum class Pyramid { inner, outer };
  enum class Axes { control, gravity };

  struct Options {
    Pyramid pyramid = Pyramid::inner;
    Axes axes = Axes::control;
    double sole = 0.9;  ///< share of a flat foot that the centre of pressure may use [–]
  };

  static constexpr int kRowsPerLeg = 5, kMomentRows = 12;

  explicit FrictionCone(const Options& options) : options_(options) {}

  /// The pyramid of a leg in contact.
  [[nodiscard]] FrictionPyramid pyramid(const MotionPlan& plan, Leg leg) const;

  void write(const TaskInput& input, solver::Level& level) const noexcept override;
  [[nodiscard]] int max_rows() const override { return rows_per_leg() * num_legs(); }
  [[nodiscard]] std::string_view name() const override { return "friction_cone"; }
  [[nodiscard]] std::string row_name(int id) const override;

 private:
  [[nodiscard]] int rows_per_leg() const {
    return kRowsPerLeg + (has_flat_feet() ? kMomentRows : 0);
  }
  void write_moments(const TaskInput& input, Leg leg, double mu, solver::Level& level) const;

  Options options_;
};

}  // namespace surefoot::tasks
