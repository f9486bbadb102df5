#pragma once

#include "surefoot/control/controller.hpp"
#include "surefoot/logging/log_reader.hpp"
#include "surefoot/logging/message_fields.hpp"
#include "surefoot/logging/scratch_folder.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace surefoot::replay {

/// State that a replayed controller uses.
enum class ReplayedState {
  logged,     ///< the log's, at every tick
  estimated,  ///< from the library's estimator; the log's if the run had another
};

struct ReplayOptions {
  ReplayedState state = ReplayedState::logged;
  /// Called with messages on other channels, such as /truth; may be empty.
  logging::LogReader::Other observer{};
  /// The user's own tasks of the run: without them its controller can't be made again.
  tasks::OwnTasks own_tasks{};
  /// The user's own planner of the run, for its robot; empty: the plans are the log's.
  std::function<std::unique_ptr<gaits::MotionPlanner>(const model::RobotDescription&)>
      make_planner{};
};

/// Ticks that are lost within a log, or at its begin. A controller can't be computed again after
/// them, because its memory is unknown.
struct LogGap {
  std::optional<double> from;  ///< time of the last tick before [s]; empty: the first are lost
  double to = 0.0;             ///< time of the first tick after [s]
  long ticks_behind = 0;       ///< that can be read, but not computed
};

/// Whether two numbers have the same bits, NaN included.
[[nodiscard]] bool same_bits(double a, double b);

/// Runs a log's controller again on the logged readings, commands and states. It computes the same
/// bits from the first tick on.
class LogReplay {
 public:
  /// Throws FileError if the file is no log of surefoot or lacks the controller's attachments,
  /// Error if this program can't read these.
  explicit LogReplay(const std::string& path, const ReplayOptions& options = {});

  /// See `Controller::explain_levels`; on by default.
  void explain_levels(bool wanted) { controller_->explain_levels(wanted); }

  /// One tick; false after the last one, or the last before a gap. Throws FileError.
  [[nodiscard]] bool step();

  [[nodiscard]] const control::Controller& controller() const { return *controller_; }
  /// Of the run, with the stack at its start.
  [[nodiscard]] const control::ControllerOptions& options() const { return options_; }
  [[nodiscard]] const model::RobotDescription& robot() const { return robot_; }
  /// The last tick, as in the log.
  [[nodiscard]] const TickRecord& logged() const { return tick_; }
  [[nodiscard]] const logging::LogHeader& header() const { return log_.header(); }
  /// Whether the run's estimator is computed again, too.
  [[nodiscard]] bool estimates() const { return estimates_; }
  /// The user's own parts of the run that this program lacks: their states and plans are the log's.
  [[nodiscard]] const std::vector<std::string>& played_back() const { return played_back_; }
  /// After the last tick: why the log could not be read further; empty if it is whole.
  [[nodiscard]] std::string problem() const { return log_.problem(); }
  /// After the last tick: the gap that ended the replay.
  [[nodiscard]] const std::optional<LogGap>& gap() const { return gap_; }
  /// After the last tick: whether later ticks may be lost.
  [[nodiscard]] bool may_go_on() const { return log_.may_go_on(); }
  [[nodiscard]] const logging::ClockSkips& clock_skips() const { return log_.clock_skips(); }
  /// Whether the controller gave the torques of the log at this tick, bit for bit.
  [[nodiscard]] bool is_same() const;

 private:
  void switch_levels(const LevelSwitchReport& logged);
  void apply_changes();
  [[nodiscard]] control::StackOptions changed_stack(const logged::Change& change) const;
  void count_rest();

  logging::ScratchFolder folder_;  // of the robot's URDF
  std::string path_;
  std::vector<logged::Change> changes_;  // since the last tick
  logging::LogReader log_;
  TickRecord tick_;
  std::optional<double> last_time_;  // of the last computed tick [s]
  std::optional<LogGap> gap_;
  bool estimates_ = false;
  std::vector<std::string> played_back_;
  std::unique_ptr<control::Controller> controller_;
  control::ControllerOptions options_;
  model::RobotDescription robot_;
  tasks::OwnTasks own_tasks_;
};

}  // namespace surefoot::replay
