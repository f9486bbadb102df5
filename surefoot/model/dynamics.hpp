#pragma once

#include "surefoot/base/scale.hpp"
#include "surefoot/signals/leg.hpp"

#include <vector>

namespace surefoot::model {

using Jacobian3 = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, kMaxVelocities>;
using MassMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor,
                                 kMaxVelocities, kMaxVelocities>;

/// J u of three rows. The columns that every walker has, of the base and four legs, have a fixed
/// size, which is faster.
template <typename Rows, typename Velocity>
[[nodiscard]] Vec3 product(const Rows& J, const Velocity& u) {
  constexpr int kLeast = 6 + kNumLegJoints;
  const Eigen::Index more = u.size() - kLeast;
  if (more < 0) return J * u;
  Vec3 result = J.template leftCols<kLeast>() * u.template head<kLeast>();
  if (more > 0) result += J.rightCols(more) * u.tail(more);
  return result;
}

/// Position, velocity and Jacobian of a point P: v_WP = J u, a_WP = J u̇ + Jdot_u (classical), all
/// in W.
struct PointKinematics {
  Vec3 p = Vec3::Zero();
  Vec3 v = Vec3::Zero();
  Jacobian3 J = Jacobian3::Zero(3, 6 + kNumLegJoints);
  Vec3 Jdot_u = Vec3::Zero();
};

/// Orientation of a body: w_WX = J u, ẇ_WX = J u̇ + Jdot_u, all in W.
struct RotationKinematics {
  Mat3 R = Mat3::Identity();
  Vec3 w = Vec3::Zero();
  Jacobian3 J = Jacobian3::Zero(3, 6 + kNumLegJoints);
  Vec3 Jdot_u = Vec3::Zero();
};

/// A frame on a body.
struct FrameKinematics {
  PointKinematics point;  ///< its origin
  RotationKinematics rotation;
};

/// The base, or the body behind a joint; all in W.
struct BodyKinematics {
  int parent = -1;            ///< 0: the base; 1 + j: the body behind joint j; −1: this is the base
  Mat3 R = Mat3::Identity();  ///< takes its coordinates to W
  Vec3 p = Vec3::Zero();      ///< its origin: of a body behind a joint, on the joint's axis [m]
  Vec3 v = Vec3::Zero();      ///< of its origin [m/s]
  Vec3 w = Vec3::Zero();      ///< [rad/s]
  Vec3 a = Vec3::Zero();      ///< of its origin at u̇ = 0, classical [m/s²]
  Vec3 wdot = Vec3::Zero();   ///< at u̇ = 0 [rad/s²]
  Vec3 axis = Vec3::Zero();   ///< of its joint, unit
};

/// Coupling of each link l of a leg (columns: hip, thigh, shank) with each joint j (rows). With
/// S_j the joint's axis, h_l the link's momentum and g_l its weight, spatial vectors in W,
///
///     momentum_jl = S_jᵀ h_l,   free_rate_jl = Ṡ_jᵀ h_l + S_jᵀ g_l
///
/// for l beyond j, else 0. In the air τ_j = Σ_l d/dt momentum_jl − free_rate_jl for any base
/// motion. Both scale with the link's mass if its inertia does.
struct LegLinks {
  Mat3 momentum = Mat3::Zero();   ///< [N·m·s]
  Mat3 free_rate = Mat3::Zero();  ///< [N·m]
};

/// All model quantities at one state, with u = (v_WB in W, w_WB_B in B, q̇)
/// and M u̇ + h = Sᵀτ + Σ J_Cᵀ λ (Eq. 2).
struct Dynamics {
  explicit Dynamics(int num_joints = kNumLegJoints, std::size_t num_arms = 0,
                    int num_legs = kNumLegs);

  MassMatrix M;                      ///< n_u × n_u
  GeneralizedVector h;               ///< n_u
  GeneralizedVector u;               ///< n_u
  JointVector q;                     ///< n_τ
  RotationKinematics base_rotation;  ///< of B
  PointKinematics base;              ///< origin of B
  PointKinematics com;               ///< whole-body centre of mass
  double mass = 0.0;                 ///< [kg]
  Scale scale;                       ///< of the robot as described
  PerLeg<PointKinematics> hip;       ///< hip H, on the HFE axis
  PerLeg<PointKinematics> foot;      ///< centre of the foot sphere F, or of the sole
  PerLeg<RotationKinematics> shank;  ///< the body that carries the foot
  /// Lowest point of the foot sphere along the terrain normal n: p_F − r n. When rolling without
  /// slip its material velocity is zero and J u̇ + Jdot_u = 0, with Jdot_u lacking the centripetal
  /// part ω × (ω × (−r n)), as the centre of a rolling sphere does not fall. Of a flat foot: the
  /// centre of its sole.
  PerLeg<PointKinematics> contact;
  PerLeg<LegLinks> links;           ///< of a walker
  Vec2 sole = Vec2::Zero();         ///< half length and half width of flat feet; zero: spheres
  PerLeg<JointRange> leg_joints{};  ///< of each leg
  std::vector<FrameKinematics> arm_tips;  ///< by arm
  std::vector<BodyKinematics> bodies;     ///< as `BodyFrame::body`: see `frame_kinematics`

  [[nodiscard]] int num_legs() const { return static_cast<int>(foot.size()); }
  [[nodiscard]] bool has_flat_feet() const { return sole.x() > 0.0; }
  /// Rows of a contact's Jacobian: a flat foot also bears moments.
  [[nodiscard]] int contact_rows() const { return has_flat_feet() ? 6 : 3; }
  [[nodiscard]] int num_joints() const { return static_cast<int>(q.size()); }      ///< n_τ
  [[nodiscard]] int num_velocities() const { return static_cast<int>(u.size()); }  ///< n_u
};

}  // namespace surefoot::model
