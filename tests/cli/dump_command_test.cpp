#include "cli/dump_command.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/closed_loop/closed_loop.hpp"
#include "surefoot/config/hierarchy_json.hpp"
#include "surefoot/config/scenario_file.hpp"
#include "surefoot/solver/cascade_solver.hpp"
#include "tests/logging/temporary_folder.hpp"
#include "tests/support/messages.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <limits>
#include <sstream>

namespace surefoot::cli {
namespace {

using test::holds;

const std::vector<std::string> kShort = {"duration=0.2"};

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::string dump(const DumpArguments& arguments) {
  std::ostringstream out, err;
  EXPECT_EQ(run_dump(arguments, out, err), 0);
  EXPECT_EQ(err.str(), "");
  return out.str();
}

std::string complaint(const DumpArguments& arguments) {
  std::ostringstream out, err;
  const std::string message = test::message_of([&] { (void)run_dump(arguments, out, err); });
  EXPECT_EQ(out.str(), "");
  return message;
}

DumpArguments from_to(double from, double to) {
  DumpArguments arguments;
  arguments.source = "walk_flat";
  arguments.from = from;
  arguments.to = to;
  arguments.assignments = kShort;
  return arguments;
}

TEST(DumpCommand, WritesTheTicksOfTheRangeAsSolveReadsThem) {
  const std::vector<std::string> lines = lines_of(dump(from_to(0.1, 0.125)));
  ASSERT_EQ(lines.size(), 10u);
  for (const std::string& line : lines) {
    const config::NamedHierarchy read = config::parse_hierarchy(line, "line");
    EXPECT_EQ(read.hierarchy.unknowns(), 30);
    EXPECT_EQ(solver::CascadeSolver(read.hierarchy).solve(read.hierarchy).status,
              solver::SolveStatus::optimal);
    EXPECT_FALSE(holds(read.row_names[0][0], "A 1")) << "rows have names";
    EXPECT_EQ(read.units[0], "N and N·m");
    EXPECT_EQ(read.units[2], "N·m");
  }
}

TEST(DumpCommand, OfSeveralTicksOneIsWritten) {
  DumpArguments arguments = from_to(0.1, 0.125);
  const std::vector<std::string> all = lines_of(dump(arguments));
  arguments.every = 4;
  const std::vector<std::string> some = lines_of(dump(arguments));
  ASSERT_EQ(some.size(), 3u);
  EXPECT_EQ(some[1], all[4]);
}

TEST(DumpCommand, AScenarioAndItsLogGiveTheSameLines) {
  const test::TemporaryFolder folder;
  closed_loop::ClosedLoopOptions options;
  options.record_path = folder / "run.mcap";
  (void)closed_loop::run_closed_loop(config::load_scenario({"walk_flat", 0, kShort}), options);
  DumpArguments of_log;
  of_log.source = folder / "run.mcap";
  DumpArguments of_scenario;
  of_scenario.source = "walk_flat";
  of_scenario.assignments = kShort;
  const std::string lines = dump(of_scenario);
  EXPECT_EQ(lines_of(lines).size(), 80u);
  EXPECT_EQ(dump(of_log), lines);
}

TEST(DumpCommand, ALogWithSwitchedLevelsGivesTheLinesOfItsScenario) {
  const std::vector<std::string> switched{
      "duration=0.2", "stack=terrain_adaptation",
      "stack_switches=[{time: 0.1, remove: [torso_yaw], duration: 0.05}]"};
  const test::TemporaryFolder folder;
  closed_loop::ClosedLoopOptions options;
  options.record_path = folder / "run.mcap";
  (void)closed_loop::run_closed_loop(config::load_scenario({"walk_flat", 0, switched}), options);
  DumpArguments of_log;
  of_log.source = folder / "run.mcap";
  DumpArguments of_scenario;
  of_scenario.source = "walk_flat";
  of_scenario.assignments = switched;
  const std::string lines = dump(of_scenario);
  EXPECT_EQ(dump(of_log), lines);
  const auto rows_of_yaw = [&](std::size_t tick) {
    const config::NamedHierarchy read = config::parse_hierarchy(lines_of(lines).at(tick), "line");
    for (std::size_t k = 0; k < read.hierarchy.num_levels(); ++k) {
      if (read.hierarchy.level(k).name() == "torso_yaw") return read.hierarchy.level(k).num_rows();
    }
    return Eigen::Index{-1};
  };
  EXPECT_EQ(rows_of_yaw(39), 1);
  EXPECT_EQ(rows_of_yaw(50), 1) << "of both sides, on the way";
  EXPECT_EQ(rows_of_yaw(65), 0);
}

TEST(DumpCommand, AFileHasItsNameOnlyOnceItIsWhole) {
  const test::TemporaryFolder folder;
  DumpArguments arguments = from_to(0.1, 0.125);
  const std::string lines = dump(arguments);
  arguments.out = folder / "ticks.jsonl";
  EXPECT_EQ(dump(arguments), "");
  EXPECT_EQ(test::contents(arguments.out), lines);
  std::filesystem::remove(arguments.out);
  arguments.from = 5.0, arguments.to = 6.0;
  EXPECT_TRUE(holds(complaint(arguments), "no tick"));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(DumpCommand, WhatIsReadIsNotWrittenOver) {
  const test::TemporaryFolder folder;
  DumpArguments arguments;
  arguments.source = arguments.out = folder / "run.mcap";
  test::write_file(arguments.source, "a run");
  EXPECT_TRUE(holds(complaint(arguments), "the log itself"));
  EXPECT_EQ(test::contents(arguments.source), "a run");
}

TEST(DumpCommand, TellsWhatIsWrongWithTheRange) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(holds(complaint(from_to(5.0, 6.0)), "the last tick is at 0.1975 s"));
  EXPECT_TRUE(holds(complaint(from_to(0.2, 0.1)), "--to is 0.1"));
  EXPECT_TRUE(holds(complaint(from_to(kNone, 0.1)), "--from is nan"));
  EXPECT_TRUE(holds(complaint(from_to(-1.0, 0.1)), "--from is -1"));
  EXPECT_TRUE(holds(complaint(from_to(0.0, kNone)), "--to is nan"));
}

TEST(DumpCommand, TellsWhatIsWrongWithTheSourceAndTheFile) {
  const test::TemporaryFolder folder;
  DumpArguments arguments = from_to(0.0, 0.1);
  arguments.out = folder / "no/such/folder/ticks.jsonl";
  EXPECT_TRUE(holds(complaint(arguments), "ticks.jsonl"));
  arguments = from_to(0.0, 0.1);
  arguments.source = "walk_flatt";
  EXPECT_TRUE(holds(complaint(arguments), "walk_flat"));
  arguments.source = folder / "text.mcap";
  EXPECT_TRUE(holds(complaint(arguments), "is a log")) << "--set is not for logs";
  arguments.assignments.clear();
  EXPECT_TRUE(holds(complaint(arguments), "text.mcap"));
  test::write_file(arguments.source, "no log");
  EXPECT_TRUE(holds(complaint(arguments), "text.mcap"));
}

}  // namespace
}  // namespace surefoot::cli
