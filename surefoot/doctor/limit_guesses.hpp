#pragma once

#include "surefoot/doctor/diagnosis.hpp"

#include <array>
#include <vector>

namespace surefoot::doctor {

/// Which limits of a joint have to be filled in.
struct LimitGaps {
  bool effort = false, velocity = false, position = false;  ///< a placeholder, or missing
  bool turns = false;  ///< it has no stops, so that any are true of it
};

/// Without the standing torque an effort counts as a placeholder from 1000 N·m on.
[[nodiscard]] LimitGaps gaps_of(const Diagnosis& robot, const model::UrdfJoint& joint);
/// Does any joint of the legs lack a limit? Of two legs with flat feet: false.
[[nodiscard]] bool has_gaps(const Diagnosis& robot);

/// What stands in for one limit: ANYmal B's, to size.
struct LimitGuess {
  const char* key;
  bool LimitGaps::* gap;
  std::array<double, kJointsPerLeg> numbers;  ///< of HAA, HFE and KFE
  double of_arm;
  const char* unit;
};

/// Torque, velocity, lowest and highest position.
[[nodiscard]] std::vector<LimitGuess> limit_guesses(const Diagnosis& robot);

}  // namespace surefoot::doctor
