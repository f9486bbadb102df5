#include "cli/demo.hpp"

#include "cli/demo_page.hpp"
#include "cli/exit_code.hpp"
#include "cli/experiments.hpp"
#include "cli/progress.hpp"
#include "cli/python_tools.hpp"
#include "cli/results_json.hpp"
#include "cli/results_table.hpp"
#include "cli/run_command.hpp"
#include "cli/seed_runs.hpp"
#include "surefoot/base/build_info.hpp"
#include "surefoot/base/error.hpp"
#include "surefoot/base/text_table.hpp"
#include "surefoot/logging/output_files.hpp"
#include "surefoot/logging/write_lock.hpp"
#include "surefoot/runtime/interrupt.hpp"

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <numeric>

namespace surefoot {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// The build folder that the program runs from, or else the present one.
fs::path default_folder() {
  std::error_code unknown;
  const fs::path program = fs::read_symlink("/proc/self/exe", unknown);
  const fs::path source(build_info().source_data);
  for (fs::path place = program.parent_path(); place.has_relative_path();
       place = place.parent_path()) {
    if (place.filename() == "build" && place.parent_path() == source) return place / "demo";
  }
  return "surefoot-demo";
}

/// Runs of an experiment: the nominal one first, with log and report.
std::vector<PlannedRun> plan(const Experiment& experiment, const DemoArguments& arguments,
                             const fs::path& out) {
  std::vector<PlannedRun> runs;
  for (int seed = 0; seed <= (experiment.seeds ? arguments.seeds : 0); ++seed) {
    PlannedRun run;
    run.request = {.name_or_path = experiment.scenario,
                   .seed = static_cast<std::uint64_t>(seed),
                   .assignments = experiment.assignments};
    if (seed == 0) {
      run.report = out / experiment.name;
      run.log = run.report / "run.mcap";
      run.pictures = !arguments.no_pictures;
    }
    runs.push_back(run);
  }
  return runs;
}

std::string measured(const Experiment& experiment, const Json& run) {
  if (run.contains("crashed")) return run.value("reason", "");
  std::string text;
  for (const std::string& metric : experiment.shown) {
    const std::string limit = asked_of(run, metric);
    text += (text.empty() ? "" : ", ") + (metric == "reason" ? "" : metric + " ") +
            pretty(metric, run.at(metric)) + (limit.empty() ? "" : " (" + limit + ")");
  }
  return text;
}

std::string paper(const Experiment& experiment, const Scenario& scenario) {
  std::string text;
  for (const PaperFigure& figure : scenario.paper) {
    if (std::ranges::find(experiment.shown, figure.metric) == experiment.shown.end()) continue;
    text += (text.empty() ? "" : ", ") + figure.metric + " " + figure.text;
  }
  return text;
}

/// The experiment's line, from its rows: nominal, then seeds.
DemoRow summarise(const Experiment& experiment, const Scenario& scenario,
                  const std::vector<Json>& rows) {
  DemoRow row{.name = experiment.name,
              .description = scenario.description,
              .measured = measured(experiment, rows.front()),
              .seeds = {},
              .paper = paper(experiment, scenario),
              .verdict = {},
              .report = {}};
  bool passed = rows.front().value("succeeded", false);
  if (rows.size() > 1) {
    const std::vector<Json> seeds(rows.begin() + 1, rows.end());
    row.seeds = seeds_line(scenario, seeds_json(scenario, seeds));
    passed = passed && enough_succeeded(scenario, seeds);
  }
  row.verdict = experiment.as_found ? "as found" : passed ? "✓" : "✗";
  if (!rows.front().contains("crashed")) row.report = experiment.name + "/index.html";
  return row;
}

/// An experiment with its runs and what came of them.
struct Trial {
  Experiment experiment;
  std::vector<PlannedRun> runs;
  double duration = 0.0;  ///< of each at most, simulated [s]
  std::vector<Json> rows = {};

