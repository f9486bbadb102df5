#include "cli/log_commands.hpp"

#include "surefoot/base/printable.hpp"
#include "surefoot/logging/recorder.hpp"
#include "tests/logging/synthetic_run.hpp"
#include "tests/logging/temporary_folder.hpp"
#include "tests/support/messages.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <sstream>
#include <string>

namespace surefoot::cli {
namespace {

using test::holds;

/// With control characters in what `info` and `explain` tell of it.
void record_coloured(const std::string& path) {
  logging::LogHeader header = test::SyntheticRun::header();
  header.description = "\x1b[31mred";
  header.scenario = "back\x1b[1A\xc2\x9b";
  header.notes = {"a note\x1b[2J"};
  header.level_names[8] = "hei\x1b[32mght";
  logging::Recorder recorder(path, header);
  test::SyntheticRun run;
  for (int i = 0; i < 4; ++i) {
    run.step();
    run.tick.hierarchy.levels[8].residual = 5.0;
    recorder.record(run.tick);
  }
  recorder.close("{}");
}

TEST(LogCommands, NamesAndNotesOfALogCannotMoveTheTerminalsCursor) {
  const test::TemporaryFolder folder;
  const std::string path = folder / "run.mcap";
  record_coloured(path);
  for (const bool json : {false, true}) {
    std::ostringstream info, explain;
    InfoArguments of_info;
    of_info.log = path;
    of_info.json = json;
    ASSERT_EQ(run_info(of_info, info), 0);
    ExplainArguments of_explain;
    of_explain.log = path;
    of_explain.at = 0.0;
    of_explain.json = json;
    ASSERT_EQ(run_explain(of_explain, explain), 0);
    for (const std::string& text : {info.str(), explain.str()}) {
      EXPECT_EQ(text, printable(text, "\n"));
      EXPECT_TRUE(holds(text, "back\\u001b[1A\\u009b"));
    }
    EXPECT_TRUE(holds(info.str(), "\\u001b[31mred"));
    EXPECT_TRUE(holds(explain.str(), "hei\\u001b[32mght"));
  }
}

TEST(LogCommands, CostsOfALogWhoseControllerCannotBeMadeAgainAreToldAsEstimates) {
  const test::TemporaryFolder folder;
  logging::Recorder recorder(folder / "run.mcap", test::SyntheticRun::header());
  test::SyntheticRun run;
  run.step();
  run.tick.command.mode = CommandMode::optimal;
  run.tick.hierarchy.status = 0;
  run.tick.hierarchy.transition_share = 1.0;
  run.tick.hierarchy.levels[8].residual = 5.0;
  run.tick.hierarchy.blocking[0] = {
      .level = 8, .by_level = 2, .id = 0, .multiplier = 1.0, .cost = 3.0};
  run.tick.hierarchy.num_blocking = 1;
  recorder.record(run.tick);
  recorder.close("{}");
  ExplainArguments arguments;
  arguments.log = folder / "run.mcap";
  arguments.at = 0.0;
  std::ostringstream text, json;
  ASSERT_EQ(run_explain(arguments, text), 0);
  EXPECT_TRUE(
      holds(text.str(), "The costs are the control loop's estimates, and mostly too high: "));
  arguments.json = true;
  ASSERT_EQ(run_explain(arguments, json), 0);
  const auto told = nlohmann::json::parse(json.str());
  EXPECT_FALSE(told.at("costs_are_exact").get<bool>());
  EXPECT_TRUE(holds(told.at("why_estimates").get<std::string>(), "can't be made again"));
  EXPECT_EQ(told.at("gave_way").at(0).at("to").at(0).at("cost"), 3.0);
}

}  // namespace
}  // namespace surefoot::cli
