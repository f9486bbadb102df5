#include "surefoot/closed_loop/closed_loop.hpp"

#include "surefoot/base/build_info.hpp"
#include "surefoot/closed_loop/change_log.hpp"
#include "surefoot/closed_loop/goal_watch.hpp"
#include "surefoot/closed_loop/own_part_times.hpp"
#include "surefoot/closed_loop/run_log.hpp"
#include "surefoot/closed_loop/stop_watch.hpp"
#include "surefoot/evaluation/evaluator.hpp"
#include "surefoot/evaluation/torque_hash.hpp"
#include "surefoot/evaluation/truth_log.hpp"
#include "surefoot/runtime/stage_timer.hpp"
#include "surefoot/runtime/steady_clock.hpp"
#include "surefoot/simulation/make_estimator.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <optional>

namespace surefoot::closed_loop {
namespace {

constexpr double kProgressInterval = 0.1;  // of simulated time [s]
constexpr double kTimeAfterStop = 1.0;     // of the run, after a safety stop [s]

std::string reason(Ending ending) {
  switch (ending) {
    case Ending::finished:
      return "ran to its end";
    case Ending::goal_reached:
      return "goal reached";
    case Ending::fell:
      return "fell";
    case Ending::safety:
      return "the controller stopped for safety";
    case Ending::interrupted:
      return "interrupted";
    case Ending::reset:
      return "begun again";
  }
  return "";
}

bool is_shown(const ClosedLoopOptions& options) {
  return !options.record_path.empty() || options.steering != nullptr;
}

/// Recorded and watched runs measure the time of each level.
control::ControllerOptions controller_options(const config::Scenario& scenario,
                                              const ClosedLoopOptions& options) {
  control::ControllerOptions result = scenario.controller;
  if (is_shown(options)) result.solver.clock = runtime::steady_seconds;
  return result;
}

/// Everything of one run, wired together.
class ClosedLoop {
 public:
  ClosedLoop(const config::Scenario& scenario, const ClosedLoopOptions& options)
      : scenario_(scenario),
        options_(options),
        model_(scenario.robot),
        plant_(scenario.robot, scenario.plant),
        controller_(scenario.robot, controller_options(scenario, options), estimator(),
                    options.make_planner ? options.make_planner() : nullptr),
        goal_(scenario.goal),
        evaluator_(evaluator_options()) {
    controller_.set_stage_observer(&timer_);
    controller_.explain_levels(is_shown(options));
    if (!options.record_path.empty()) {
      recorder_.emplace(options.record_path, log_header(scenario, controller_, &plant_, model_));
      truth_log_.emplace(*recorder_);
    }
    if (options.steering != nullptr) begin_steering(*options.steering);
    if (options.ready) options.ready();
  }

  [[nodiscard]] std::vector<std::string> notes() const {
    return run_notes(scenario_, controller_, &plant_);
  }

  RunResult run() {
    const auto start = std::chrono::steady_clock::now();
    const auto ticks =
        static_cast<long>(std::ceil(scenario_.duration / scenario_.controller.period));
    std::optional<Ending> ending;
    for (long tick = 0; tick < ticks && !ending; ++tick) ending = step();
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
    return finish(ending.value_or(Ending::finished), wall.count());
  }

  double measure_tick() {
    constexpr int kMaxTicks = 100;
    constexpr double kMaxTime = 0.3;  // [s]
    const auto start = std::chrono::steady_clock::now();
    std::chrono::duration<double> passed{};
    int ticks = 0;
    for (bool ends = false; !ends && ticks < kMaxTicks && passed.count() < kMaxTime; ++ticks) {
      ends = step().has_value();
      passed = std::chrono::steady_clock::now() - start;
    }
    return passed.count() / ticks;
  }

 private:
  std::unique_ptr<estimation::StateEstimator> estimator() const {
    if (options_.make_estimator) return options_.make_estimator();
    return simulation::make_estimator(
        scenario_.estimation,
        {scenario_.robot, scenario_.controller.period, plant_, scenario_.estimator});
  }

  evaluation::EvaluatorOptions evaluator_options() const {
    evaluation::EvaluatorOptions options{
        .control_period = scenario_.controller.period,
        .mass = model_.mass(),
        .scale = scenario_.robot.scale,
        .terrain_height = [this](double x, double y) { return plant_.terrain_height(x, y); },
        .hip_in_base = [this](Leg leg, const Vec3& q) { return model_.hip_in_base(leg, q); }};
    if (!scenario_.robot.can_walk()) options.hip_in_base = nullptr;
    return options;
  }

  void begin_steering(RunSteering& steering) {
    if (recorder_) change_log_.emplace(*recorder_);
    steering.begin({.plant = plant_,
                    .controller = controller_,
                    .header = log_header(scenario_, controller_, &plant_, model_),
                    .log_change = [this](const logged::Change& change) {
                      ++changes_;
                      if (change_log_) change_log_->record(change, controller_);
                    }});
  }

  /// One tick; the ending if it is the last one.
  std::optional<Ending> step() {
    if (const std::optional<Ending> cut = steer()) return cut;
    const SensorReading& reading = plant_.read();
    const JointCommand& command = controller_.step(reading, user(reading.time));
    torques_.add(command.torque);
    judge();
    const std::optional<Ending> ending = check_end(command);
    report_progress();
    plant_.write(command);
    return ending;
  }

