#include "cli/run_command.hpp"

#include "cli/exit_code.hpp"
#include "cli/program_view.hpp"
#include "cli/progress.hpp"
#include "cli/python_tools.hpp"
#include "cli/results_json.hpp"
#include "cli/results_table.hpp"
#include "cli/run_cost.hpp"
#include "surefoot/base/error.hpp"
#include "surefoot/base/printable.hpp"
#include "surefoot/closed_loop/closed_loop.hpp"
#include "surefoot/config/robot_guesses.hpp"
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

namespace surefoot::cli {
namespace {

using Json = nlohmann::ordered_json;

config::Scenario load_scenario(const RunArguments& arguments) {
  return config::load_scenario({.name_or_path = arguments.scenario,
                                .seed = arguments.seed.value_or(0),
                                .assignments = arguments.assignments});
}

void print_notes(const config::Scenario& scenario) {
  for (const std::string& note : scenario.notes)
    std::fprintf(stderr, "surefoot: warning: %s\n", note.c_str());
}

/// Path of a run's log. A report needs one, too, and a film: for a film alone it is temporary.
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
  std::optional<logging::ScratchFolder> scratch_;
  std::filesystem::path path_;
};

/// Throws Error before the run if an output can't be written.
void check_outputs(const RunArguments& arguments) {
  if (!arguments.report.empty()) check_has_python("--report");
  if (!arguments.record.empty()) logging::check_writable_file(arguments.record);
  if (arguments.video.empty()) return;
  check_can_film(arguments.video);
  logging::check_writable_file(arguments.video);
}

/// The report's folder, locked against other runs. Removes it at the end if it is new and empty.
class ReportFolder {
 public:
  explicit ReportFolder(std::filesystem::path folder)
      : folder_(std::move(folder)), is_new_(!std::filesystem::exists(folder_)) {
    if (folder_.empty()) return;
    logging::prepare_folder(folder_);
    lock_.emplace(folder_.string(), folder_.string());
  }
  ~ReportFolder() {
    if (is_new_) logging::remove_if_empty(folder_);
  }
  ReportFolder(const ReportFolder&) = delete;
  ReportFolder& operator=(const ReportFolder&) = delete;

