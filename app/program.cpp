#include "app/program.hpp"

#include "app/demo.hpp"
#include "app/exit_code.hpp"
#include "app/list_command.hpp"
#include "app/run_command.hpp"
#include "app/solve_command.hpp"
#include "surefoot/base/build_info.hpp"
#include "surefoot/config/nearest_name.hpp"
#include "surefoot/view/report.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <functional>
#include <iostream>

namespace surefoot {
namespace {

constexpr const char* kFooter = R"(
Exit codes: 0 the scenario's criteria hold, 1 they don't, 2 the input is wrong or the run was
interrupted, 3 the controller stopped for safety.

Examples:
  surefoot run walk_flat                                 once, a table of results
  surefoot run step_down --seeds 100 --jobs 2            success rate over 100 random trials
  surefoot run step_down --set terrain.elements.ground.height=-0.20 --report out
  surefoot list scenarios
)";

/// A command: fills its arguments while parsing, then runs.
using Command = std::function<int()>;

/// Digits only, and not too many of them; CLI11 would take -1 for a large number.
CLI::Validator whole_number(int min) {
  const auto check = [min](std::string& text) -> std::string {
    const bool digits =
        !text.empty() && text.size() < 10 &&
        std::ranges::all_of(text, [](char letter) { return letter >= '0' && letter <= '9'; });
    if (digits && std::stoi(text) >= min) return "";
    return "\"" + text + "\" is not a whole number of at least " + std::to_string(min);
  };
  return CLI::Validator(check, "");
}

void add_run(CLI::App& app, Command& chosen) {
  CLI::App* run = app.add_subcommand("run", "Run a scenario and judge it by its criteria");
  const auto arguments = std::make_shared<RunArguments>();
  run->add_option("scenario", arguments->scenario, "Name of a scenario (see list), or a file")
      ->required();
  run->add_option(
         "--seed", arguments->seed,
         "Seed of what the scenario randomises and of the noise; 0 (default) draws nothing")
      ->check(whole_number(0));
  run->add_option("--seeds", arguments->seeds, "Run this many seeds, from --seed (default 1) on")
      ->check(whole_number(1));
  run->add_option("--jobs", arguments->jobs, "Processes at once")->check(whole_number(1));
  run->add_option("--set", arguments->assignments,
                  "path.to.key=value: change a key of the scenario; may be repeated")
      ->take_all()
      ->expected(1);
  run->add_option("--record", arguments->record, "Write the log to this file (MCAP)");
  run->add_option("--report", arguments->report, "Write an HTML report into this folder");
  run->add_flag("--json", arguments->json, "Print one JSON object instead of a table");
  run->callback([&chosen, arguments] { chosen = [arguments] { return run_command(*arguments); }; });
}

void add_list(CLI::App& app, Command& chosen) {
  CLI::App* list =
      app.add_subcommand("list", "Show what there is: robots, stacks, scenarios or tasks");
  const auto what = std::make_shared<std::string>();
  list->add_option("what", *what, "robots, stacks, scenarios or tasks")
      ->required()
      ->check(CLI::IsMember(listable()));
  list->callback([&chosen, what] { chosen = [what] { return list_command(*what); }; });
}

void add_report(CLI::App& app, Command& chosen) {
  CLI::App* report = app.add_subcommand("report", "Write the HTML report of a log");
  const auto log = std::make_shared<std::string>();
  const auto folder = std::make_shared<std::string>();
  report->add_option("log", *log, "Log of a run (MCAP)")->required();
  report->add_option("--out", *folder, "Folder to write into")->required();
  report->callback([&chosen, log, folder] {
    chosen = [log, folder] {
      std::cout << write_report(*log, *folder) << "\n";
      return static_cast<int>(kPassed);
    };
  });
}

void add_solve(CLI::App& app, Command& chosen) {
  CLI::App* solve = app.add_subcommand("solve", "Solve task hierarchies, one JSON object a line");
  const auto file = std::make_shared<std::string>();
  solve->add_option("file", *file, "JSON lines: {\"levels\":[{\"A\":…,\"b\":…,\"D\":…,\"f\":…},…]}")
      ->required();
  solve->callback(
      [&chosen, file] { chosen = [file] { return run_solve(*file, std::cout, std::cerr); }; });
}

void add_demo(CLI::App& app, Command& chosen) {
  CLI::App* demo =
      app.add_subcommand("demo", "Run the paper's experiments and print them beside its numbers");
  const auto arguments = std::make_shared<DemoArguments>();
  demo->add_option("--out", arguments->out, "Folder for the reports; build/demo by default");
  demo->add_option("--seeds", arguments->seeds, "Seeds of each random experiment")
      ->check(whole_number(1))
      ->capture_default_str();
  demo->add_option("--jobs", arguments->jobs, "Processes at once")
      ->check(whole_number(1))
      ->capture_default_str();
  demo->callback(
      [&chosen, arguments] { chosen = [arguments] { return demo_command(*arguments); }; });
}

int tell(const std::string& message) {
  std::cerr << "surefoot: " << message << "\n";
  return kWrongInput;
}

/// The argument that a command does not know, with those that it does.
std::string unknown_option(const CLI::App& command) {
  std::vector<std::string> valid;
  for (const CLI::Option* option : command.get_options()) valid.push_back(option->get_name());
  const std::vector<std::string> unknown = command.remaining();
  const auto found =
      std::ranges::find_if(unknown, [](const std::string& word) { return word.starts_with('-'); });
  const std::string name = found == unknown.end() ? unknown.front() : *found;
  return "unknown argument \"" + name + "\" of " + command.get_name() + "; " +
         valid_names(name, valid);
}

std::string unknown_command(const CLI::App& app, int argc, char** argv) {
  std::vector<std::string> valid;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    valid.push_back(command->get_name());
  }
  const std::string given = argc > 1 ? argv[1] : "";
  return (given.empty() ? "no command is given" : "unknown command \"" + given + "\"") + "; " +
         valid_names(given, valid);
}

/// Help and version go through CLI11; everything else that is wrong with the arguments is one line.
int tell_parsing(const CLI::App& app, const CLI::ParseError& error, int argc, char** argv) {
  if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) return app.exit(error);
  const std::vector<CLI::App*> commands = app.get_subcommands();
  if (commands.empty()) return tell(unknown_command(app, argc, argv));
  if (!commands.front()->remaining().empty()) return tell(unknown_option(*commands.front()));
  return tell(std::string(error.what()) + "; see surefoot " + commands.front()->get_name() +
              " --help");
}

}  // namespace

int run_program(int argc, char** argv) {
  CLI::App app("Whole-body control of legged robots by strict task hierarchies.", "surefoot");
  app.set_version_flag("--version", std::string(build_info().version));
  app.footer(kFooter);
  app.require_subcommand(1);
  app.set_help_all_flag("--help-all", "Help on all commands");
  Command chosen;
  add_run(app, chosen);
  add_list(app, chosen);
  add_report(app, chosen);
  add_solve(app, chosen);
  add_demo(app, chosen);
  try {
    app.parse(argc, argv);
    return chosen();
  } catch (const CLI::ParseError& error) {
    return tell_parsing(app, error, argc, argv);
  } catch (const std::exception& error) {
    return tell(error.what());
  }
}

}  // namespace surefoot
