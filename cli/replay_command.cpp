#include "cli/replay_command.hpp"

#include "cli/exit_code.hpp"
#include "cli/log_commands.hpp"
#include "cli/replay_text.hpp"
#include "server/log_server.hpp"
#include "surefoot/base/error.hpp"
#include "surefoot/base/printable.hpp"
#include "surefoot/control/asked_stack.hpp"
#include "surefoot/logging/clock_text.hpp"
#include "surefoot/logging/hierarchy_status.hpp"
#include "surefoot/logging/log_reader.hpp"
#include "surefoot/logging/output_files.hpp"
#include "surefoot/logging/whole_file.hpp"
#include "surefoot/replay/replay_json.hpp"
#include "surefoot/runtime/interrupt.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <ostream>

namespace surefoot::cli {
namespace {

void check(const ReplayArguments& arguments) {
  if (arguments.verify && !arguments.stack.empty())
    throw Error("--verify and --stack are two questions; ask one at a time");
  if (!arguments.csv.empty() && arguments.stack.empty())
    throw Error("--csv writes the ticks of --stack, which is not given");
  if (arguments.json && !arguments.verify && arguments.stack.empty())
    throw Error("--json is for --verify and --stack; without them replay serves a page");
  if (server::says_where(arguments.view) && (arguments.verify || !arguments.stack.empty()))
    throw Error(
        "--port, --listen, --token and --view-clients are of the page, which --verify and "
        "--stack don't serve; leave them out");
}

/// Shortest text that reads back to the same double.
std::string shortest(double value) {
  std::array<char, 32> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

/// CSV of both hierarchies' torques and residuals at each tick, with mode and status. Columns have
/// the names of the log's channels, with units; those of the other hierarchy begin with "other.".
class TickTable {
 public:
  explicit TickTable(const std::string& path) : whole_(path), file_(whole_.stream()) {}

  /// `other` is null if it was not asked.
  void add(const logging::LogHeader& header, const TickRecord& logged,
           const control::StackAnswer* other, const std::vector<replay::OtherLevel>& other_levels) {
    if (!has_head_) write_head(header, other_levels);
    has_head_ = true;
    const bool is_answered = other != nullptr && other->is_usable();
    file_ << shortest(logging::to_nanosecond(logged.reading.time));
    origin(logged.command, logged.hierarchy);
    if (other == nullptr)
      file_ << ",,";
    else
      origin(other->command, other->hierarchy);
    for (const double torque : logged.command.torque) number(torque);
    for (Eigen::Index i = 0; i < logged.command.torque.size(); ++i)
      number(is_answered ? other->command.torque[i] : std::nan(""));
    for (std::size_t k = 0; k < header.level_names.size(); ++k)
      number(is_of(logged, k) ? logged.hierarchy.levels[k].residual : std::nan(""));
    for (std::size_t k = 0; k < other_levels.size(); ++k)
      number(is_answered ? logging::computed_residual(other->hierarchy, k) : std::nan(""));
    file_ << '\n';
  }

  void close() { whole_.finish(); }

 private:
  void write_head(const logging::LogHeader& header,
                  const std::vector<replay::OtherLevel>& other_levels) {
    file_ << "time[s]";
    for (const char* side : {"", "other."})
      file_ << ',' << side << "command.mode," << side << "hierarchy.status";
    for (const char* side : {"", "other."})
      for (const std::string& joint : header.robot.joint_names)
        file_ << ',' << side << "command.torque." << joint << "[N·m]";
    for (std::ptrdiff_t k = 0; k < std::ssize(header.level_names); ++k)
      write_level("", {.name = header.level_name(k), .unit = header.level_unit(k)});
    for (const replay::OtherLevel& level : other_levels) write_level("other.", level);
    file_ << '\n';
  }

  void write_level(const char* side, const replay::OtherLevel& level) {
    file_ << ',' << side << "hierarchy.level." << level.name << ".residual";
    if (!level.unit.empty()) file_ << '[' << level.unit << ']';
  }

  static bool is_of(const TickRecord& tick, std::size_t level) {
    return logging::was_used(tick) && static_cast<std::int32_t>(level) < tick.hierarchy.num_levels;
  }

  /// Mode of the command, and status of the solve.
  void origin(const JointCommand& command, const HierarchyReport& hierarchy) {
    file_ << ',' << logged::kModeNames[static_cast<std::size_t>(command.mode)] << ','
          << hierarchy.status;
  }

  /// NaN is an empty cell.
  void number(double value) {
    file_ << ',';
    if (!std::isnan(value)) file_ << shortest(value);
  }

  logging::WholeFile whole_;
  std::ostream& file_;
  bool has_head_ = false;
};

int verify(const ReplayArguments& arguments, std::ostream& out) {
  const replay::Verification result = replay::verify_log(arguments.log);
  if (arguments.json) {
    out << printable(replay::json_of(arguments.log, result)) << std::endl;
  } else {
    out << printable(verification_text(arguments.log, result), "\n") << std::flush;
  }
  if (!result.is_same()) return kFailed;
  return result.is_all() && result.is_whole() ? kPassed : kNotWhole;
}

replay::StackComparison compare(const ReplayArguments& arguments) {
  if (arguments.csv.empty()) return replay::compare_stack(arguments.log, arguments.stack);
  logging::check_not_the_input(arguments.csv, arguments.log);
  logging::check_writable_file(arguments.csv);
  const logging::LogHeader header = logging::LogReader(arguments.log).header();
  TickTable table(arguments.csv);
  const replay::StackComparison result =
      replay::compare_stack(arguments.log, arguments.stack,
                            [&](const TickRecord& logged, const control::StackAnswer* other,
                                const std::vector<replay::OtherLevel>& other_levels) {
                              table.add(header, logged, other, other_levels);
                            });
  table.close();
  return result;
}

}  // namespace

int run_replay(const ReplayArguments& arguments, std::ostream& out) {
  check(arguments);
  runtime::watch_for_interrupt();
  note_later_run(arguments.log);
  if (!arguments.verify && arguments.stack.empty()) {
    server::serve_log(arguments.log, arguments.view);
    return kPassed;
  }
  if (arguments.verify) return verify(arguments, out);
  const replay::StackComparison result = compare(arguments);
  if (arguments.json) {
    out << printable(replay::json_of(arguments.log, result)) << std::endl;
  } else {
    out << printable(comparison_text(arguments.log, result), "\n") << std::flush;
  }
  return kPassed;
}

}  // namespace surefoot::cli
