#pragma once

#include "surefoot/math/types.hpp"

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace surefoot {

/// A leg, by its place in every list of this library: pairs from the front to the hind one, the
/// left leg first. The names are those of a quadruped.
enum class Leg : int { LF = 0, RF = 1, LH = 2, RH = 3 };

inline constexpr int kNumLegs = 4;       ///< of a quadruped
inline constexpr int kMaxLegs = 6;       ///< of a robot
inline constexpr int kJointsPerLeg = 3;  ///< HAA, HFE, KFE, which place a walker's foot
inline constexpr int kNumLegJoints = kNumLegs * kJointsPerLeg;
inline constexpr int kMaxLegJoints = 8;  ///< of a leg
inline constexpr int kMaxJoints = 32;    ///< of a robot, legs and arms together
inline constexpr int kMaxVelocities = 6 + kMaxJoints;

inline constexpr std::array<Leg, kNumLegs> kLegs{Leg::LF, Leg::RF, Leg::LH, Leg::RH};
inline constexpr std::array<Leg, kMaxLegs> kAllLegs{Leg{0}, Leg{1}, Leg{2}, Leg{3}, Leg{4}, Leg{5}};
/// The first legs of a robot: all of them, if it has that many.
[[nodiscard]] constexpr std::span<const Leg> first_legs(int num_legs) {
  return std::span(kAllLegs).first(static_cast<std::size_t>(num_legs));
}
inline constexpr std::array<std::string_view, kNumLegs> kLegNames{"LF", "RF", "LH", "RH"};
inline constexpr std::array<std::string_view, 2> kBipedLegNames{"L", "R"};
inline constexpr std::array<std::string_view, kMaxLegs> kHexapodLegNames{"LF", "RF", "LM",
                                                                         "RM", "LH", "RH"};
inline constexpr std::array<std::string_view, kJointsPerLeg> kJointNames{"HAA", "HFE", "KFE"};

/// One value for each leg of a robot, in its order: as many as the robot has, fixed when it is
/// loaded; those of a quadruped until then. Never allocates.
template <typename T>
class PerLeg {
 public:
  using value_type = T;

  constexpr PerLeg()
    requires std::default_initializable<T>
  = default;
  constexpr PerLeg(std::initializer_list<T> values) { assign(values); }
  /// The same for every leg.
  constexpr PerLeg(int num_legs, const T& value)
      : items_(copies(value, std::make_index_sequence<kMaxLegs>())), count_(num_legs) {}

  /// Further ones are as if made anew; at most kMaxLegs.
  constexpr void resize(int num_legs) { count_ = num_legs; }
  constexpr void fill(const T& value) { std::fill(begin(), end(), value); }

  [[nodiscard]] constexpr std::size_t size() const { return static_cast<std::size_t>(count_); }
  /// The legs that it has a value for.
  [[nodiscard]] constexpr std::span<const Leg> legs() const { return first_legs(count_); }
  [[nodiscard]] constexpr T* data() { return items_.data(); }
  [[nodiscard]] constexpr const T* data() const { return items_.data(); }
  [[nodiscard]] constexpr T* begin() { return data(); }
  [[nodiscard]] constexpr const T* begin() const { return data(); }
  [[nodiscard]] constexpr T* end() { return data() + count_; }
  [[nodiscard]] constexpr const T* end() const { return data() + count_; }
  [[nodiscard]] constexpr T& operator[](std::size_t leg) { return items_[leg]; }
  [[nodiscard]] constexpr const T& operator[](std::size_t leg) const { return items_[leg]; }

  [[nodiscard]] constexpr bool operator==(const PerLeg& other) const {
    return std::equal(begin(), end(), other.begin(), other.end());
  }

 private:
  constexpr void assign(std::initializer_list<T> values) {
    resize(static_cast<int>(values.size()));
    std::copy(values.begin(), values.end(), begin());
  }

  template <std::size_t... i>
  static constexpr std::array<T, kMaxLegs> copies(const T& value, std::index_sequence<i...>) {
    return {(static_cast<void>(i), value)...};
  }

  std::array<T, kMaxLegs> items_ = std::array<T, kMaxLegs>();
  int count_ = kNumLegs;
};

/// Joints of a limb in a JointVector.
struct JointRange {
  int first = 0, count = 0;
};

/// Joint-space vector of n_τ numbers, fixed when the robot is loaded: HAA, HFE and KFE of one leg
/// after the other, so that joint j of leg k stands at 3 k + j; then further joints of the legs,
/// then those of arms. Of two legs: all joints of one leg after the other, then those of arms.
/// Never allocates.
using JointVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMaxJoints, 1>;
/// The same of the joints that place the feet.
using LegJointVector =
    Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kJointsPerLeg * kMaxLegs, 1>;
/// Generalized velocity u = (v_WB in W, w_WB in B, q̇) or acceleration (Eq. 1), n_u = 6 + n_τ.
using GeneralizedVector =
    Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMaxVelocities, 1>;

[[nodiscard]] constexpr std::size_t index(Leg leg) { return static_cast<std::size_t>(leg); }
/// The names of a robot's legs, in files, messages and logs; a robot has two, four or six.
[[nodiscard]] constexpr std::span<const std::string_view> leg_names(int num_legs) {
  if (num_legs == kNumLegs) return kLegNames;
  if (num_legs == 2) return kBipedLegNames;
  return std::span(kHexapodLegNames).first(static_cast<std::size_t>(num_legs));
}
[[nodiscard]] constexpr std::string_view leg_name(Leg leg, int num_legs) {
  return leg_names(num_legs)[index(leg)];
}
/// Is it one of the foremost pair?
[[nodiscard]] constexpr bool is_front(Leg leg) { return static_cast<int>(leg) < 2; }
[[nodiscard]] constexpr bool is_hind(Leg leg, int num_legs) {
  return static_cast<int>(leg) >= num_legs - 2;
}
[[nodiscard]] constexpr bool is_left(Leg leg) { return static_cast<int>(leg) % 2 == 0; }
/// The leg on the same side, as far from the other end.
[[nodiscard]] constexpr Leg same_side(Leg leg, int num_legs = kNumLegs) {
  const int k = static_cast<int>(leg);
  return static_cast<Leg>(num_legs - 2 - k + 2 * (k % 2));
}
/// Of four legs "LF_HAA" for 0, "LF_HFE" for 1, …, "RH_KFE" for 11.
[[nodiscard]] inline std::string leg_joint_name(int joint, int num_legs = kNumLegs) {
  return std::string(leg_name(static_cast<Leg>(joint / kJointsPerLeg), num_legs)) + "_" +
         std::string(kJointNames[static_cast<std::size_t>(joint % kJointsPerLeg)]);
}
/// HAA of a walker's leg in a JointVector.
[[nodiscard]] constexpr int first_joint(Leg leg) { return kJointsPerLeg * static_cast<int>(leg); }

}  // namespace surefoot