  std::optional<Ending> steer() {
    if (options_.steering == nullptr) return std::nullopt;
    switch (options_.steering->before_tick(plant_.time())) {
      case RunOrder::tick:
        return std::nullopt;
      case RunOrder::reset:
        return Ending::reset;
      case RunOrder::stop:
        return Ending::interrupted;
    }
    return std::nullopt;
  }

  UserCommand user(double time) const {
    const UserCommand& planned = scenario_.user(time);
    return options_.steering == nullptr ? planned : options_.steering->user(planned);
  }

  /// Readings, truth and record belong to the same time until the plant moves on.
  void judge() {
    TickTiming timing = timer_.timing();
    timing.time = plant_.time();
    timing.levels = runtime::in_microseconds(controller_.level_times());
    evaluator_.add(plant_.truth(), controller_.record());
    const TickRecord& record = controller_.record();
    events_.add(timing.time, record.plan.events);
    troubles_.add(timing.time, record, plant_.truth());
    evaluator_.add(timing);
    own_part_times_.add(timing);
    if (options_.steering != nullptr) {
      options_.steering->after_tick(controller_.record(), plant_.truth(), timing);
    }
    if (!recorder_) return;
    recorder_->record(controller_.record());
    recorder_->record(timing);
    truth_log_->record(plant_.truth(), controller_.record());
  }

  std::optional<Ending> check_end(const JointCommand& command) {
    const double time = plant_.time();
    if (options_.interrupted && options_.interrupted()) return Ending::interrupted;
    // If fall and stop are at the same tick, the fall counts: the controller was too late.
    if (evaluator_.fell()) return Ending::fell;
    stop_.update(controller_, time);
    if (command.mode == CommandMode::damping && std::isnan(damped_at_)) damped_at_ = time;
    if (time - damped_at_ > kTimeAfterStop) return Ending::safety;
    if (goal_.update(plant_.truth())) return Ending::goal_reached;
    return std::nullopt;
  }

  void report_progress() {
    if (!options_.progress || plant_.time() < next_progress_) return;
    next_progress_ += kProgressInterval;
    options_.progress(plant_.time());
  }

  RunResult finish(Ending ending, double wall_seconds) {
    RunResult result;
    result.ending = ending;
    result.safety_stop = stop_.has_stopped();
    result.metrics = evaluator_.metrics({.reason = reason(ending),
                                         .wall_seconds = wall_seconds,
                                         .seed = scenario_.seed,
                                         .version = std::string(build_info().version),
                                         .goal_reached = goal_.reached()});
    const bool is_cut = ending == Ending::interrupted || ending == Ending::reset;
    result.fault = controller_.fault();
    if (result.safety_stop && !is_cut) {
      result.metrics.reason = stop_.reason(evaluator_.fall());
    } else if (!is_cut) {
      result.metrics.reason = with_fault(result.metrics.reason, result.fault);
    }
    const bool is_short =
        ending == Ending::finished && result.metrics.duration_s < scenario_.judged_after - 1e-9;
    result.criteria = evaluation::evaluate(
        scenario_.criteria, result.metrics,
        is_cut || is_short ? evaluation::Extent::part : evaluation::Extent::whole);
    result.metrics.succeeded = evaluation::all_passed(result.criteria);
    if (is_cut && result.metrics.succeeded.value_or(false)) result.metrics.succeeded.reset();
    if (result.safety_stop || !result.fault.empty()) result.metrics.succeeded = false;
    result.events = events_.counts();
    result.troubles = troubles_.counts();
    result.torques_hash = torques_.value();
    result.drawn = scenario_.drawn;
    result.notes = notes();
    std::ranges::copy(own_part_times_.notes(), std::back_inserter(result.notes));
    if (!result.fault.empty()) result.notes.push_back(result.fault);
    if (options_.steering != nullptr) result.changes = changes_;
    if (recorder_) close_log(result);
    return result;
  }

  void close_log(const RunResult& result) {
    const std::string summary = evaluation::summary_json(result.metrics, result.criteria);
    if (result.ending == Ending::interrupted || result.ending == Ending::reset) {
      recorder_->close_partial(summary);
    } else {
      recorder_->close(summary);
    }
  }

  const config::Scenario& scenario_;
  const ClosedLoopOptions options_;
  model::RobotModel model_;
  simulation::Plant plant_;
  control::Controller controller_;
  GoalWatch goal_;
  evaluation::Evaluator evaluator_;
  evaluation::EventCounter events_;
  TroubleCounter troubles_{scenario_.robot};
  evaluation::TorqueHash torques_;
  runtime::StageTimer timer_;
  OwnPartTimes own_part_times_{controller_.own_parts(), scenario_.controller.period};
  std::optional<logging::Recorder> recorder_;
  std::optional<evaluation::TruthLog> truth_log_;
  std::optional<ChangeLog> change_log_;
  StopWatch stop_{scenario_.robot};
  double damped_at_ = kNaN;     // time of the first tick in mode damping [s]
  int changes_ = 0;             // from outside
  double next_progress_ = 0.0;  // [s]
};

}  // namespace

RunResult run_closed_loop(const config::Scenario& scenario, const ClosedLoopOptions& options) {
  return ClosedLoop(scenario, options).run();
}

std::vector<std::string> check_setup(const config::Scenario& scenario) {
  return ClosedLoop(scenario, ClosedLoopOptions{}).notes();
}

double measure_tick(const config::Scenario& scenario) {
  return ClosedLoop(scenario, ClosedLoopOptions{}).measure_tick();
}

}  // namespace surefoot::closed_loop
