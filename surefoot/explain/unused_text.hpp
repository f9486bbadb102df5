#pragma once

#include "surefoot/signals/tick_record.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace surefoot::explain {

/// Why what a tick solved and planned commands nothing; texts are empty where it does.
struct UnusedText {
  std::string what;  ///< "No hierarchy was solved"
  std::string why;   ///< "IMU stopped", "it stands up"
};

[[nodiscard]] UnusedText unused_text(const TickRecord& tick);

/// All that `what` and `why` may be; first the empty text.
[[nodiscard]] const std::vector<std::string>& unused_texts();
[[nodiscard]] const std::vector<std::string>& unused_reasons();

}  // namespace surefoot::explain
