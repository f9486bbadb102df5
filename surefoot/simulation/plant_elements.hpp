#pragma once

#include "surefoot/signals/leg.hpp"

#include <string>
#include <vector>

namespace surefoot::simulation {

/// Names of the joints in the order of every JointVector, whatever the robot calls them: LF_HAA,
/// LF_HFE, LF_KFE, RF_HAA …
[[nodiscard]] std::vector<std::string> joint_elements(int num_legs = kNumLegs);
/// Of the links behind these joints: LF_HIP, LF_THIGH, LF_SHANK, RF_HIP …
[[nodiscard]] std::vector<std::string> link_elements(int num_legs = kNumLegs);
[[nodiscard]] std::vector<std::string> leg_elements(int num_legs = kNumLegs);  ///< LF, RF …
[[nodiscard]] const std::vector<std::string>& angle_elements();                ///< roll, pitch, yaw
[[nodiscard]] const std::vector<std::string>& axis_elements();                 ///< x, y, z

}  // namespace surefoot::simulation
