#pragma once

#include "surefoot/signals/tick_record.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace surefoot::logging {

/// Why the controller stopped for safety: "IMU stopped", "encoder LF_KFE changed too fast",
/// "encoders of several joints left the range", "the torso tilted too far"; empty if it has not.
/// `fault`: of a group of sensors; `joint`: the only one at fault, or −1. Films use the same texts
/// (tests/support/stop_words.json).
[[nodiscard]] std::string text_of_stop(StopCause cause, SampleFault fault, int joint,
                                       int num_legs = kNumLegs);
/// The same for a tick, with the fault when the sensor was lost; in logs before 2.8, which lack it,
/// with its present fault.
[[nodiscard]] std::string text_of_stop(const TickRecord& tick);

/// "command mode: sit, as IMU stopped"; `why`: from `text_of_stop`.
[[nodiscard]] std::string mode_text(CommandMode mode, std::string_view why);

/// All possible values of `text_of_stop` of any robot; first the empty text.
[[nodiscard]] const std::vector<std::string>& stop_texts();

struct FaultText {
  std::string text;   ///< "encoders of several joints left the range"
  double age = kNaN;  ///< of the last good sample [s]
};

/// Present faults of a tick's sensors in the same words, at most one for each group.
[[nodiscard]] std::vector<FaultText> faults_of(const TickRecord& tick);

}  // namespace surefoot::logging
