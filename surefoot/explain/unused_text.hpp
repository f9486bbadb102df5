#pragma once

#include "surefoot/signals/tick_record.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace surefoot::explain {

/// Why a tick's solution and plan are not used; both texts are empty if they are.
struct UnusedText {
  std::string what;  ///< "No hierarchy was solved"
  std::string why;   ///< "IMU stopped", "it stands up"
};

/// `joints`: names of all joints of the robot.
[[nodiscard]] UnusedText unused_text(const TickRecord& tick,
                                     const std::vector<std::string>& joints);

/// All possible values of `what` and `why`; first the empty text.
[[nodiscard]] const std::vector<std::string>& unused_texts();
[[nodiscard]] std::vector<std::string> unused_reasons(const std::vector<std::string>& joints);

}  // namespace surefoot::explain
