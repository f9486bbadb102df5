#include "cli/program.hpp"

#include "cli/doctor_command.hpp"
#include "cli/dump_command.hpp"
#include "cli/exit_code.hpp"
#include "cli/list_command.hpp"
#include "cli/log_commands.hpp"
#include "cli/program_log.hpp"
#include "cli/program_view.hpp"
#include "cli/run_command.hpp"
#include "cli/solve_command.hpp"
#include "surefoot/base/build_info.hpp"
#include "surefoot/base/nearest_name.hpp"
#include "surefoot/base/printable.hpp"
#include "surefoot/doctor/diagnosis.hpp"
#include "surefoot/solver/sweep.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <iostream>

namespace surefoot::cli {
namespace {

constexpr const char* kFooter = R"(
Exit codes: 0 all is as it should be, 1 a result is not, 2 the input is wrong or the run was
interrupted; run has 3 and 4, too. `surefoot COMMAND --help` says more.

Examples:
  surefoot list scenarios
  surefoot list gaits
  surefoot run walk_flat
  surefoot demo
)";

constexpr const char* kRunFooter = R"(
Exit codes: 0 enough runs meet the scenario's criteria, 1 they don't, 2 the input is wrong or the
run was interrupted, 3 they don't, and the controller stopped for safety before the robot fell, 4
they are not judged: with a shorter --set duration= the run ends before it can meet them.
Enough is the scenario's success_rate, of one run as of --seeds: all, where it names none. Scenarios
that show what happens, as found, have success_rate 0: they end with 0 even if the robot falls.

Examples:
  surefoot run walk_flat                                 once, a table of results
  surefoot run step_down --seeds 100 --jobs 2            success rate over 100 random trials
  surefoot run step_down --set terrain.elements.ground.height=-0.17 --report out
  surefoot run my_scenario.yaml --record run.mcap        a file of your own, and its log
  surefoot run step_down --seed 3 --view                 watch and steer it in a browser
)";

constexpr const char* kSolveFooter = R"(
The answer to a line, residual = √(‖A x − b‖² + ‖max(0, D x − f)‖²) of each level:
  {"x":[…],"levels":[{"residual":…},…],"instructions":…,"line":…}
"instructions" is the set that the solver's kernels use on this processor; the cascade has none.
"line" is the number of the line in the file: one that is wrong has no answer, only its error.
Levels may have a "name" and a "unit", their rows "A_names" and "D_names", which --explain shows,
and D a "lower" beside f or alone: lower ≤ D x ≤ f, where null is no bound, and a row with none at
all is switched off; "A_ids" and "D_ids" are the
numbers by which `surefoot dump` knows rows. "A_weights" and "D_weights" multiply each row and its
bounds: residuals, costs and proofs are of the weighted row, and of what it misses --explain shows the
weight. A level's "damping" d adds the rows d E (x - x_ref) = 0, E an orthonormal basis of its rows'
span, of limits that are met too: levels below can't move what any of its rows has. "x_ref" next to "levels" (0 without) is
what x is to be close to where the levels leave it open: a last level, shown as such.
  {"levels":[{"A":[[1,1]],"b":[2],"A_weights":[10],"damping":0.01}],"x_ref":[3,0]}
Other members are an error.
Numbers go from -1e100 to 1e100, which are bounds, too: only null is none. A row of A or D is zero or
has an element of at least 1e-100, either way.
A level without rows asks for nothing: it is named, and the line is solved.

--explain: a cost is what the level's residual would fall by without that row alone, or without all
rows of that level, while everything else above keeps what it has and no limit is violated more. Of
limits that contradict each other one stops the level, and one that wants the same stops nothing (with
--json "would_gain"). Rows that say the same (one limit given twice) are listed once, with --json as
"same", by level and row, and the numbers are of all of them together. A multiplier is how fast half the squared residual falls as the row's bound gives way; of a row that is
nearly dependent on others that hold it says little. With --json it is one object a line, where
"independence" is what of the row's length no other of them has, and null a cost that could not be
solved for. For each cost the level is solved again: 111 unknowns and 160 costs take 0.4 s, twice as
many of both more than ten times as long; after a while it says on stderr how far it is, as a long solve says that it goes on.

--certify: each level has a "certificate", how far it is from its optimality conditions, and a
"verdict": proven, not proven (above 1e-8), or not judged: as far as doubles can tell it is at its
optimum, but by exact arithmetic something could be gained, because ranks are borderline, x is too
large or rows of a level differ too much in length. stderr says which. A level below one that is not
proven is not proven either: "rests_on" is that level's number.

