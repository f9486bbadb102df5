#pragma once

#include "surefoot/logging/log_header.hpp"
#include "surefoot/replay/log_replay.hpp"
#include "surefoot/replay/walk_end.hpp"
#include "surefoot/signals/leg.hpp"

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace surefoot {
struct TickRecord;
}  // namespace surefoot

namespace surefoot::control {
struct StackAnswer;
}  // namespace surefoot::control

namespace surefoot::replay {

/// How far the torques of a joint are apart, over the ticks that both answered.
struct JointComparison {
  double rms = 0.0;      ///< [N·m]
  double largest = 0.0;  ///< [N·m], other minus logged
  double time = 0.0;     ///< of the largest [s]
};

/// Residuals of a level, over the ticks that both answered and at which both hierarchies were
/// solved as far as it.
struct LevelComparison {
  std::string name, unit;
  bool in_log = false, in_other = false;
  double logged_rms = 0.0, logged_max = 0.0;  ///< in the level's unit
  double other_rms = 0.0, other_max = 0.0;
  double logged_time = 0.0, other_time = 0.0;  ///< of the largest [s]
};

/// Some of the ticks, which have something in common.
struct TickCount {
  long ticks = 0;
  double first = 0.0;  ///< time of the first of them [s]
  std::string why;     ///< of the first of them

  void add(double time, const std::string& reason = {}) {
    if (ticks++ > 0) return;
    first = time;
    why = reason;
  }
};

/// What another hierarchy would have commanded at each tick of a run, on the model and the plan
/// that the run had there: each tick is asked for itself, and none of its torques ever moves the
/// robot. A side answers a tick with torques of its hierarchy, be they optimal or degraded.
struct StackComparison {
  logging::LogHeader header;  ///< of the log, without its attachments
  std::string other;          ///< name of the other stack
  long ticks = 0;
  double first_time = 0.0, last_time = 0.0;  ///< [s]
  long compared = 0;                         ///< ticks that both answered
  std::array<JointComparison, kNumJoints> joints;
  std::vector<LevelComparison> levels;  ///< those of the log, then those of the other alone
  TickCount logged_not_optimal, other_not_optimal;  ///< also where there was no answer
  TickCount logged_unanswered;
  TickCount not_asked;  ///< nothing was planned in the run, so there was nothing to ask with
  TickCount other_unanswered;
  TickCount other_stopped;  ///< of these: there its controller would have stopped for safety
  std::optional<WalkEnd> walk_end;
  /// Where this build computes other torques for the run itself, so that the model with which the
  /// other hierarchy was asked may be another than the run's, too.
  TickCount not_reproduced;
  long logged_switches = 0;   ///< changes of levels, which the other hierarchy did not make
  std::string problem;        ///< why not all of the log could be read
  std::optional<LogGap> gap;  ///< behind which nothing was asked
};

/// A level of the other hierarchy, and the unit of its residual; empty: none.
struct OtherLevel {
  std::string name, unit;
};

/// Is told of each tick: what the log has, and what the other hierarchy answers; null where it was
/// not asked.
using StackObserver =
    std::function<void(const TickRecord& logged, const control::StackAnswer* other,
                       const std::vector<OtherLevel>& other_levels)>;

/// `stack` by name or file, as `--set stack=` has it. Throws Error as `LogReplay`, if there is no
/// such stack or none that fits the log's scenario, if the log holds no tick, and when it is
/// interrupted.
[[nodiscard]] StackComparison compare_stack(const std::string& path, const std::string& stack,
                                            const StackObserver& observer = {});

}  // namespace surefoot::replay
