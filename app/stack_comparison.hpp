#pragma once

#include "app/log_replay.hpp"
#include "surefoot/logging/log_header.hpp"
#include "surefoot/signals/leg.hpp"

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace surefoot {

struct TickRecord;

/// How far the torques of a joint are apart.
struct JointComparison {
  double rms = 0.0;      ///< [N·m]
  double largest = 0.0;  ///< [N·m], other minus logged
  double time = 0.0;     ///< of the largest [s]
};

/// Residuals of a level, over the ticks at which both hierarchies were solved as far as it.
struct LevelComparison {
  std::string name, unit;
  bool in_log = false, in_other = false;
  double logged_rms = 0.0, logged_max = 0.0;  ///< in the level's unit
  double other_rms = 0.0, other_max = 0.0;
  double logged_time = 0.0, other_time = 0.0;  ///< of the largest [s]
};

/// From when on a run says nothing of its walk.
struct WalkEnd {
  double time = 0.0;  ///< [s]
  std::string why;    ///< "its torso came to the ground", "its controller stopped for safety: …"
};

/// What another hierarchy would have commanded at each tick of a run, on the same states: each tick
/// is asked for itself, and none of its torques ever moves the robot.
struct StackComparison {
  LogHeader header;   ///< of the log, without its attachments
  std::string other;  ///< name of the other stack
  long ticks = 0;
  double first_time = 0.0, last_time = 0.0;  ///< [s]
  std::array<JointComparison, kNumJoints> joints;
  std::vector<LevelComparison> levels;  ///< those of the log, then those of the other alone
  long logged_not_optimal = 0, other_not_optimal = 0;  ///< ticks
  double other_first_not_optimal = 0.0;                ///< [s]
  bool other_stopped = false;  ///< for good: from then on its torques say nothing of the hierarchy
  double other_stopped_at = 0.0;  ///< [s]
  std::optional<WalkEnd> walk_end;
  bool same_plan = true;      ///< both followed the same plan at every tick
  long logged_switches = 0;   ///< of levels at run time, which the other hierarchy did not make
  std::string problem;        ///< why not all of the log could be read
  std::optional<LogGap> gap;  ///< behind which nothing was asked
};

/// A level of the other hierarchy, and the unit of its residual; empty: none.
struct OtherLevel {
  std::string name, unit;
};

/// Is told of each tick: what the log has, and what the other hierarchy commanded.
using StackObserver = std::function<void(const TickRecord& logged, const TickRecord& other,
                                         const std::vector<OtherLevel>& other_levels)>;

/// `stack` by name or file, as `--set stack=` has it. Throws Error as `LogReplay`, if the log holds
/// no tick, and when it is interrupted.
[[nodiscard]] StackComparison compare_stack(const std::string& path, const std::string& stack,
                                            const StackObserver& observer = {});

}  // namespace surefoot
