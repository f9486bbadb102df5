#pragma once

#include "surefoot/doctor/diagnosis.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace surefoot::doctor {

/// Which limits of a joint have to be filled in.
struct LimitGaps {
  bool effort = false, velocity = false, position = false;  ///< a placeholder, or missing
  bool turns = false;  ///< it has no stops, so that any are true of it
};

/// Of an effort or a velocity: not given, or not above 0.
[[nodiscard]] bool is_missing(double limit);
/// Is one of its position limits not given?
[[nodiscard]] bool has_no_stops(const model::UrdfJoint& joint);
/// Of all joints, in the nominal posture; NaN: not known [N·m].
[[nodiscard]] double most_standing_torque(const Diagnosis& robot);

/// Without the standing torque an effort counts as a placeholder from 1000 N·m on.
[[nodiscard]] LimitGaps gaps_of(const Diagnosis& robot, const model::UrdfJoint& joint);
/// Does any joint of the legs lack a limit? Of two legs with flat feet: false.
[[nodiscard]] bool has_gaps(const Diagnosis& robot);

/// What stands in for one limit: ANYmal B's, to size.
struct LimitGuess {
  const char* key;
  bool LimitGaps::* gap;
  double model::UrdfJoint::* given;           ///< by the description
  std::array<double, kJointsPerLeg> numbers;  ///< of HAA, HFE and KFE
  double of_arm;
  const char* unit;
};

inline constexpr std::size_t kTorque = 0, kVelocity = 1, kPositionMin = 2, kPositionMax = 3;

/// In this order.
[[nodiscard]] std::vector<LimitGuess> limit_guesses(const Diagnosis& robot);

}  // namespace surefoot::doctor
