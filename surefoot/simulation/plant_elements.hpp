#pragma once

#include <string>
#include <vector>

namespace surefoot::simulation {

/// Names of the joints in the order of every JointVector, whatever the robot calls them: LF_HAA,
/// LF_HFE, LF_KFE, RF_HAA …
[[nodiscard]] const std::vector<std::string>& joint_elements();
/// Of the links behind these joints: LF_HIP, LF_THIGH, LF_SHANK, RF_HIP …
[[nodiscard]] const std::vector<std::string>& link_elements();
[[nodiscard]] const std::vector<std::string>& leg_elements();    ///< LF, RF, LH, RH
[[nodiscard]] const std::vector<std::string>& angle_elements();  ///< roll, pitch, yaw
[[nodiscard]] const std::vector<std::string>& axis_elements();   ///< x, y, z

}  // namespace surefoot::simulation
