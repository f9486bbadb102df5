#include "surefoot/doctor/trial.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/base/formatted.hpp"
#include "surefoot/closed_loop/closed_loop.hpp"
#include "surefoot/config/scenario_file.hpp"
#include "surefoot/doctor/guessed_file.hpp"

#include <cmath>
#include <filesystem>

namespace surefoot::doctor {
namespace {

std::string number_of(const evaluation::CriterionResult& missed) {
  const evaluation::Criterion& criterion = missed.criterion;
  if (criterion.equals) return "";
  const bool is_above = criterion.max && missed.value > *criterion.max;
  return formatted(" (%.4g, %s %.4g)", missed.value, is_above ? "at most" : "at least",
                   is_above ? *criterion.max : criterion.min.value_or(0.0));
}

std::string why(const closed_loop::RunResult& result) {
  std::string missed;
  for (const evaluation::CriterionResult& each : result.criteria) {
    if (each.passed.value_or(true)) continue;
    missed += (missed.empty() ? "; missed: " : ", ") + each.criterion.metric + number_of(each);
  }
  return result.metrics.reason + missed;
}

/// What the run reached, in figures.
std::string figures(const evaluation::Metrics& metrics) {
  std::string text;
  if (metrics.distance_m > 0.1)
    text += formatted("; %.3g m at %.3g m/s", metrics.distance_m, metrics.speed_mps);
  if (std::isfinite(metrics.com_error_max_m))
    text += formatted("; COM error up to %.2g mm", 1e3 * metrics.com_error_max_m);
  return text + formatted("; torque up to %.3g N·m", metrics.torque_max_nm);
}

/// A scenario with changes, under a name.
struct Asked {
  std::string name, scenario;
  std::vector<std::string> assignments;
};

Trial run(Asked asked, const GuessedFile& robot, const TrialOptions& options) {
  const std::string& name = asked.name;
  try {
    asked.assignments.push_back("robot=" + robot.path());
    const config::Scenario scenario = config::load_scenario(
        {.name_or_path = asked.scenario, .seed = 0, .assignments = asked.assignments});
    closed_loop::ClosedLoopOptions loop;
    loop.interrupted = options.interrupted;
    if (options.progress)
      loop.progress = [&](double time) { options.progress(name, time, scenario.duration); };
    if (!options.logs.empty()) loop.record_path = options.logs + name + ".mcap";
    const closed_loop::RunResult result = closed_loop::run_closed_loop(scenario, loop);
    if (result.ending == closed_loop::Ending::interrupted) throw Error("interrupted: no results");
    const bool succeeded = result.metrics.succeeded.value_or(false);
    if (succeeded && !loop.record_path.empty()) std::filesystem::remove(loop.record_path);
    return {name, succeeded, why(result) + figures(result.metrics),
            succeeded ? "" : loop.record_path, asked.scenario};
  } catch (const Error& error) {
    if (options.interrupted && options.interrupted()) throw;
    return {name, false, robot.without_path(error.what()), "", asked.scenario};
  }
}

}  // namespace

std::vector<Trial> try_walking(const Diagnosis& robot, const TrialOptions& options) {
  const GuessedFile file(robot);
  if (!robot.robot->can_walk()) return {run({"flat_feet", "flat_feet", {}}, file, options)};
  const std::vector<std::string> stands = {"user=[]", "planner.calibration.duration=0",
                                           "duration=4", "criteria=none"};
  return {run({"stand", "walk_flat", stands}, file, options),
          run({"walk_flat", "walk_flat", {}}, file, options),
          run({"step_down", "step_down", {}}, file, options)};
}

}  // namespace surefoot::doctor
