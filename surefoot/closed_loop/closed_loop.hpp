#pragma once

#include "surefoot/closed_loop/run_steering.hpp"
#include "surefoot/closed_loop/trouble_counter.hpp"
#include "surefoot/config/scenario.hpp"
#include "surefoot/estimation/state_estimator.hpp"
#include "surefoot/evaluation/criteria.hpp"
#include "surefoot/evaluation/event_counter.hpp"
#include "surefoot/evaluation/metrics.hpp"
#include "surefoot/gaits/motion_planner.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace surefoot::closed_loop {

/// Why a run ended.
enum class Ending {
  finished,  ///< it ran to its end
  goal_reached,
  fell,
  safety,       ///< the controller stopped, and did not come back
  interrupted,  ///< from outside
  reset,        ///< from outside, to restart
};

struct ClosedLoopOptions {
  std::string record_path{};  ///< log to write; empty: none. A cut-off run leaves its partial_path
  std::function<void(double time)> progress{};  ///< called about every 0.1 s of simulated time
  std::function<bool()> interrupted{};          ///< asked at every tick
  RunSteering* steering = nullptr;              ///< called between the ticks
  std::function<void()> ready{};                ///< called after set-up, before the first tick
  /// Make parts of your own; empty: the library's. Tasks of your own come with the scenario's
  /// stack.
  std::function<std::unique_ptr<estimation::StateEstimator>()> make_estimator{};
  std::function<std::unique_ptr<gaits::MotionPlanner>()> make_planner{};
};

struct RunResult {
  Ending ending = Ending::finished;
  bool safety_stop =
      false;  ///< the controller damped all joints, and the robot had not fallen before
  evaluation::Metrics metrics;
  std::vector<evaluation::CriterionResult> criteria;
  std::vector<evaluation::EventCount> events;  ///< notable ones of the walk
  std::vector<TroubleCount> troubles;          ///< with sensors and torques
  std::vector<config::RandomDraw> drawn;
  std::vector<std::string> notes;  ///< run_notes(), and own parts that take too long
  std::string fault;               ///< what a part of your own did wrong last; also a note
  std::uint64_t torques_hash = 0;  ///< of all commanded torques, as TorqueHash makes it
  std::optional<int> changes;      ///< from outside, as in its log; empty without steering
};

/// Runs a scenario in closed loop, judged on the truth and logged, until its duration is over, its
/// goal is reached, the robot fell, or the controller stopped. Throws Error on options that make no
/// sense, and if the log can't be written.
[[nodiscard]] RunResult run_closed_loop(const config::Scenario& scenario,
                                        const ClosedLoopOptions& options);

/// Makes plant and controller of the scenario, and returns the run's notes. Throws Error as a run
/// would at its start.
std::vector<std::string> check_setup(const config::Scenario& scenario);

/// Mean wall time of the run's first ticks on this machine [s]. Throws Error as `check_setup` does.
[[nodiscard]] double measure_tick(const config::Scenario& scenario);

}  // namespace surefoot::closed_loop
