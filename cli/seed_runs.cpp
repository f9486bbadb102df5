#include "cli/seed_runs.hpp"

#include "cli/process_pool.hpp"
#include "cli/python_tools.hpp"
#include "cli/results_json.hpp"
#include "surefoot/base/error.hpp"
#include "surefoot/closed_loop/closed_loop.hpp"
#include "surefoot/runtime/interrupt.hpp"

namespace surefoot {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kInterrupted = "interrupted";

std::string run_here(const PlannedRun& run) {
  const Scenario scenario = load_scenario(run.request);
  ClosedLoopOptions options;
  options.record_path = run.log.string();
  options.interrupted = interrupted;
  const RunResult result = run_closed_loop(scenario, options);
  const bool is_cut = result.ending == Ending::interrupted;
  const bool has_report =
      is_cut || run.report.empty() ||
      write_report(run.log.string(), run.report.string(), {run.pictures, /*quiet=*/true});
  if (!has_report && !interrupted()) {
    throw Error("the report of " + run.log.string() + " was not written");
  }
  if (!run.video.empty() && !is_cut) {
    (void)film(run.log.string(), run.video.string());  // says itself what went wrong
  }
  Json json = run_json(scenario, result);
  if (is_cut || !has_report) json[kInterrupted] = true;
  return json.dump();
}

Json row(const PlannedRun& run, const JobOutcome& outcome) {
  return outcome.failure.empty() ? Json::parse(outcome.output)
                                 : crash_json(run.request.seed, outcome.failure);
}

}  // namespace

bool is_whole(const Json& row) { return !row.is_null() && !row.contains(kInterrupted); }

std::vector<Json> run_all(const std::vector<PlannedRun>& runs, int jobs,
                          const std::function<void(std::size_t run, const Json& row)>& finished) {
  std::vector<Job> work;
  for (const PlannedRun& run : runs) work.emplace_back([&run] { return run_here(run); });
  std::vector<Json> rows(runs.size());
  run_in_processes(work, jobs, [&](std::size_t number, const JobOutcome& outcome) {
    rows[number] = row(runs[number], outcome);
    finished(number, rows[number]);
  });
  return rows;
}

}  // namespace surefoot
