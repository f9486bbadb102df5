#pragma once

#include "surefoot/math/types.hpp"

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace surefoot {

/// The four legs, in the order of every array of this library (left/right, fore/hind).
enum class Leg : int { LF = 0, RF = 1, LH = 2, RH = 3 };

inline constexpr int kNumLegs = 4;
inline constexpr int kJointsPerLeg = 3;  ///< HAA, HFE, KFE
inline constexpr int kNumLegJoints = kNumLegs * kJointsPerLeg;
inline constexpr int kMaxJoints = 32;  ///< of a robot, legs and arms together
inline constexpr int kMaxVelocities = 6 + kMaxJoints;

inline constexpr std::array<Leg, kNumLegs> kLegs{Leg::LF, Leg::RF, Leg::LH, Leg::RH};
inline constexpr std::array<std::string_view, kNumLegs> kLegNames{"LF", "RF", "LH", "RH"};
inline constexpr std::array<std::string_view, kJointsPerLeg> kJointNames{"HAA", "HFE", "KFE"};

template <typename T>
using PerLeg = std::array<T, kNumLegs>;

/// Joint-space vector of n_τ numbers, fixed when the robot is loaded: joint j of leg k stands at
/// 3 k + j, and the joints of arms follow. Never allocates.
using JointVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMaxJoints, 1>;
/// The same of the legs alone.
using LegJointVector = Eigen::Matrix<double, kNumLegJoints, 1>;
/// Generalized velocity u = (v_WB in W, w_WB in B, q̇) or acceleration (Eq. 1), n_u = 6 + n_τ.
using GeneralizedVector =
    Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMaxVelocities, 1>;

[[nodiscard]] constexpr std::size_t index(Leg leg) { return static_cast<std::size_t>(leg); }
[[nodiscard]] constexpr bool is_front(Leg leg) { return leg == Leg::LF || leg == Leg::RF; }
[[nodiscard]] constexpr bool is_left(Leg leg) { return leg == Leg::LF || leg == Leg::LH; }
/// The leg on the same side at the other end.
[[nodiscard]] constexpr Leg same_side(Leg leg) {
  return static_cast<Leg>((static_cast<int>(leg) + 2) % kNumLegs);
}
/// "LF_HAA" for 0, "LF_HFE" for 1, …, "RH_KFE" for 11.
[[nodiscard]] inline std::string leg_joint_name(int joint) {
  return std::string(kLegNames[static_cast<std::size_t>(joint / kJointsPerLeg)]) + "_" +
         std::string(kJointNames[static_cast<std::size_t>(joint % kJointsPerLeg)]);
}
/// First joint of a leg in a JointVector.
[[nodiscard]] constexpr int first_joint(Leg leg) { return kJointsPerLeg * static_cast<int>(leg); }

}  // namespace surefoot
