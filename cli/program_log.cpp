#include "cli/program_log.hpp"

#include "cli/log_commands.hpp"
#include "cli/program_view.hpp"
#include "cli/python_tools.hpp"
#include "cli/replay_command.hpp"

#include <cstdlib>
#include <iostream>
#include <memory>

namespace surefoot::cli {
namespace {

constexpr const char* kReplayFooter = R"(
Without --verify and --stack it serves a page on this machine that shows the log, and prints its
link; ^C closes it.
--verify runs the controller again from the first tick on: with `estimation: sensors` its estimator,
too, with `estimation: truth` on the logged states. The same build computes the same bits.
--stack asks each tick for itself, on the logged states: it shows what another hierarchy makes of the
same situations, not where it would have walked.

Of a damaged log both go as far as its first gap, behind which no controller can be computed again.

Exit codes: 0 the page was closed, all torques of a whole log are the same, or --stack was answered;
1 a torque is not the same; 2 the input is wrong, or the port not free; 4 the log is not whole, cut
off or damaged anywhere, and all torques that could be compared are the same.

Examples:
  surefoot replay run.mcap
  surefoot replay run.mcap --verify
  surefoot replay run.mcap --stack regular --csv ticks.csv
)";

constexpr const char* kExplainFooter = R"(
What the costs mean stands in docs/solver.md. To have the whole table of one tick, with all rows:
  surefoot dump run.mcap --from 10.42 --to 10.4225 | surefoot solve - --explain

Exit codes: 0 printed, 2 the log can't be read or has no tick at that time.

Example:
  surefoot explain run.mcap --at 10.42
)";

constexpr const char* kInfoFooter = R"(
Exit codes: 0 printed, also of a log that is not whole, which is said; 2 it can't be read.

Example:
  surefoot info run.mcap
)";

constexpr const char* kMendFooter = R"(
Any reader of MCAP opens the new log. The command says what is lost of the old one; the new log does not: let `info`, `explain` and
`replay --verify` read the old one.

Exit codes: 0 written, 2 the log can't be read or the new one not be written.

Example:
  surefoot mend run.mcap.partial --out run.mcap
)";

/// Empty: it is a number.
std::string not_a_time(std::string& text) {
  char* end = nullptr;
  (void)std::strtod(text.c_str(), &end);
  const bool is_number = !text.empty() && *end == '\0';
  return is_number ? "" : "\"" + text + "\" is not a time; a number of seconds is valid";
}

void add_replay(CLI::App& app, Command& chosen) {
  CLI::App* replay =
      app.add_subcommand("replay", "Show a log in a browser, or run its controller again");
  replay->footer(kReplayFooter);
  const auto arguments = std::make_shared<ReplayArguments>();
  replay->add_option("log", arguments->log, "Log of a run (MCAP)")->required();
  replay->add_flag("--verify", arguments->verify,
                   "Say whether every torque is the same to the bit, and where it is not");
  replay->add_option("--stack", arguments->stack,
                     "What another stack (name or file) would have commanded at each tick");
  replay->add_option("--csv", arguments->csv,
                     "With --stack: write torques and residuals of both at each tick");
  replay->add_flag("--json", arguments->json, "Print one JSON object instead of text");
  add_server(*replay, arguments->view);
  replay->callback(
      [&chosen, arguments] { chosen = [arguments] { return run_replay(*arguments, std::cout); }; });
}

void add_explain(CLI::App& app, Command& chosen) {
  CLI::App* explain =
      app.add_subcommand("explain", "Say of one tick of a log what gave way to what");
  explain->footer(kExplainFooter);
  const auto arguments = std::make_shared<ExplainArguments>();
  explain->add_option("log", arguments->log, "Log of a run (MCAP)")->required();
  explain->add_option("--at", arguments->at, "Time of the tick [s]")
      ->required()
      ->check(CLI::Validator(not_a_time, ""));
  explain->add_flag("--json", arguments->json, "Print one JSON object instead of text");
  explain->callback([&chosen, arguments] {
    chosen = [arguments] { return run_explain(*arguments, std::cout); };
  });
}

void add_info(CLI::App& app, Command& chosen) {
  CLI::App* info = app.add_subcommand("info", "Say what is in a log");
  info->footer(kInfoFooter);
  const auto arguments = std::make_shared<InfoArguments>();
  info->add_option("log", arguments->log, "Log of a run (MCAP)")->required();
  info->add_flag("--events", arguments->events, "Also list what happened in the run");
  info->add_flag("--json", arguments->json, "Print one JSON object instead of text");
  info->callback(
      [&chosen, arguments] { chosen = [arguments] { return run_info(*arguments, std::cout); }; });
}

void add_mend(CLI::App& app, Command& chosen) {
  CLI::App* mend = app.add_subcommand(
      "mend", "Write what can be read of a damaged or cut-off log as a whole one");
  mend->footer(kMendFooter);
  const auto arguments = std::make_shared<MendArguments>();
  mend->add_option("log", arguments->log, "Log of a run (MCAP)")->required();
  mend->add_option("--out", arguments->out, "The whole log")->required();
  mend->callback(
      [&chosen, arguments] { chosen = [arguments] { return run_mend(*arguments, std::cout); }; });
}

}  // namespace

void add_log_commands(CLI::App& app, Command& chosen) {
  add_replay(app, chosen);
  add_explain(app, chosen);
  add_info(app, chosen);
  add_mend(app, chosen);
}

void add_python_command(CLI::App& app, Command& chosen, const std::string& name,
                        const std::string& help, const std::string& module,
                        const std::vector<std::string>& first) {
  CLI::App* command = app.add_subcommand(name, help);
  command->prefix_command()->set_help_flag();
  command->callback([&chosen, command, name, module, first] {
    std::vector<std::string> words = first;
    for (const std::string& word : command->remaining()) words.push_back(word);
    chosen = [name, module, words]() -> int { become_python(name, module, words); };
  });
}

}  // namespace surefoot::cli
