#pragma once

#include "server/view_command.hpp"
#include "server/view_session.hpp"
#include "surefoot/config/scenario.hpp"
#include "surefoot/control/stack_reach.hpp"
#include "surefoot/signals/user_command.hpp"
#include "surefoot/simulation/plant_options.hpp"

#include <atomic>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace surefoot::server {

/// Most single steps that wait while the run is paused: ten seconds.
inline constexpr int kMostStepsWaiting = 4000;

/// The control that the operator wants.
struct WantedControl {
  control::StackOptions stack;  ///< with all defaults
  double friction = 0.5;
};

/// What the operator wants.
struct OperatorWishes {
  bool paused = false;
  bool halt = false;  ///< cancels steps that still wait
  int steps = 0;      ///< ticks to run although paused
  double speed = 1.0;
  bool reset = false;
  std::vector<simulation::Push> pushes;
  std::optional<UserCommand> walk;  ///< none: the scenario commands
  WantedControl control;
};

/// Checks and keeps the operator's commands, on the server's thread. The run takes them at each
/// tick and never waits for that.
class LiveOperator {
 public:
  LiveOperator(const config::Scenario& scenario, ViewLimits limits);

  /// Takes a command. Returns what is wrong with it; empty: nothing.
  [[nodiscard]] std::string command(const ViewCommand& command);

  /// On the run's thread: gets the wishes if they have changed and no lock is held. Wishes for one
  /// action are cleared.
  [[nodiscard]] bool take(OperatorWishes& wishes);

  /// On the run's thread: the wanted control is not possible; `take` sets the wish back to the
  /// present one.
  void give_up(const WantedControl& present);

  // These two may wait for a command that is being taken: no tick is due at a run's begin and end.

  /// On the run's thread: a run begins, with these bodies that can be pushed. All wishes are as in
  /// the scenario; pause and speed stay.
  void begin(std::vector<std::string> bodies);
  /// On the run's thread: the run has ended for this reason.
  void set_ended(std::string reason);

  /// The operator's command of the walk; none: the scenario commands.
  [[nodiscard]] std::optional<UserCommand> walk_wanted();
  [[nodiscard]] const ViewLimits& limits() const { return limits_; }
  [[nodiscard]] const control::StackReach& reach() const { return reach_; }
  /// Names of the gaits that a command may ask for; `auto` the last one, if there is a choice.
  [[nodiscard]] const std::vector<std::string>& gaits() const { return gaits_; }
  /// Name of a command's gait; "" where the scenario has no list of gaits.
  [[nodiscard]] std::string gait_name(int gait) const;

 private:
  void step(int ticks);
  void push(const ViewCommand& command);
  void walk(const ViewCommand& command);
  void gain(const ViewCommand& command);
  void order(const ViewCommand& command);
  void friction(const ViewCommand& command);
  [[nodiscard]] int gait(const std::string& name) const;
  void check_body(const std::string& body) const;

  const WantedControl scenario_control_;
  const ViewLimits limits_;
  const control::StackReach reach_;
  std::vector<std::string> gaits_;
  const int first_gait_;
  std::uint64_t taken_ = 0;                // run's thread
  std::optional<WantedControl> given_up_;  // run's thread: the wish to return to
  std::mutex mutex_;                       // guards all below
  std::vector<std::string> bodies_;
  OperatorWishes wishes_;
  std::string ended_;
  std::atomic<std::uint64_t> changes_{0};
};

}  // namespace surefoot::server
