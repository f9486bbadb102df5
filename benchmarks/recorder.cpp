// What the log costs, and how much of it is `blocked_by`: bytes and CPU time of the recorder for
// each tick of a log, with and without, and of the controller, asked and not asked what holds its
// levels back. Both of a pair take turns, so that what else runs on the machine meets both.
//
//     bin/surefoot run step_down --record run.mcap && build/release/benchmark_recorder run.mcap
#include "surefoot/logging/recorder.hpp"

#include "surefoot/logging/log_reader.hpp"
#include "surefoot/replay/log_replay.hpp"

#include <time.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

namespace surefoot {
namespace {

constexpr int kPasses = 11;

/// CPU time of all threads [s].
double cpu_time() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

struct Log {
  logging::LogHeader header;
  std::vector<TickRecord> ticks;
};

Log read(const std::string& path) {
  logging::LogReader reader(path);
  Log log{reader.header(), {}};
  for (TickRecord tick; reader.next(tick);) log.ticks.push_back(tick);
  log.header.row_name = [names = reader.row_names()](int level, std::int32_t id) {
    const auto name = names.find({static_cast<std::int16_t>(level), id});
    return name == names.end() ? "" : name->second;
  };
  return log;
}

Log without_blockers(Log log) {
  for (TickRecord& tick : log.ticks) {
    tick.hierarchy.num_blocking = 0;
    tick.hierarchy.blocking_is_known = false;
  }
  return log;
}

/// CPU time of a tick [µs]; the file's size in `bytes`.
double record(const Log& log, double& bytes) {
  const std::string path = (std::filesystem::temp_directory_path() / "benchmark.mcap").string();
  const double begin = cpu_time();
  logging::Recorder recorder(path, log.header);
  for (const TickRecord& tick : log.ticks) recorder.record(tick);
  recorder.close();
  const double seconds = cpu_time() - begin;
  bytes = static_cast<double>(std::filesystem::file_size(path));
  std::filesystem::remove(path);
  return 1e6 * seconds / static_cast<double>(log.ticks.size());
}

/// CPU time of a tick of the controller [µs], the reading of the log included.
double replay(const std::string& path, bool explains) {
  replay::LogReplay log(path);
  log.explain_levels(explains);
  const double begin = cpu_time();
  int ticks = 0;
  while (log.step()) ++ticks;
  return 1e6 * (cpu_time() - begin) / ticks;
}

void compare(const std::string& path) {
  const Log with = read(path);
  const Log without = without_blockers(with);
  const auto num_ticks = static_cast<double>(with.ticks.size());
  double rows = 0.0, bytes_with = 0.0, bytes_without = 0.0;
  for (const TickRecord& tick : with.ticks) rows += tick.hierarchy.num_blocking;
  std::vector<double> time_with, time_without, asked, not_asked;
  for (int pass = 0; pass < kPasses; ++pass) {
    time_with.push_back(record(with, bytes_with));
    time_without.push_back(record(without, bytes_without));
    asked.push_back(replay(path, true));
    not_asked.push_back(replay(path, false));
  }
  std::vector<double> recording, explaining;
  for (std::size_t i = 0; i < time_with.size(); ++i) {
    recording.push_back(time_with[i] - time_without[i]);
    explaining.push_back(asked[i] - not_asked[i]);
  }
  std::printf("%.0f ticks, %.1f rows of blocked_by in each\n", num_ticks, rows / num_ticks);
  std::printf("bytes a tick: %.0f with blocked_by, %.0f without\n", bytes_with / num_ticks,
              bytes_without / num_ticks);
  std::printf("recorder, CPU time a tick: %.1f µs with, %.1f µs without, difference %.1f µs\n",
              median(time_with), median(time_without), median(recording));
  std::printf("controller, CPU time a tick: asked what holds its levels back %.1f µs more\n",
              median(explaining));
}

}  // namespace
}  // namespace surefoot

int main(int argc, char** argv) {
  if (argc != 2) return std::puts("usage: benchmark_recorder LOG.mcap"), 2;
  surefoot::compare(argv[1]);
  return 0;
}
