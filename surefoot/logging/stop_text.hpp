#pragma once

#include "surefoot/signals/tick_record.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace surefoot::logging {

/// Why the controller stopped for safety: "IMU stopped", "encoder LF_KFE changed too fast",
/// "encoders of several joints left the range", "the torso tilted too far"; empty: it has not. Of a
/// group of sensors its fault, and the only joint at fault, or −1; the IMU has none. Films
/// say the same (tests/support/stop_words.json).
[[nodiscard]] std::string text_of_stop(StopCause cause, SampleFault fault, int joint);
/// The same of a tick: what was wrong with a sensor when it was lost; in logs before 2.8, which
/// don't tell, what is wrong with it now.
[[nodiscard]] std::string text_of_stop(const TickRecord& tick);

/// "command mode: sit, as IMU stopped"; `why`: as of `text_of_stop`.
[[nodiscard]] std::string mode_text(CommandMode mode, std::string_view why);

/// All that `text_of_stop` may say; first the empty text.
[[nodiscard]] const std::vector<std::string>& stop_texts();

struct FaultText {
  std::string text;   ///< "encoders of several joints left the range"
  double age = kNaN;  ///< of the last good sample [s]
};

/// What is wrong with the sensors at a tick, in the same words; one for each group.
[[nodiscard]] std::vector<FaultText> faults_of(const SensorHealth& health);

}  // namespace surefoot::logging