--weighted 3 --weights 10,1: levels 1 and 2 stay strict, 3 and all below become one, "weighted", with
residuals and proofs of the weighted rows; "x_ref" stays the last. "strict_residuals" (with --explain: only with
--json) has for comparison what the weighted x leaves of each level of the line, "x_ref" last, without --weights but
with A_weights and D_weights.

"borderline": true says that which answer is the optimum depends on less than doubles can tell, and x is
the better one of those that were found.

"flops" is what a line has counted against --budget; without one, what a budget has to be for it.
A line whose search ended at its --budget or --budget-us, or at the solver's own cap of iterations,
which is very rare, has "status": "iteration_cap" and "cut_off_by": "budget" or "cap",
the level where it ended "status": "cut off" and the residual so far, those below "status": "not reached"
and no number.

Exit codes: 0 all lines are solved, as far as their budget goes, 1 an answer was cut off by the solver's
own cap, or with --certify one is not proven, not judged or was cut off before there was one, 2 a line is wrong (the others are still solved) or there is none.

Examples:
  surefoot solve hierarchies.jsonl
  surefoot solve hierarchies.jsonl --explain
  surefoot solve hierarchies.jsonl --explain --json
)";

constexpr const char* kDumpFooter = R"(
One line for each tick, as `surefoot solve` reads it, A x = b and lower ≤ D x ≤ f (null: no bound)
with the names of levels and rows, and the numbers by which rows are known from tick to tick:
  {"levels":[{"name":…,"A":[[…]],"b":[…],"D":[[…]],"lower":[…],"f":[…],
              "A_names":[…],"D_names":[…],"A_ids":[…],"D_ids":[…]},…]}
A scenario is run for it; of a log the controller is run again on the logged readings. A tick of the
walk has about 30 kB.
Without --from and --to it is the whole run, which begins with a stand, and from sensors with a
calibration on the spot: the first foot is lifted 10.5 s into walk_flat and most scenarios, 1.5 s into
walk_flat_sea and walk_flat_ideal, which know their state. Of a log `surefoot explain RUN.mcap --at TIME`
lists the steps within a second of that time.

Exit codes: 0 written, 2 the input is wrong, no tick lies between --from and --to, or the dump was
interrupted (then no file is left).

Examples:
  surefoot dump walk_flat_sea --from 10 --to 12 --every 10 --out walk.jsonl
  surefoot dump run.mcap --from 3.2 --to 3.21 | surefoot solve - --explain
)";

constexpr const char* kListFooter = R"(
Examples:
  surefoot list scenarios
  surefoot list gaits
  surefoot list tasks                                    with parameters, defaults and units
  surefoot list tasks --robot go1                        the same with the defaults of another robot
  surefoot list metrics                                  what a run is measured by: unit, which way is better
  surefoot list randomisations                           what randomise.include=NAME draws
  surefoot list options planner.swing                    keys of a scenario with default, range and help
  surefoot list schema scenario > scenario.schema.json   for editors: scenario, randomisation, robot, stack or gait
)";

constexpr const char* kDoctorFooter = R"(
It finds base, limbs, legs (four or six limbs of three hinges, or two that stand on flat feet),
arms and feet by how the links are connected, whatever their names are. It checks masses, inertias,
units, limits, symmetry, signs and the stance, and compares the controller's model with the
physics'. A finding has a severity, how sure it is, its place and what to do. What the description
can't tell stands in the robot file as a comment, or as a guess that is called one.

--out FILE.yaml writes the robot file, and FILE.svg, a picture with names and axes. A robot file
that exists is never written over.

--walk stands for 4 s, walks (walk_flat) and goes down a step (step_down), in simulation; two legs
stand, squat and are pushed (flat_feet). Guesses stand in for what is missing, and are told.

Exit codes: 0 no error is found, 1 a trial does not succeed, 2 there are errors, or the input
can't be read.

Examples:
  surefoot doctor robot.urdf
  surefoot doctor robot.urdf --out robot.yaml --walk
  surefoot doctor package://my_robot/urdf/robot.urdf --json
)";

// Each seed has its results in memory, each job is a process.
constexpr int kMaxSeeds = 1'000'000, kMaxJobs = 1000;

/// An empty name would count as none.
CLI::Validator some_name() {
  return CLI::Validator(
      [](std::string& name) { return std::string(name.empty() ? "the name is empty" : ""); }, "");
}

CLI::Validator robot_name() {
  return CLI::Validator(
      [](std::string& name) {
        if (doctor::is_robot_name(name)) return std::string();
        return "\"" + name +
               "\" is no robot's name; valid are letters, digits, \"_\", \"-\" and \".\", a letter "
               "or digit first";
      },
      "");
}

