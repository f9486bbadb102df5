#pragma once

#include <string>
#include <vector>

namespace surefoot {

/// Names of the joints in the order of every JointVector, whatever the robot calls them: LF_HAA,
/// LF_HFE, LF_KFE, RF_HAA …
[[nodiscard]] const std::vector<std::string>& joint_elements();
/// Of the links behind these joints: LF_HIP, LF_THIGH, LF_SHANK, RF_HIP …
[[nodiscard]] const std::vector<std::string>& link_elements();
/// Of the legs.
[[nodiscard]] const std::vector<std::string>& leg_elements();
[[nodiscard]] const std::vector<std::string>& angle_elements();  ///< roll, pitch, yaw

/// Names of the numbers that a key of the plant takes, in their order; none for a key that takes
/// one number. `path` is that of the whole key: "sensors.encoders.offset".
[[nodiscard]] std::vector<std::string> elements_of(const std::string& path);

/// Whether a key takes whole numbers: delays in ticks, seeds, counts.
[[nodiscard]] bool is_whole_number(const std::string& path);

}  // namespace surefoot
