#pragma once

#include "surefoot/logging/log_header.hpp"
#include "surefoot/replay/log_replay.hpp"
#include "surefoot/replay/walk_end.hpp"
#include "surefoot/runtime/interrupt.hpp"
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

/// Difference of a joint's torques, over the ticks that both hierarchies answered.
struct JointComparison {
  double rms = 0.0;      ///< [N·m]
  double largest = 0.0;  ///< [N·m], other minus logged
  double time = 0.0;     ///< of the largest [s]
};

/// Residuals of a level, over the ticks that both hierarchies answered and solved up to it.
struct LevelComparison {
  std::string name, unit;
  bool in_log = false, in_other = false;
  double logged_rms = 0.0, logged_max = 0.0;  ///< in the level's unit
  double other_rms = 0.0, other_max = 0.0;
  double logged_time = 0.0, other_time = 0.0;  ///< of the largest [s]
};

/// Count of ticks with a property.
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

/// What another hierarchy would have commanded at each tick of a run, with the run's model and
/// plan. Each tick stands alone: the other's torques never move the robot. A hierarchy answers a
/// tick if it gives torques, optimal or degraded.
struct StackComparison {
  logging::LogHeader header;  ///< of the log, without its attachments
  std::string other;          ///< name of the other stack
  long ticks = 0;
  double first_time = 0.0, last_time = 0.0;  ///< [s]
  long compared = 0;                         ///< ticks that both answered
  std::vector<JointComparison> joints;
  std::vector<LevelComparison> levels;  ///< the log's, then those that only the other has
  TickCount logged_not_optimal, other_not_optimal;  ///< unanswered ticks included
  TickCount logged_unanswered;
  TickCount not_asked;  ///< the run planned nothing there
  TickCount other_unanswered;
  TickCount other_stopped;  ///< of these: its controller would have stopped for safety
  std::optional<WalkEnd> walk_end;
  /// This build computes other torques for the run itself, so the other hierarchy's model may also
  /// differ from the run's.
  TickCount not_reproduced;
  long logged_switches = 0;   ///< switches of levels, which the other hierarchy did not make
  std::string problem;        ///< why not all of the log could be read
  std::optional<LogGap> gap;  ///< nothing was asked after it
};

/// A level of the other hierarchy, and its residual's unit (may be empty).
struct OtherLevel {
  std::string name, unit;
};

/// Called at each tick with the logged tick and the other hierarchy's answer; null if it was not
/// asked.
using StackObserver =
    std::function<void(const TickRecord& logged, const control::StackAnswer* other,
                       const std::vector<OtherLevel>& other_levels)>;

/// `stack`: name or file, as in `--set stack=`. Throws Error as `LogReplay`, if the stack does not
/// exist or does not fit the log's scenario, if the log has no tick, and where `stops` ends it, as
/// in `verify_log`. Both stacks can name tasks of the user's `own`.
[[nodiscard]] StackComparison compare_stack(
    const std::string& path, const std::string& stack, const StackObserver& observer = {},
    const tasks::OwnTasks& own = {}, const std::function<bool()>& stops = runtime::interrupted);

/// Makes a stack for a log's run, as for its robot.
using MakeStack = std::function<control::StackOptions(const LogReplay& run)>;

/// The same with a stack that has its own tasks; `own` are the run's.
[[nodiscard]] StackComparison compare_stack(
    const std::string& path, const MakeStack& make_stack, const StackObserver& observer = {},
    const tasks::OwnTasks& own = {}, const std::function<bool()>& stops = runtime::interrupted);

}  // namespace surefoot::replay
