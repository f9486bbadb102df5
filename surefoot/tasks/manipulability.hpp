#pragma once

#include "surefoot/signals/per_leg.hpp"
#include "surefoot/tasks/task.hpp"

namespace surefoot::tasks {

/// Manipulability of a leg, m = |det J| with J = [j_HAA j_HFE j_KFE] its 3×3 translational Jacobian
/// (Bellicoso 2016, Eq. 22), and its gradients.
struct LegManipulability {
  double m = 0.0;                ///< [m³]
  Vec3 gradient = Vec3::Zero();  ///< ∂m/∂q for HAA, HFE, KFE [m³/rad]
  double height_gradient = 0.0;  ///< ∂m/∂z_B with the foot fixed [m²]
};

/// Exact, from the joint axes a_i: ∂j_i/∂q_l = a_min(i,l) × j_max(i,l), and ∂q/∂z_B = −J⁻¹ e_z with
/// the foot fixed. Near a singular posture J⁻¹ uses |det J| = 1e-4 m³, times
/// `scale.length`³.
[[nodiscard]] LegManipulability leg_manipulability(const model::Dynamics& dynamics,
                                                   Leg leg) noexcept;

/// Moves the base to the height of best manipulability, instead of a given height.
///
///     e_zᵀ J_B u̇ = z̈_ref − e_zᵀ J̇_B u
///     paper:    z̈_ref = k0 Σ_k w_k ∂m_k/∂q_KFE − kd ż        (Bellicoso 2016, Eqs. 22–24)
///     chained:  z̈_ref = k0 Σ_k w_k ∂m_k/∂z_B − kd ż
///
/// The printed form adds gradients of knee angles to an acceleration in height: front and hind
/// knees that bend against each other (X-configuration) cancel. `chained` takes the gradients
/// through the kinematics with fixed feet. Writes 1 row [m/s²].
class Manipulability final : public Task {
 public:
  enum class Form { chained, paper };

  struct Options {
    Form form = Form::chained;
    double k0 = 30.0;               ///< `chained`: [1/(m s²)]; `paper`: [rad/(m² s²)]
    double kd = 28.0;               ///< damping of the height [1/s]
    double max_acceleration = 2.0;  ///< bound on the first term of z̈_ref [m/s²]
    PerLeg<double> weights =
        per_leg(1.0, kMaxLegs);  ///< w_k of six legs; four have no middle ones [–]
  };

  explicit Manipulability(const Options& options) : options_(options) {}

  void write(const TaskInput& input, solver::Level& level) const noexcept override;
  [[nodiscard]] int max_rows() const override { return 1; }
  [[nodiscard]] std::string_view name() const override { return "manipulability"; }
  [[nodiscard]] std::string row_name(int id) const override;

 private:
  Options options_;
};

}  // namespace surefoot::tasks
