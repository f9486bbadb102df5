#pragma once

#include "surefoot/logging/log_header.hpp"
#include "surefoot/replay/log_replay.hpp"
#include "surefoot/runtime/interrupt.hpp"

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace surefoot::replay {

/// A joint torque that differs between replay and log.
struct TorqueDifference {
  long tick = 0;        ///< counted from 0
  double time = 0.0;    ///< [s]
  int joint = 0;        ///< as in a JointVector
  double logged = 0.0;  ///< [N·m]
  double computed = 0.0;
};

/// Messages that differ between replay and log.
struct MessageDifferences {
  std::string_view topic;
  long ticks = 0;      ///< number of them
  double first = 0.0;  ///< time of the first [s]
};

/// Result of running a log's controller again.
struct Verification {
  logging::LogHeader header;  ///< of the log, without its attachments
  bool estimated = false;  ///< the run's estimator ran again on the readings; else the logged state
  std::vector<std::string> played_back;      ///< see LogReplay::played_back
  long ticks = 0;                            ///< compared
  double first_time = 0.0, last_time = 0.0;  ///< [s]
  long different_ticks = 0;                  ///< with another torque or mode
  std::optional<TorqueDifference> first, largest;
  /// In the order of the tick. NaN is equal to NaN. Members that an older log lacks are not
  /// compared.
  std::array<MessageDifferences, 4> messages{
      {{"/state", 0, 0.0}, {"/plan", 0, 0.0}, {"/model", 0, 0.0}, {"/command", 0, 0.0}}};
  std::string fault;          ///< what a part of the user's own did wrong last, as it ran again
  std::string problem;        ///< why not all of the log could be read; empty if it is whole
  std::optional<LogGap> gap;  ///< nothing could be compared after it
  bool may_go_on = false;     ///< later ticks may be lost
  logging::ClockSkips clock;

  /// Of the compared ticks.
  [[nodiscard]] bool is_same() const { return different_ticks == 0; }
  [[nodiscard]] bool is_all() const { return !gap && !may_go_on; }
  [[nodiscard]] bool is_whole() const { return problem.empty(); }
};

/// Runs the controller of a log again on the logged readings, with the run's own estimator, and
/// compares every torque bit for bit, up to the first tick that is lost. `stops` is called at each
/// tick; true ends it. Throws Error as `LogReplay`, if the log holds no tick, and where it is
/// ended.
[[nodiscard]] Verification verify_log(
    const std::string& path, const ReplayOptions& options = {.state = ReplayedState::estimated},
    const std::function<bool()>& stops = runtime::interrupted);

}  // namespace surefoot::replay
