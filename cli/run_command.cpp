#include "cli/run_command.hpp"

#include "cli/exit_code.hpp"
#include "cli/program_view.hpp"
#include "cli/progress.hpp"
#include "cli/python_tools.hpp"
#include "cli/results_json.hpp"
#include "cli/results_table.hpp"
#include "cli/run_cost.hpp"
#include "cli/seed_runs.hpp"
#include "surefoot/base/error.hpp"
#include "surefoot/base/printable.hpp"
#include "surefoot/closed_loop/closed_loop.hpp"
#include "surefoot/config/scenario_file.hpp"
#include "surefoot/logging/output_files.hpp"
#include "surefoot/logging/recorder.hpp"
#include "surefoot/logging/scratch_folder.hpp"
#include "surefoot/logging/write_lock.hpp"
#include "surefoot/runtime/interrupt.hpp"

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <optional>

namespace surefoot {
namespace {

using Json = nlohmann::ordered_json;

void tell_notes(const Scenario& scenario) {
  for (const std::string& note : scenario.notes)
    std::fprintf(stderr, "surefoot: warning: %s\n", note.c_str());
}

/// Where a run's log goes: a report needs one too, and so does a film, for which it goes away
/// again.
class LogPlace {
 public:
  explicit LogPlace(const RunArguments& arguments) : path_(arguments.record) {
    if (!path_.empty()) return;
    if (!arguments.report.empty()) {
      path_ = std::filesystem::path(arguments.report) / "run.mcap";
    } else if (!arguments.video.empty()) {
      path_ = scratch_.emplace().path() / "run.mcap";
    }
  }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] bool is_kept() const { return !scratch_; }

 private:
  std::optional<ScratchFolder> scratch_;
  std::filesystem::path path_;
};

/// What can't be written is told before the run, not after it; what is wrong with the scenario
/// before any file is touched.
void check_outputs(const RunArguments& arguments) {
  if (!arguments.report.empty()) check_has_python("--report");
  if (!arguments.record.empty()) check_writable_file(arguments.record);
  if (arguments.video.empty()) return;
  check_can_film(arguments.video);
  check_writable_file(arguments.video);
}

/// A log that was asked for by name is replaced only when the new one is whole.
void remove_outdated_of(const RunArguments& arguments, const PlannedRun& run) {
  if (run.report.empty()) return;
  remove_outdated(run.report, arguments.record.empty() ? run.log : std::filesystem::path());
}

/// This call's alone, while it writes there. Leaves no folder behind that it made for nothing.
class ReportFolder {
 public:
  explicit ReportFolder(std::filesystem::path folder)
      : folder_(std::move(folder)), is_new_(!std::filesystem::exists(folder_)) {
    if (folder_.empty()) return;
    prepare_folder(folder_);
    lock_.emplace(folder_.string(), folder_.string());
  }
  ~ReportFolder() {
    if (is_new_) remove_if_empty(folder_);
  }
  ReportFolder(const ReportFolder&) = delete;
  ReportFolder& operator=(const ReportFolder&) = delete;