void add_run(CLI::App& app, Command& chosen) {
  CLI::App* run = app.add_subcommand("run", "Run a scenario and judge it by its criteria");
  run->footer(kRunFooter);
  const auto arguments = std::make_shared<RunArguments>();
  run->add_option("scenario", arguments->scenario, "Name of a scenario (see list), or a file")
      ->required();
  run->add_option("--seed", arguments->seed,
                  "Seed of what the scenario randomises and of the noise, 0 to " +
                      std::to_string(config::kLargestSeed) +
                      "; 0 (default): nothing is randomised but the noise")
      ->check(seed_number());
  run->add_option("--seeds", arguments->seeds, "Run this many seeds, from --seed (default 1) on")
      ->check(whole_number(1, kMaxSeeds));
  run->add_option("--jobs", arguments->jobs, "Processes at once")->check(whole_number(1, kMaxJobs));
  run->add_option("--set", arguments->assignments,
                  "path.to.key=value …: change keys of the scenario; none takes one away. Several "
                  "behind one --set, or each with its own; the scenario's name stands before it")
      ->take_all()
      ->expected(1);
  run->add_option("--record", arguments->record, "Write the log to this file (MCAP)")
      ->check(some_name());
  run->add_option("--report", arguments->report,
                  "Write an HTML report into this folder, and its log unless --record keeps it")
      ->check(some_name());
  run->add_flag("--no-pictures", arguments->no_pictures,
                "Leave strip and clip out of the report, which take seconds");
  run->add_option("--video", arguments->video,
                  "Film the run into this file (MP4), as `surefoot video` does of its log")
      ->check(some_name());
  run->add_flag("--check", arguments->check,
                "Read the scenario, stand the robot up and say what is wrong, and what a run would "
                "take; no run");
  run->add_flag("--all", arguments->all, "Print all metrics, not the ten that matter most");
  run->add_flag("--json", arguments->json, "Print one JSON object instead of a table");
  add_view(*run, arguments->view);
  run->callback([&chosen, arguments] { chosen = [arguments] { return run_command(*arguments); }; });
}

void add_list(CLI::App& app, Command& chosen) {
  std::string all;
  for (const std::string& kind : listable()) all += (all.empty() ? "" : ", ") + kind;
  CLI::App* list = app.add_subcommand("list", "Show what there is: " + all);
  list->footer(kListFooter);
  const auto what = std::make_shared<std::string>();
  const auto filter = std::make_shared<ListFilter>();
  list->add_option("what", *what, all);
  list->add_option("about", filter->about,
                   "How keys of options begin; or the kind of file that a schema is of");
  list->add_flag("--json", filter->json, "Print options or metrics as JSON");
  list->add_option("--robot", filter->robot, "Whose defaults options and tasks have")
      ->capture_default_str();
  list->callback([&chosen, what, filter] {
    chosen = [what, filter] { return list_command(*what, *filter); };
  });
}

void add_doctor(CLI::App& app, Command& chosen) {
  CLI::App* doctor =
      app.add_subcommand("doctor", "Examine a URDF or MJCF and make the robot file of it");
  doctor->footer(kDoctorFooter);
  const auto arguments = std::make_shared<DoctorArguments>();
  doctor
      ->add_option("description", arguments->urdf,
                   "URDF or MJCF: a file, a package:// name, or the name of a robot that ships")
      ->required();
  doctor
      ->add_option("--out", arguments->out,
                   "Write the robot file here (.yaml), beside it its picture and, with --walk, the "
                   "report and a log of each trial that fails")
      ->check(some_name());
  doctor->add_option("--name", arguments->name, "Of the robot; the description's by default")
      ->check(robot_name());
  doctor->add_flag("--walk", arguments->walk, "Let it stand, walk and step down, in simulation");
  doctor->add_flag("--json", arguments->json, "Print one JSON object instead of a report");
  doctor->callback(
      [&chosen, arguments] { chosen = [arguments] { return doctor_command(*arguments); }; });
}

