#include "cli/dump_command.hpp"

#include "cli/exit_code.hpp"
#include "cli/log_commands.hpp"
#include "surefoot/base/error.hpp"
#include "surefoot/base/printable.hpp"
#include "surefoot/config/hierarchy_json.hpp"
#include "surefoot/config/scenario_file.hpp"
#include "surefoot/logging/hierarchy_status.hpp"
#include "surefoot/logging/output_files.hpp"
#include "surefoot/logging/whole_file.hpp"
#include "surefoot/replay/log_replay.hpp"
#include "surefoot/runtime/interrupt.hpp"
#include "surefoot/simulation/make_estimator.hpp"
#include "surefoot/simulation/plant.hpp"

#include <cmath>
#include <filesystem>
#include <ostream>
#include <sstream>

namespace surefoot::cli {
namespace {

namespace fs = std::filesystem;

std::string text(double number) {
  std::ostringstream stream;
  stream << number;
  return stream.str();
}

/// Writes the ticks in the range.
class Dump {
 public:
  Dump(const DumpArguments& arguments, std::ostream& out) : arguments_(arguments), out_(out) {}

  /// False once no later tick is wanted.
  bool add(double time, const control::Controller& controller) {
    const double begin = arguments_.from - kHalfNanosecond;
    if (time >= arguments_.to - kHalfNanosecond) return false;
    last_ = time;
    if (time < begin || !logging::was_solved(controller.record().hierarchy)) return true;
    if (num_met_++ % arguments_.every != 0) return true;
    write(controller);
    return true;
  }

  void check_any(const std::string& source) const {
    if (num_met_ > 0) return;
    throw Error(source + ": no tick with a hierarchy from " + text(arguments_.from) + " s on" +
                (std::isfinite(arguments_.to) ? " and before " + text(arguments_.to) + " s" : "") +
                "; the last tick " +
                (std::isnan(last_) ? "is missing" : "is at " + text(last_) + " s"));
  }

 private:
  static constexpr double kHalfNanosecond = 5e-10;  // [s]; times are sums of periods

  void write(const control::Controller& controller) {
    const solver::Hierarchy& hierarchy = controller.hierarchy();
    out_ << config::format_hierarchy(
                hierarchy,
                [&](std::size_t level, Eigen::Index row) {
                  return controller.row_name(static_cast<int>(level),
                                             hierarchy.level(level).id(row));
                },
                controller.level_units())
         << '\n';
    if (!out_)
      throw FileError((arguments_.out.empty() ? "standard output" : arguments_.out) +
                      ": can't be written; check the space there");
  }

  const DumpArguments& arguments_;
  std::ostream& out_;
  long num_met_ = 0;
  double last_ = std::numeric_limits<double>::quiet_NaN();  // [s]
};

void check_not_interrupted() {
  if (runtime::interrupted()) throw Error("interrupted: nothing is kept");
}

void dump_scenario(const DumpArguments& arguments, Dump& dump) {
  const config::Scenario scenario = config::load_scenario({.name_or_path = arguments.source,
                                                           .seed = arguments.seed.value_or(0),
                                                           .assignments = arguments.assignments});
  simulation::Plant plant(scenario.robot, scenario.plant);
  control::Controller controller(
      scenario.robot, scenario.controller,
      simulation::make_estimator(scenario.estimation, {scenario.robot, scenario.controller.period,
                                                       plant, scenario.estimator}));
  const auto ticks = static_cast<long>(std::ceil(scenario.duration / scenario.controller.period));
  for (long tick = 0; tick < ticks; ++tick) {
    check_not_interrupted();
    const SensorReading& reading = plant.read();
    const JointCommand& command = controller.step(reading, scenario.user(reading.time));
    if (!dump.add(reading.time, controller)) break;
    plant.write(command);
  }
}

void dump_log(const DumpArguments& arguments, Dump& dump, std::ostream& err) {
  replay::LogReplay replay(arguments.source);
  double different_from = std::numeric_limits<double>::quiet_NaN();
  while (replay.step()) {
    check_not_interrupted();
    const double time = replay.logged().reading.time;
    if (!dump.add(time, replay.controller())) break;
    if (!replay.is_same() && std::isnan(different_from)) different_from = time;
  }
  if (replay.gap())
    err << "surefoot: warning: " << arguments.source << ": " << printable(replay.problem())
        << "; behind that no tick can be computed again\n";
  if (std::isnan(different_from)) return;
  err << "surefoot: warning: " << arguments.source << ": from " << different_from
      << " s on the torques in the log are not those that this program computes; it was recorded "
         "by another version\n";
}

/// A file, unless it ends as a scenario does; any other name is a scenario's.
bool is_log(const std::string& source) {
  const std::string extension = fs::path(source).extension().string();
  if (extension == ".yaml" || extension == ".yml") return false;
  std::error_code ignored;
  return extension == ".mcap" || fs::is_regular_file(source, ignored);
}

void check(const DumpArguments& arguments, bool log) {
  if (!std::isfinite(arguments.from) || arguments.from < 0.0) {
    throw Error("--from is " + text(arguments.from) + "; valid is a time in seconds, 0 or later");
  }
  if (!(arguments.to > arguments.from)) {
    throw Error("--to is " + text(arguments.to) + "; valid is a time after --from, which is " +
                text(arguments.from) + " s");
  }
  if (log && (arguments.seed || !arguments.assignments.empty())) {
    throw Error("--seed and --set change a scenario; " + arguments.source +
                " is a log, which is dumped as it was recorded");
  }
}

void write(const DumpArguments& arguments, bool log, std::ostream& out, std::ostream& err) {
  Dump dump(arguments, out);
  if (log) {
    dump_log(arguments, dump, err);
  } else {
    dump_scenario(arguments, dump);
  }
  dump.check_any(arguments.source);
}

/// The file has its name only once it is whole.
void write_to_file(const DumpArguments& arguments, bool log, std::ostream& err) {
  logging::check_not_the_input(arguments.out, arguments.source);
  logging::check_writable_file(arguments.out);
  logging::WholeFile file(arguments.out);
  write(arguments, log, file.stream(), err);
  file.finish();
}

}  // namespace

int run_dump(const DumpArguments& arguments, std::ostream& out, std::ostream& err) {
  const bool log = is_log(arguments.source);
  check(arguments, log);
  runtime::watch_for_interrupt();
  if (log) note_later_run(arguments.source);
  if (arguments.out.empty()) {
    write(arguments, log, out, err);
  } else {
    write_to_file(arguments, log, err);
  }
  return kPassed;
}

}  // namespace surefoot::cli