 private:
  std::filesystem::path folder_;
  bool is_new_;
  std::optional<WriteLock> lock_;
};

[[noreturn]] void report_interrupt(const std::string& log) {
  throw Error("interrupted: no results" +
              (log.empty() ? "" : "; the log " + partial_path(log) + " holds the run so far"));
}

/// The logs that an interrupt cut off.
std::string cut_logs(const std::vector<PlannedRun>& runs) {
  std::string names;
  for (const PlannedRun& run : runs) {
    const std::string log = partial_path(run.log.string());
    if (!run.log.empty() && std::filesystem::exists(log)) {
      names += (names.empty() ? "" : ", ") + log;
    }
  }
  return names;
}

[[noreturn]] void report_interrupt(const std::vector<PlannedRun>& runs, std::size_t finished,
                                   bool logs_are_kept) {
  const std::string logs = logs_are_kept ? cut_logs(runs) : "";
  throw Error("interrupted: " +
              (finished == 0 ? "no results"
                             : std::to_string(finished) + " of " + std::to_string(runs.size()) +
                                   " seeds are finished and shown") +
              (logs.empty() ? "" : "; logs that are not whole: " + logs));
}

void print(const RunArguments& arguments, const Json& json, const std::string& table) {
  std::cout << printable(arguments.json ? json.dump() + "\n" : table, "\n") << std::flush;
}

/// The same rule for one run and for many.
int exit_code(const Scenario& scenario, const std::vector<Json>& runs) {
  if (enough_succeeded(scenario, runs)) return kPassed;
  const auto stopped = [](const Json& run) { return run.value("safety_stop", false); };
  return std::ranges::any_of(runs, stopped) ? kSafetyStop : kFailed;
}

/// The run's result stands whatever became of its film. `log`: of the run; empty: it is not kept.
void tell_film(bool done, const std::string& file, const std::string& log) {
  if (done) {
    std::fprintf(stderr, "video: %s\n", file.c_str());
    return;
  }
  const std::string again = log.empty()
                                ? "--record FILE keeps the log, of which surefoot video "
                                  "makes the film later"
                                : "surefoot video " + log + " --out " + file + " tries again";
  std::fprintf(stderr, "surefoot: warning: %s was not filmed; %s\n", file.c_str(), again.c_str());
}

/// A run before the eyes of those who open its page.
int watch_one(const RunArguments& arguments) {
  const Scenario scenario = load_scenario({.name_or_path = arguments.scenario,
                                           .seed = arguments.seed.value_or(0),
                                           .assignments = arguments.assignments});
  check_outputs(arguments);
  tell_notes(scenario);
  const auto tell = [&](const RunResult& result) {
    const Json json = run_json(scenario, result);
    print(arguments, json, run_table(scenario, json));
  };
  const auto [result, log] = run_live(
      scenario, {.record_path = arguments.record, .progress = {}, .interrupted = interrupted},
      arguments.view, tell);
  if (result.ending == Ending::interrupted) report_interrupt(log);
  return exit_code(scenario, {run_json(scenario, result)});
}

int run_one(const RunArguments& arguments) {
  const Scenario scenario = load_scenario({.name_or_path = arguments.scenario,
                                           .seed = arguments.seed.value_or(0),
                                           .assignments = arguments.assignments});
  const LogPlace place(arguments);
  const std::string log = place.path().string();
  if (!arguments.report.empty()) check_setup(scenario);
  const ReportFolder folder(arguments.report);
  check_outputs(arguments);
  remove_outdated_of(arguments,
                     {.request = {}, .log = log, .report = arguments.report, .video = {}});
  tell_notes(scenario);
  RunResult result;
  {
    Progress progress(scenario.name, scenario.duration, "s");
    result = run_closed_loop(scenario, {.record_path = log,
                                        .progress = [&](double time) { progress.update(time); },
                                        .interrupted = interrupted});
  }
  if (result.ending == Ending::interrupted) report_interrupt(place.is_kept() ? log : "");
  const bool has_report = arguments.report.empty() || write_report(log, arguments.report);
  if (!arguments.report.empty() && has_report)
    std::fprintf(stderr, "report: %s/index.html\n", arguments.report.c_str());
  if (!arguments.video.empty())
    tell_film(film(log, arguments.video), arguments.video, place.is_kept() ? log : "");
  const Json json = run_json(scenario, result);
  print(arguments, json, run_table(scenario, json));
  if (!has_report) {
    throw Error("the report was not written; surefoot report " + log + " --out " +
                arguments.report + " tries again");
  }
  return exit_code(scenario, {json});
}

/// What a run would leave out or change, besides the warnings of the scenario.
std::string check_text(const Scenario& scenario, const RunCost& cost,
                       const std::vector<std::string>& notes) {
  std::string said =
      scenario.name + ": nothing is wrong with it; a run is " + cost_text(cost) + "\n";
  for (const std::string& note : notes) {
    if (std::ranges::find(scenario.notes, note) == scenario.notes.end())
      said += "note: " + note + "\n";
  }
  return said;
}

int check_one(const RunArguments& arguments) {
  const Scenario scenario = load_scenario({.name_or_path = arguments.scenario,
                                           .seed = arguments.seed.value_or(0),
                                           .assignments = arguments.assignments});
  const std::vector<std::string> notes = check_setup(scenario);
  const RunCost cost = run_cost(scenario);
  tell_notes(scenario);
  Json json = check_json(scenario);
  json["cost"] = {{"ticks", cost.ticks},
                  {"wall_time_s", cost.wall_seconds},
                  {"memory_bytes", cost.memory},
                  {"log_bytes", cost.log}};
  print(arguments, json, check_text(scenario, cost, notes));
  return kPassed;
}

std::vector<PlannedRun> plan_runs(const RunArguments& arguments, const std::filesystem::path& log) {
  std::vector<PlannedRun> runs;
  for (int i = 0; i < arguments.seeds; ++i) {
    PlannedRun run;
    const std::uint64_t seed = arguments.seed.value_or(1) + static_cast<std::uint64_t>(i);
    run.request = {
        .name_or_path = arguments.scenario, .seed = seed, .assignments = arguments.assignments};
    if (!arguments.video.empty()) run.video = with_seed(arguments.video, seed);
    if (!log.empty()) run.log = with_seed(log, seed);
    if (!arguments.report.empty()) {
      run.report = std::filesystem::path(arguments.report) / ("seed" + std::to_string(seed));
    }
    runs.push_back(run);
  }
  return runs;
}

std::string outcome(const Json& row) {
  const bool succeeded = row.value("succeeded", false);
  return "seed " + std::to_string(row.value("seed", std::uint64_t{0})) + ": " +
         (succeeded ? "succeeded" : "did not succeed") + ", " + row.value("reason", "");
}

/// What can't be typed as --seed could not be run again.
void check_last_seed(const RunArguments& arguments) {
  const std::uint64_t first = arguments.seed.value_or(1);
  const std::uint64_t last = first + static_cast<std::uint64_t>(arguments.seeds) - 1;
  if (last <= kLargestSeed) return;
  throw Error("--seeds: " + std::to_string(arguments.seeds) + " from seed " +
              std::to_string(first) + " on end at " + std::to_string(last) + ", which is above " +
              std::to_string(kLargestSeed) + ", the largest seed");
}

int run_seeds(const RunArguments& arguments) {
  check_last_seed(arguments);
  const LogPlace place(arguments);
  const std::vector<PlannedRun> runs = plan_runs(arguments, place.path());
  const Scenario scenario = load_scenario(runs.front().request);
  check_setup(scenario);
  const ReportFolder folder(arguments.report);
  check_outputs(arguments);
  for (const PlannedRun& run : runs) {
    if (!run.log.empty()) check_not_being_written(run.log);
    remove_outdated_of(arguments, run);
  }
  tell_notes(scenario);
  std::vector<Json> rows;
  {
    Progress progress(scenario.name, arguments.seeds, "runs");
    double done = 0.0;
    rows = run_all(runs, arguments.jobs, [&](std::size_t, const Json& row) {
      progress.update(++done);
      if (is_whole(row)) progress.say(outcome(row));
    });
  }
  const auto not_whole = std::erase_if(rows, [](const Json& row) { return !is_whole(row); });
  if (rows.empty()) report_interrupt(runs, 0, place.is_kept());
  if (all_the_same(rows)) {
    std::fputs(
        "surefoot: warning: all runs are the same: the scenario draws nothing at random, so "
        "rates and their intervals mean nothing\n",
        stderr);
  }
  Json json = seeds_json(scenario, rows);
  if (not_whole > 0) json["interrupted"] = true;
  print(arguments, json, seeds_table(scenario, json));
  if (not_whole > 0) report_interrupt(runs, rows.size(), place.is_kept());
  return exit_code(scenario, rows);
}

/// What --view can't go with.
void check_watched(const RunArguments& arguments) {
  const char* other = arguments.seeds > 0         ? "--seeds"
                      : arguments.check           ? "--check"
                      : !arguments.report.empty() ? "--report"
                      : !arguments.video.empty()  ? "--video"
                                                  : nullptr;
  if (other == nullptr) return;
  throw Error(std::string("--view shows one run, and can't go with ") + other +
              "; leave out one of them" +
              (arguments.report.empty() && arguments.video.empty()
                   ? ""
                   : ". --record FILE keeps the log, of which surefoot report or video makes it"));
}

}  // namespace

int run_command(const RunArguments& arguments) {
  watch_for_interrupt();
  check(arguments.view);
  if (arguments.view.view) check_watched(arguments);
  if (arguments.check) return check_one(arguments);
  if (arguments.view.view) return watch_one(arguments);
  return arguments.seeds > 0 ? run_seeds(arguments) : run_one(arguments);
}

}  // namespace surefoot