void add_solve(CLI::App& app, Command& chosen) {
  CLI::App* solve = app.add_subcommand("solve", "Solve task hierarchies, one JSON object a line");
  solve->footer(kSolveFooter);
  const auto arguments = std::make_shared<SolveArguments>();
  solve
      ->add_option(
          "file", arguments->file,
          "JSON lines: {\"levels\":[{\"A\":…,\"b\":…,\"D\":…,\"f\":…},…]}; - reads standard input")
      ->required();
  solve->add_flag("--certify", arguments->certify,
                  "Check each answer against the optimality conditions, without the solver");
  solve->add_flag(
      "--explain", arguments->explain,
      "Tables instead of JSON: what each level missed, and which rows above cost it how much");
  solve->add_flag("--json", arguments->json,
                  "One JSON object a line, which is the default, also with --explain");
  solve->add_option("--method", arguments->method,
                    "lexicographic (default), the controller's solver, or cascade, the reference; "
                    "where the levels leave x open, its x is longer than the shortest");
  solve->add_option(
      "--budget", arguments->budget,
      "Additions and multiplications after which the search of a line ends: the levels "
      "that are finished then are optimal");
  solve->add_option("--budget-us", arguments->budget_us,
                    "The same in microseconds of this machine, so no two runs need end alike");
  solve->add_option("--weighted", arguments->weighted_from,
                    "The levels from this one on, counted from 1, as one weighted level instead of "
                    "in strict order");
  solve
      ->add_option("--weights", arguments->weights,
                   "Of these levels, with commas: each row counts so many times; 1 without")
      ->delimiter(',');
  solve->callback([&chosen, arguments] {
    chosen = [arguments] { return run_solve(*arguments, std::cout, std::cerr); };
  });
}

void add_dump(CLI::App& app, Command& chosen) {
  CLI::App* dump =
      app.add_subcommand("dump", "Write the hierarchies of a run, one JSON object a line");
  dump->footer(kDumpFooter);
  const auto arguments = std::make_shared<DumpArguments>();
  dump->add_option("source", arguments->source, "Scenario (name or file), or log of a run (MCAP)")
      ->required();
  dump->add_option("--from", arguments->from, "First time [s]; 0 by default");
  dump->add_option("--to", arguments->to,
                   "Time before which it ends [s]; by default the run's end");
  dump->add_option("--every", arguments->every, "Of this many ticks, write one; 1 by default")
      ->check(whole_number(1));
  dump->add_option("--out", arguments->out, "File to write; standard output by default")
      ->check(some_name());
  dump->add_option("--seed", arguments->seed,
                   "Seed of a scenario, 0 to " + std::to_string(config::kLargestSeed) +
                       "; 0 (default) draws nothing")
      ->check(seed_number());
  dump->add_option("--set", arguments->assignments,
                   "path.to.key=value …: change keys of a scenario, whose name stands before it")
      ->take_all()
      ->expected(1);
  dump->callback([&chosen, arguments] {
    chosen = [arguments] { return run_dump(*arguments, std::cout, std::cerr); };
  });
}

int fail(const std::string& message) {
  std::cerr << "surefoot: " << printable(message, "\n") << "\n";
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
  const bool is_assignment = name.find('=') != std::string::npos && !name.starts_with('-');
  if (is_assignment && command.get_option_no_throw("--set") != nullptr)
    return "unknown argument \"" + name + "\" of " + command.get_name() + "; did you mean --set " +
           name + "?";
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
int fail_parsing(const CLI::App& app, const CLI::ParseError& error, int argc, char** argv) {
  if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) return app.exit(error);
  const std::vector<CLI::App*> commands = app.get_subcommands();
  if (commands.empty()) return fail(unknown_command(app, argc, argv));
  if (!commands.front()->remaining().empty()) return fail(unknown_option(*commands.front()));
  return fail(std::string(error.what()) + "; see surefoot " + commands.front()->get_name() +
              " --help");
}

}  // namespace

int run_program(int argc, char** argv) {
  CLI::App app("Whole-body control of legged robots by strict task hierarchies.", "surefoot");
  app.set_version_flag("--version", std::string(build_info().version) + " (solver: " +
                                        solver::fastest_kernels().name + " instructions)");
  app.require_subcommand(1);
  app.set_help_all_flag("--help-all", "Help on all commands");
  Command chosen;
  add_run(app, chosen);
  add_doctor(app, chosen);
  add_list(app, chosen);
  add_solve(app, chosen);
  add_dump(app, chosen);
  add_log_commands(app, chosen);
  add_python_command(app, chosen, "demo",
                     "Run the paper's experiments and print them beside its numbers",
                     "surefoot_campaign.demo");
  add_python_command(app, chosen, "report", "Write the HTML report of a log, with its figures",
                     "surefoot_report");
  add_python_command(app, chosen, "export",
                     "Write a log as CSV or Parquet, or its scene for Foxglove", "surefoot_log",
                     {"export"});
  add_python_command(app, chosen, "video", "Film a log, without a screen", "surefoot_log",
                     {"video"});
  add_python_command(app, chosen, "campaign",
                     "Run a grid of parameters over many seeds: table, rates, plots",
                     "surefoot_campaign");
  app.footer(kFooter);  // only now: commands that are added later would have it, too
  try {
    app.parse(argc, argv);
    return chosen();
  } catch (const CLI::ParseError& error) {
    return fail_parsing(app, error, argc, argv);
  } catch (const std::exception& error) {
    return fail(error.what());
  }
}

}  // namespace surefoot::cli