 private:
  std::filesystem::path folder_;
  bool is_new_;
  std::optional<logging::WriteLock> lock_;
};

[[noreturn]] void report_interrupt(const std::string& log) {
  throw Error(
      "interrupted: no results" +
      (log.empty() ? "" : "; the log " + logging::partial_path(log) + " holds the run so far"));
}

void print(const RunArguments& arguments, const Json& json, const std::string& table) {
  std::cout << printable(arguments.json ? json.dump() + "\n" : table, "\n") << std::flush;
}

/// For one run, any success rate above 0 means that it must succeed.
int exit_code(const config::Scenario& scenario, const closed_loop::RunResult& result) {
  const std::optional<bool> succeeded = result.metrics.succeeded;
  if (succeeded.value_or(false) || scenario.success_rate <= 0.0) return kPassed;
  if (!succeeded) return kNotWhole;
  return result.safety_stop ? kSafetyStop : kFailed;
}

/// A failed film does not change the run's result. `log`: of the run; empty: not kept.
void report_film(bool done, const std::string& file, const std::string& log) {
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

/// A run that the viewer's page shows.
int watch_one(const RunArguments& arguments) {
  const config::Scenario scenario = load_scenario(arguments);
  check_outputs(arguments);
  print_notes(scenario);
  const auto print_result = [&](const closed_loop::RunResult& result) {
    const Json json = run_json(scenario, result);
    print(arguments, json, run_table(scenario, json, arguments.all));
  };
  const auto [result, log] = server::run_live(
      scenario,
      {.record_path = arguments.record, .progress = {}, .interrupted = runtime::interrupted},
      arguments.view, print_result);
  if (result.ending == closed_loop::Ending::interrupted) report_interrupt(log);
  return exit_code(scenario, result);
}

closed_loop::RunResult run_with_progress(const config::Scenario& scenario, const std::string& log) {
  Progress progress(scenario.name, scenario.duration, "s");
  return closed_loop::run_closed_loop(scenario,
                                      {.record_path = log,
                                       .progress = [&](double time) { progress.update(time); },
                                       .interrupted = runtime::interrupted});
}

int run_one(const RunArguments& arguments) {
  const config::Scenario scenario = load_scenario(arguments);
  const LogPlace place(arguments);
  const std::string log = place.path().string();
  if (!arguments.report.empty()) closed_loop::check_setup(scenario);
  const ReportFolder folder(arguments.report);
  check_outputs(arguments);
  // A log that was asked for by name is replaced only when the new one is whole.
  if (!arguments.report.empty())
    logging::remove_outdated(arguments.report, arguments.record.empty() ? log : "");
  print_notes(scenario);
  const closed_loop::RunResult result = run_with_progress(scenario, log);
  if (result.ending == closed_loop::Ending::interrupted)
    report_interrupt(place.is_kept() ? log : "");
  const bool has_report =
      arguments.report.empty() || write_report(log, arguments.report, !arguments.no_pictures);
  if (!arguments.report.empty() && has_report)
    std::fprintf(stderr, "report: %s/index.html\n", arguments.report.c_str());
  if (!arguments.video.empty())
    report_film(film(log, arguments.video), arguments.video, place.is_kept() ? log : "");
  const Json json = run_json(scenario, result);
  print(arguments, json, run_table(scenario, json, arguments.all));
  if (!has_report) {
    throw Error("the report was not written; surefoot report " + log + " --out " +
                arguments.report + " tries again");
  }
  return exit_code(scenario, result);
}

/// Cost of a run, and its notes that are no warnings of the scenario.
std::string check_text(const config::Scenario& scenario, const RunCost& cost,
                       const std::vector<std::string>& notes) {
  std::string said =
      scenario.name + ": nothing is wrong with it; a run is " + cost_text(cost) + "\n";
  for (const std::string& note : notes) {
    if (std::ranges::find(scenario.notes, note) == scenario.notes.end())
      said += "note: " + note + "\n";
  }
  const std::string guesses = config::robot_guesses(scenario);
  return guesses.empty() ? said : said + "note: " + guesses + "\n";
}

int check_one(const RunArguments& arguments) {
  const config::Scenario scenario = load_scenario(arguments);
  const std::vector<std::string> notes = closed_loop::check_setup(scenario);
  check_outputs(arguments);
  const RunCost cost = run_cost(scenario);
  print_notes(scenario);
  Json json = check_json(scenario);
  json["cost"] = {{"ticks", cost.ticks},
                  {"wall_time_s", cost.wall_seconds},
                  {"memory_bytes", cost.memory},
                  {"log_bytes", cost.log}};
  print(arguments, json, check_text(scenario, cost, notes));
  return kPassed;
}

/// Python runs many seeds, and starts this program for each of them.
[[noreturn]] void run_seeds(const RunArguments& arguments) {
  std::vector<std::string> words{
      arguments.scenario, "--first=" + std::to_string(arguments.seed.value_or(1)),
      "--seeds=" + std::to_string(arguments.seeds), "--jobs=" + std::to_string(arguments.jobs)};
  for (const std::string& assignment : arguments.assignments)
    words.push_back("--set=" + assignment);
  if (!arguments.record.empty()) words.push_back("--record=" + arguments.record);
  if (!arguments.report.empty()) words.push_back("--report=" + arguments.report);
  if (!arguments.video.empty()) words.push_back("--video=" + arguments.video);
  if (arguments.no_pictures) words.emplace_back("--no-pictures");
  if (arguments.all) words.emplace_back("--all");
  if (arguments.json) words.emplace_back("--json");
  become_python("--seeds", "surefoot_campaign.seeds", words);
}

/// Throws Error on an option that --view excludes.
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
  runtime::watch_for_interrupt();
  check(arguments.view);
  if (arguments.view.view) check_watched(arguments);
  if (arguments.check) return check_one(arguments);
  if (arguments.view.view) return watch_one(arguments);
  if (arguments.seeds > 0) run_seeds(arguments);
  return run_one(arguments);
}

}  // namespace surefoot::cli