  [[nodiscard]] bool is_whole() const { return std::ranges::all_of(rows, surefoot::is_whole); }
};

/// Also makes room for them: what an interrupted demo leaves behind must not look like results.
std::vector<Trial> plan_all(const DemoArguments& arguments, const fs::path& out) {
  for (const char* result : {"index.html", "results.json"}) fs::remove(out / result);
  std::vector<Trial> trials;
  for (const Experiment& experiment : experiments()) {
    trials.push_back({experiment, plan(experiment, arguments, out)});
    trials.back().duration = load_scenario(trials.back().runs.front().request).duration;
    prepare_folder(out / experiment.name);
    remove_outdated(trials.back().runs.front().report, trials.back().runs.front().log);
  }
  return trials;
}

void run_with_progress(std::vector<Trial>& trials, int jobs) {
  std::vector<PlannedRun> runs;
  std::vector<double> durations;
  for (const Trial& trial : trials) {
    std::ranges::copy(trial.runs, std::back_inserter(runs));
    durations.insert(durations.end(), trial.runs.size(), trial.duration);
  }
  const double all = std::reduce(durations.begin(), durations.end());
  Progress progress("experiments", static_cast<double>(runs.size()), "runs");
  double done = 0.0, simulated = 0.0;
  const std::vector<Json> rows = run_all(runs, jobs, [&](std::size_t number, const Json& row) {
    simulated += durations[number];
    progress.update(++done, simulated / all);
    if (!runs[number].report.empty() && is_whole(row)) {
      progress.say(runs[number].report.filename().string() + ": " + row.value("reason", ""));
    }
  });
  auto next = rows.begin();
  for (Trial& trial : trials) {
    const auto end = next + static_cast<std::ptrdiff_t>(trial.runs.size());
    trial.rows.assign(next, end);
    next = end;
  }
}

/// Removes what an interrupt left of the experiments that it cut off, and these.
void drop_unfinished(std::vector<Trial>& trials) {
  for (const Trial& trial : trials) {
    if (trial.is_whole()) continue;
    const PlannedRun& nominal = trial.runs.front();
    remove_outdated(nominal.report, nominal.log);
    remove_if_empty(nominal.report);
  }
  std::erase_if(trials, [](const Trial& trial) { return !trial.is_whole(); });
}

/// Each experiment as a block, so that a line fits a terminal.
void print(const std::vector<DemoRow>& rows) {
  std::vector<std::vector<std::string>> table;
  for (const DemoRow& row : rows) {
    table.push_back({row.name, row.verdict, "measured", row.measured});
    if (!row.seeds.empty()) table.push_back({"", "", "seeds", row.seeds});
    if (!row.paper.empty()) table.push_back({"", "", "paper", row.paper});
  }
  std::cout << "\n" << aligned(table);
}

void write_index(const fs::path& out, const std::vector<Trial>& trials,
                 const std::vector<DemoRow>& rows) {
  std::vector<Json> results;
  for (const Trial& trial : trials) std::ranges::copy(trial.rows, std::back_inserter(results));
  write_file(out / "results.json", Json(results).dump(1) + "\n");
  const std::string cut = trials.size() == experiments().size() ? "" : "interrupted; ";
  write_file(out / "index.html",
             demo_page(rows, cut + "Bellicoso et al., Humanoids 2016, in simulation; surefoot " +
                                 std::string(build_info().version)));
  std::cout << "\nreport: " << (out / "index.html").string() << "\n";
}

/// The experiment that shows most: down a step that the robot does not know of.
RunArguments watched(const DemoArguments& arguments) {
  RunArguments run;
  run.scenario = "step_down";
  run.view = arguments.view;
  return run;
}

void check_watched(const DemoArguments& arguments) {
  const DemoArguments usual;
  const char* other = !arguments.out.empty()           ? "--out"
                      : arguments.seeds != usual.seeds ? "--seeds"
                      : arguments.jobs != usual.jobs   ? "--jobs"
                      : arguments.no_pictures          ? "--no-pictures"
                                                       : nullptr;
  if (!arguments.view.view || other == nullptr) return;
  throw Error(std::string("--view shows one run and writes nothing, and can't go with ") + other +
              "; leave out one of them");
}

}  // namespace

int demo_command(const DemoArguments& arguments) {
  check(arguments.view);
  check_watched(arguments);
  if (arguments.view.view) return run_command(watched(arguments));
  check_has_python("demo");
  watch_for_interrupt();
  const fs::path out = arguments.out.empty() ? default_folder() : fs::path(arguments.out);
  const bool is_new = !fs::exists(out);
  prepare_folder(out);
  const WriteLock mine(out.string(), out.string());
  std::vector<Trial> trials = plan_all(arguments, out);
  const auto count = [](int sum, const Trial& trial) {
    return sum + static_cast<int>(trial.runs.size());
  };
  std::fprintf(stderr, "%zu experiments of the paper in %d runs, %d at a time; reports go to %s\n",
               trials.size(), std::accumulate(trials.begin(), trials.end(), 0, count),
               arguments.jobs, out.c_str());
  run_with_progress(trials, arguments.jobs);
  drop_unfinished(trials);
  if (trials.empty()) {
    if (is_new) remove_if_empty(out);
    throw Error("interrupted: no results");
  }

  std::vector<DemoRow> rows;
  for (const Trial& trial : trials) {
    rows.push_back(
        summarise(trial.experiment, load_scenario(trial.runs.front().request), trial.rows));
  }
  print(rows);
  write_index(out, trials, rows);
  if (trials.size() < experiments().size()) {
    throw Error("interrupted: " + std::to_string(trials.size()) + " of " +
                std::to_string(experiments().size()) + " experiments are whole");
  }
  return std::ranges::any_of(rows, [](const DemoRow& row) { return row.verdict == "✗"; }) ? kFailed
                                                                                          : kPassed;
}

}  // namespace surefoot
