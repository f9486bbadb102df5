#pragma once

#include "surefoot/signals/tick_record.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace surefoot::logging {

/// Why the controller stopped for safety: "IMU stopped", "encoder LF_KFE changed too fast",
/// "encoders of several joints left the range", "the torso tilted too far"; empty if it has not.
/// `fault`: of a group of sensors; `joint`: the only one at fault, or −1; `joints`: names of all
/// joints of the robot. Films use the same texts (tests/support/stop_words.json).
[[nodiscard]] std::string text_of_stop(StopCause cause, SampleFault fault, int joint,
                                       const std::vector<std::string>& joints);
/// The same for a tick, with the fault when the sensor was lost; in logs before 2.8, which lack it,
/// with its present fault.
[[nodiscard]] std::string text_of_stop(const TickRecord& tick,
                                       const std::vector<std::string>& joints);

/// "command mode: sit, as IMU stopped"; `why`: from `text_of_stop`.
[[nodiscard]] std::string mode_text(CommandMode mode, std::string_view why);

/// All possible values of `text_of_stop`; first the empty text.
[[nodiscard]] std::vector<std::string> stop_texts(const std::vector<std::string>& joints);

struct FaultText {
  std::string text;   ///< "encoders of several joints left the range"
  double age = kNaN;  ///< of the last good sample [s]
};

/// Present faults of the sensors in the same words, at most one for each group.
[[nodiscard]] std::vector<FaultText> faults_of(const SensorHealth& health,
                                               const std::vector<std::string>& joints);

}  // namespace surefoot::logging
