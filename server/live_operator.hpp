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

/// Ticks that wait at most, to be made while it is paused: ten seconds.
inline constexpr int kMostStepsWaiting = 4000;

/// What the operator wants of the controller.
struct WantedControl {
  control::StackOptions stack;  ///< with all defaults
  double friction = 0.5;
};

/// What the operator wants of a run.
struct OperatorWishes {
  bool paused = false;
  bool halt = false;  ///< ticks that are still to be made are not wanted any more
  int steps = 0;      ///< ticks to make although it is paused
  double speed = 1.0;
  bool reset = false;
  std::vector<simulation::Push> pushes;
  std::optional<UserCommand> walk;  ///< none: as the scenario says
  WantedControl control;
};

/// Takes the operator's commands, on the server's thread, and says what is wrong with them; the run
/// asks at each tick what is wanted, and never waits for that.
class LiveOperator {
 public:
  LiveOperator(const config::Scenario& scenario, ViewLimits limits);

  /// Takes a command. What is wrong with it; empty: nothing.
  [[nodiscard]] std::string command(const ViewCommand& command);

  /// On the run's thread: what is wanted, if that is something else than at the last call and can
  /// be had without waiting. What is to be done once is handed over.
  [[nodiscard]] bool take(OperatorWishes& wishes);

  /// On the run's thread: what was wanted can't be; the present control is wanted again, as soon as
  /// `take` gets through.
  void give_up(const WantedControl& present);

  // These two, at a run's begin and end, may wait for a command that is being taken: no tick is
  // due.

  /// On the run's thread: it begins, again, with these bodies that can be pushed. Everything is as
  /// the scenario says; pause and speed stay.
  void begin(std::vector<std::string> bodies);
  /// On the run's thread: the run has ended, and why.
  void set_ended(std::string reason);

  /// What the operator asks to walk; none: as the scenario says.
  [[nodiscard]] std::optional<UserCommand> walk_wanted();
  [[nodiscard]] const ViewLimits& limits() const { return limits_; }
  [[nodiscard]] const control::StackReach& reach() const { return reach_; }

 private:
  void step(int ticks);
  void push(const ViewCommand& command);
  void walk(const ViewCommand& command);
  void gain(const ViewCommand& command);
  void order(const ViewCommand& command);
  void friction(const ViewCommand& command);
  void check_body(const std::string& body) const;

  const WantedControl scenario_control_;
  const ViewLimits limits_;
  const control::StackReach reach_;
  std::uint64_t taken_ = 0;                // of the run's thread
  std::optional<WantedControl> given_up_;  // of the run's thread: what is to be wanted again
  std::mutex mutex_;                       // of all below
  std::vector<std::string> bodies_;
  OperatorWishes wishes_;
  std::string ended_;
  std::atomic<std::uint64_t> changes_{0};
};

}  // namespace surefoot::server
