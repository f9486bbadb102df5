#include "app/demo.hpp"

#include "app/demo_page.hpp"
#include "app/exit_code.hpp"
#include "app/experiments.hpp"
#include "app/interrupt.hpp"
#include "app/output_files.hpp"
#include "app/progress.hpp"
#include "app/results_json.hpp"
#include "app/results_table.hpp"
#include "app/seed_runs.hpp"
#include "surefoot/base/build_info.hpp"
#include "surefoot/base/error.hpp"

#include <algorithm>
#include <cstdio>
#include <iostream>

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

std::vector<Json> run_with_progress(const std::vector<PlannedRun>& runs, int jobs) {
  Progress progress("experiments", static_cast<double>(runs.size()), "runs");
  double done = 0.0;
  return run_all(runs, jobs, [&](std::size_t number, const Json& row) {
    progress.update(++done);
    if (!runs[number].report.empty() && !interrupted()) {
      progress.say(runs[number].report.filename().string() + ": " + row.value("reason", ""));
    }
  });
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

}  // namespace

int demo_command(const DemoArguments& arguments) {
  watch_for_interrupt();
  const fs::path out = arguments.out.empty() ? default_folder() : fs::path(arguments.out);
  prepare_folder(out);
  // What an interrupted demo leaves behind must not look like its results.
  for (const char* result : {"index.html", "results.json"}) fs::remove(out / result);
  std::vector<PlannedRun> runs;
  std::vector<std::size_t> first;
  for (const Experiment& experiment : experiments()) {
    prepare_folder(out / experiment.name);
    first.push_back(runs.size());
    std::ranges::move(plan(experiment, arguments, out), std::back_inserter(runs));
  }
  first.push_back(runs.size());
  for (const PlannedRun& run : runs) {
    if (!run.report.empty()) remove_outdated(run.report, run.log);
  }
  std::fprintf(stderr, "%zu experiments of the paper in %zu runs, %d at a time; reports go to %s\n",
               experiments().size(), runs.size(), arguments.jobs, out.c_str());
  const std::vector<Json> results = run_with_progress(runs, arguments.jobs);
  if (interrupted()) throw Error("interrupted: no results");

  std::vector<DemoRow> rows;
  for (std::size_t i = 0; i < experiments().size(); ++i) {
    const auto begin = results.begin() + static_cast<std::ptrdiff_t>(first[i]);
    const auto end = results.begin() + static_cast<std::ptrdiff_t>(first[i + 1]);
    rows.push_back(
        summarise(experiments()[i], load_scenario(runs[first[i]].request), {begin, end}));
  }
  print(rows);
  write_file(out / "results.json", Json(results).dump(1) + "\n");
  write_file(out / "index.html",
             demo_page(rows, "Bellicoso et al., Humanoids 2016, in simulation; surefoot " +
                                 std::string(build_info().version)));
  std::cout << "\nreport: " << (out / "index.html").string() << "\n";
  return std::ranges::any_of(rows, [](const DemoRow& row) { return row.verdict == "✗"; }) ? kFailed
                                                                                          : kPassed;
}

}  // namespace surefoot
