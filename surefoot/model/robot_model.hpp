#pragma once

#include "surefoot/model/description.hpp"
#include "surefoot/model/dynamics.hpp"
#include "surefoot/signals/base_load.hpp"
#include "surefoot/signals/kinematic_errors.hpp"
#include "surefoot/signals/robot_state.hpp"

#include <memory>
#include <string>
#include <vector>

namespace surefoot::model {

/// Kinematics and dynamics of a robot from its URDF (Pinocchio, hidden behind this header).
/// Allocates at construction only.
class RobotModel {
 public:
  /// Reads the URDF. Throws Error if a frame, joint or link of the description is unknown (the
  /// message lists the valid ones), a mass is negative, or the file is missing or broken. Ignores a
  /// placeholder inertia of the root link (at most 1 g, and massless or not positive definite),
  /// with a line in `notes()`.
  explicit RobotModel(RobotDescription description);
  ~RobotModel();
  RobotModel(RobotModel&&) noexcept;
  RobotModel& operator=(RobotModel&&) noexcept;

  /// All quantities of `Dynamics` at a state. `terrain_normal_W` is the unit normal that places the
  /// contact points on the foot spheres. Does not allocate or throw.
  const Dynamics& update(const RobotState& state, const Vec3& terrain_normal_W) noexcept;

  /// Makes thighs and shanks longer than in the URDF from the next update on; masses keep their
  /// place. Does not allocate.
  void set_leg_lengths(const KinematicErrors& legs) noexcept;

  /// Adds a payload to the base, in M, h and the centre of mass, from the next update on. The
  /// base's total mass must stay above 0. Does not allocate.
  void set_base_load(const BaseLoad& load) noexcept;

  /// Applies a wrench at the centre of mass, in W [N], [N·m], to the base like gravity: subtracts
  /// it from h of the last update, M u̇ + h − J_bᵀ w = Sᵀτ + Σ J_Cᵀ λ.
  void apply_wrench(const Vec3& force, const Vec3& moment) noexcept;

  [[nodiscard]] const Dynamics& dynamics() const;
  [[nodiscard]] const RobotDescription& description() const;
  [[nodiscard]] double mass() const;       ///< of the last update, with payload [kg]
  [[nodiscard]] double base_mass() const;  ///< of the base as described, without payload [kg]
  [[nodiscard]] const std::vector<std::string>& notes() const;

  /// Centre of the foot sphere in B for joint angles q of that leg (HAA, HFE, KFE) [m].
  [[nodiscard]] Vec3 foot_in_base(Leg leg, const Vec3& q_leg) const noexcept;
  /// Hip H in B at joint angles q of that leg [m].
  [[nodiscard]] Vec3 hip_in_base(Leg leg, const Vec3& q_leg) const noexcept;
  /// Joint angles that put the sphere centre at p_BF, from `guess`, which chooses the knee's side
  /// (damped Newton). Returns false and the closest angles if it can't be reached.
  [[nodiscard]] bool inverse_kinematics(Leg leg, const Vec3& p_BF, const Vec3& guess,
                                        Vec3& q_leg) const noexcept;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace surefoot::model
