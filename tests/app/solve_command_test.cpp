#include "app/solve_command.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/solver/sweep.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace surefoot::test {
namespace {

using Json = nlohmann::json;

/// Runs the command on a file with these lines.
struct CommandRun {
  explicit CommandRun(const std::string& text, SolveArguments arguments = {}) {
    file = std::filesystem::path(testing::TempDir()) /
           (std::string("solve_command_") +
            testing::UnitTest::GetInstance()->current_test_info()->name() + ".jsonl");
    std::ofstream(file) << text;
    arguments.file = file.string();
    exit_code = run_solve(arguments, out, err);
    std::filesystem::remove(file);
    std::istringstream lines(out.str());
    for (std::string line; (!arguments.explain || arguments.json) && std::getline(lines, line);) {
      results.push_back(Json::parse(line));
    }
  }
  std::filesystem::path file;
  int exit_code = -1;
  std::ostringstream out, err;
  std::vector<Json> results;
};

TEST(SolveCommand, WritesOneLineForEach) {
  const CommandRun run(
      "{\"levels\":[{\"A\":[[1,0]],\"b\":[1]},{\"A\":[[1,1]],\"b\":[4]}]}\n"
      "\n"
      "{\"levels\":[{\"D\":[[1]],\"f\":[1]},{\"A\":[[1]],\"b\":[3]}]}");
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(run.err.str(), "");
  ASSERT_EQ(run.results.size(), 2u);
  EXPECT_NEAR(run.results[0]["x"][0].get<double>(), 1.0, 1e-12);
  EXPECT_NEAR(run.results[0]["x"][1].get<double>(), 3.0, 1e-12);
  EXPECT_NEAR(run.results[1]["x"][0].get<double>(), 1.0, 1e-12);
  EXPECT_NEAR(run.results[1]["levels"][0]["residual"].get<double>(), 0.0, 1e-12);
  EXPECT_NEAR(run.results[1]["levels"][1]["residual"].get<double>(), 2.0, 1e-12);
}

TEST(SolveCommand, SaysWhichInstructionsTheSolverUses) {
  const std::string line = R"({"levels":[{"A":[[1]],"b":[1]}]})", name = fastest_kernels().name;
  EXPECT_EQ(CommandRun(line).results[0]["instructions"], name);
  EXPECT_EQ(
      CommandRun(line, {.file = "", .explain = true, .json = true}).results[0]["instructions"],
      name);
  const CommandRun text(line, {.file = "", .explain = true});
  EXPECT_NE(text.out.str().find(":1, " + name + " instructions\n"), std::string::npos);
  const CommandRun cascade(line, {.file = "", .method = "cascade"});
  EXPECT_FALSE(cascade.results[0].contains("instructions"));
}

TEST(SolveCommand, TheResidualIsThatOfEqualitiesAndViolatedInequalitiesTogether) {
  const CommandRun run(
      R"({"levels":[{"A":[[1]],"b":[0]},{"A":[[1]],"b":[3],"D":[[1],[-1]],"f":[5,-4]}]})");
  ASSERT_EQ(run.results.size(), 1u);
  EXPECT_NEAR(run.results[0]["levels"][1]["residual"].get<double>(), std::sqrt(9.0 + 16.0), 1e-12);
}

TEST(SolveCommand, ABadLineIsNamedAndTheOthersAreSolved) {
  const CommandRun run(
      "{\"levels\":[{\"A\":[[1]],\"b\":[1]}]}\n"
      "{\"levels\":[{\"A\":[[1]],\"b\":[1,2]}]}\n"
      "{\"levels\":[{\"A\":[[1]],\"b\":[3]}]}\n");
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_EQ(run.results.size(), 2u);
  EXPECT_EQ(run.err.str().find(run.file.string() + ":2: level 1: b has 2 elements"), 0u)
      << run.err.str();
}

TEST(SolveCommand, NumbersBeyondTheRangeOfTheSolverAreNamed) {
  const CommandRun run(R"({"levels":[{"A":[[1e200]],"b":[1]}]})");
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_TRUE(run.results.empty());
  EXPECT_NE(run.err.str().find(":1: level 1: A: row 1: element 1 is 1e+200, too large"),
            std::string::npos)
      << run.err.str();
}

TEST(SolveCommand, OfAnAnswerThatIsNotProvenRowsOfTooDifferentLengthsAreTold) {
  // Long limits that their own level's short rows push beyond their bounds: at 1e8 by too little
  // for the search to see, which ends beside the optimum.
  const std::string levels =
      R"({"levels":[{"D":[[2SIZE,2SIZE,2SIZE],[1SIZE,2SIZE,2SIZE],[1SIZE,-2SIZE,-1SIZE],[0,-2SIZE,1SIZE]],
         "f":[-2SIZE,0,-1SIZE,-1SIZE],"A":[[1,1,1],[0,1,-2]],"b":[0,-2]},
         {"A":[[2,2,-1],[2,1,-2]],"b":[0,-2]}]})";
  const auto with = [&](const std::string& size) {
    const std::string line = std::regex_replace(levels, std::regex("\n *"), "");
    return std::regex_replace(line, std::regex("SIZE"), size);
  };
  const CommandRun proven(with("e3"), {.file = "", .certify = true});
  EXPECT_EQ(proven.exit_code, 0) << proven.err.str();
  EXPECT_EQ(proven.err.str(), "");
  const CommandRun run(with("e8"), {.file = "", .certify = true});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.err.str().find(":1: not proven, distance "), std::string::npos) << run.err.str();
  EXPECT_NE(
      run.err.str().find("rows of one level differ in length by at most 10000, and here by 2e+08"),
      std::string::npos)
      << run.err.str();
}

TEST(SolveCommand, AnAnswerThatWasCutOffIsNotBlamedOnLengthsOfRows) {
  const std::string line =
      R"({"levels":[{"D":[[-2e6,1e6],[0,1]],"f":[3e6,-0.8],"A":[[1,-2]],"b":[-0.7]}]})";
  const CommandRun whole(line, {.file = "", .certify = true});
  EXPECT_EQ(whole.exit_code, 0) << whole.err.str();
  const CommandRun run(line, {.file = "", .certify = true, .budget = 1.0});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.err.str().find(":1: cut off, not optimal, distance "), std::string::npos)
      << run.err.str();
  EXPECT_EQ(run.err.str().find("in length"), std::string::npos) << run.err.str();
}

TEST(SolveCommand, ALimitThatHoldsBackALongRowIsProvenAndNamed) {
  const std::string line =
      R"({"levels":[{"D":[[1,0]],"f":[1]},{"A":[[1e4,0],[0,1]],"b":[10000.01,0]}]})";
  const CommandRun run(line, {.file = "", .certify = true, .explain = true});
  EXPECT_EQ(run.exit_code, 0) << run.err.str();
  EXPECT_NE(run.out.str().find("held back by"), std::string::npos) << run.out.str();
  EXPECT_NE(run.out.str().find("multiplier 100"), std::string::npos) << run.out.str();
}

TEST(SolveCommand, AnswersBeyondTheRangeOfDoublesAreNamed) {
  const std::string overflow =
      R"({"levels":[{"A":[[1e-90,0]],"b":[1e100]},{"A":[[0,1e-90]],"b":[1e100]}]})";
  for (const char* method : {"lexicographic", "cascade"}) {
    const CommandRun run(overflow + "\n" + R"({"levels":[{"A":[[1]],"b":[3]}]})",
                         {.file = "", .certify = true, .method = method});
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_EQ(run.results.size(), 1u);
    EXPECT_NE(run.err.str().find(":1: the answer is beyond the range of doubles"),
              std::string::npos)
        << run.err.str();
  }
}

TEST(SolveCommand, TheReferenceGivesTheSameAnswer) {
  const std::string line =
      R"({"levels":[{"D":[[1,0],[1,1]],"f":[1,1]},{"A":[[1,2]],"b":[4]},{"A":[[1,0],[0,1]],"b":[3,0]}]})";
  const CommandRun ours(line), cascade(line, {.file = "", .method = "cascade"});
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(ours.results.at(0)["x"][i].get<double>(),
                cascade.results.at(0)["x"][i].get<double>(), 1e-12);
  }
}

TEST(SolveCommand, EndsALineAtItsBudgetWithTheLevelsThatAreFinished) {
  const std::string line = R"({"levels":[{"A":[[1,1]],"b":[2]},{"D":[[1,0]],"f":[-3]}]})";
  const CommandRun all(line, {.file = "", .budget = 1e6});
  EXPECT_FALSE(all.results.at(0).contains("status"));
  const CommandRun none(line, {.file = "", .budget = 0.0});
  EXPECT_EQ(none.exit_code, 0);
  EXPECT_EQ(none.results.at(0).at("status"), "iteration_cap");
  EXPECT_NEAR(none.results.at(0)["levels"][0]["residual"].get<double>(), 0.0, 1e-12);
  EXPECT_GT(none.results.at(0)["levels"][1]["residual"].get<double>(), 1.0);
}

TEST(SolveCommand, AMethodThatThereIsNotOrHasNoBudgetIsAnError) {
  EXPECT_THROW(CommandRun("", {.file = "", .method = "simplex"}), Error);
  EXPECT_THROW(CommandRun("", {.file = "", .method = "cascade", .budget = 1.0}), Error);
  EXPECT_THROW(CommandRun("", {.file = "", .budget = -1.0}), Error);
}

TEST(SolveCommand, AFileThatCannotBeReadIsAnError) {
  std::ostringstream out, err;
  EXPECT_THROW((void)run_solve({.file = "/no/such/file.jsonl"}, out, err), FileError);
  EXPECT_THROW((void)run_solve({.file = testing::TempDir()}, out, err), FileError);
  EXPECT_EQ(out.str(), "");
}

const std::string kLimitedWish =
    R"({"levels":[{"name":"limit","D":[[1]],"f":[1],"D_names":["LF torque"]},)"
    R"({"name":"wish","A":[[1]],"b":[3]}]})";

TEST(SolveCommand, CertifiesEachLevel) {
  const CommandRun run(kLimitedWish, {.file = "", .certify = true});
  EXPECT_EQ(run.exit_code, 0);
  ASSERT_EQ(run.results.size(), 1u);
  for (const Json& level : run.results[0]["levels"]) {
    EXPECT_LE(level.at("certificate").get<double>(), 1e-12);
  }
}

TEST(SolveCommand, WithoutBeingAskedCertifiesNothing) {
  const CommandRun run(kLimitedWish);
  EXPECT_FALSE(run.results.at(0)["levels"][0].contains("certificate"));
}

TEST(SolveCommand, ExplainsByNameWhichRowCostALevelHowMuch) {
  const CommandRun run(kLimitedWish, {.file = "", .explain = true});
  EXPECT_EQ(run.exit_code, 0);
  const std::string text = run.out.str();
  for (const char* part :
       {"2 wish", "A 1 is 2 too low", "at a bound: LF torque (upper)",
        "held back by 1 limit, which costs 2: without it the residual would be 0",
        "LF torque, at its upper bound, alone costs 2 (multiplier 2)"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
  }
}

TEST(SolveCommand, ExplainsInTheUnitOfTheLevel) {
  const CommandRun run(R"({"levels":[{"D":[[1]],"f":[1]},{"A":[[1]],"b":[3],"unit":"N"}]})",
                       {.file = "", .explain = true});
  const std::string text = run.out.str();
  for (const char* part : {"A 1 is 2 N too low", "costs 2 N: without it", "alone costs 2 N"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
  }
}

TEST(SolveCommand, ExplainsWithStatusIterationsAndTimeOfEachLevel) {
  const std::string text =
      CommandRun(kLimitedWish, {.file = "", .explain = true, .method = "cascade"}).out.str();
  const std::regex headline("\nstatus: optimal, 1 iteration, [0-9.]+ µs\n");
  EXPECT_TRUE(std::regex_search(text, headline)) << text;
  const std::regex met("\n1 limit +met +0 +1 +1 +0 +1 +0 +[0-9.]+ µs\n");
  EXPECT_TRUE(std::regex_search(text, met)) << text;
  const std::regex missed("\n2 wish +missed +2 +1 +0 +1 +0 +1 +[0-9.]+ µs\n");
  EXPECT_TRUE(std::regex_search(text, missed)) << text;
}

TEST(SolveCommand, ExplainsWithSweepsWhereAllLevelsAreSolvedAtOnce) {
  const std::string text = CommandRun(kLimitedWish, {.file = "", .explain = true}).out.str();
  EXPECT_TRUE(
      std::regex_search(text, std::regex("\nstatus: optimal, [0-9]+ sweeps?, [0-9.]+ µs\n")))
      << text;
  const CommandRun json(kLimitedWish, {.file = "", .explain = true, .json = true});
  EXPECT_GE(json.results.at(0).at("sweeps").get<int>(), 1);
  const Json& line = json.results.at(0);
  double sum = 0.0;
  for (const Json& level : line["levels"]) {
    EXPECT_FALSE(level.contains("iterations"));
    EXPECT_GT(level.at("time_s").get<double>(), 0.0);
    sum += level["time_s"].get<double>();
  }
  EXPECT_LE(sum, line.at("time_s").get<double>() + 1e-9);
}

TEST(SolveCommand, LevelsThatAreSolvedTogetherHaveNoTimeOfTheirOwn) {
  const std::string two_facts =
      R"({"levels":[{"A":[[1,0]],"b":[1]},{"A":[[0,1]],"b":[2]},{"D":[[1,1]],"f":[1]}]})";
  const CommandRun json(two_facts, {.file = "", .explain = true, .json = true});
  const Json& levels = json.results.at(0).at("levels");
  EXPECT_FALSE(levels[0].contains("time_s"));
  EXPECT_FALSE(levels[1].contains("time_s"));
  EXPECT_GT(levels[2].at("time_s").get<double>(), 0.0);
  const std::string text = CommandRun(two_facts, {.file = "", .explain = true}).out.str();
  EXPECT_TRUE(std::regex_search(text, std::regex("\nlevel 1 +met +[^\n]* – +–\n"))) << text;
}

TEST(SolveCommand, SaysWhereNothingAboveHoldsALevelBackOrSeveralDo) {
  const CommandRun alone(R"({"levels":[{"A":[[1],[1]],"b":[1,3]}]})",
                         {.file = "", .explain = true});
  EXPECT_NE(alone.out.str().find("held back by nothing above"), std::string::npos)
      << alone.out.str();
  const CommandRun both(
      R"({"levels":[{"A":[[1]],"b":[1]},{"A":[[1]],"b":[1]},{"A":[[1]],"b":[2]}]})",
      {.file = "", .explain = true});
  EXPECT_NE(both.out.str().find("held back by level 1 and by others"), std::string::npos)
      << both.out.str();
}

TEST(SolveCommand, ExplainsTheSameAsJson) {
  const CommandRun run(
      kLimitedWish,
      {.file = "", .certify = true, .explain = true, .json = true, .method = "cascade"});
  ASSERT_EQ(run.results.size(), 1u);
  const Json& line = run.results[0];
  EXPECT_EQ(line.at("status"), "optimal");
  EXPECT_EQ(line.at("iterations"), 1);
  EXPECT_NEAR(line.at("x").at(0).get<double>(), 1.0, 1e-12);
  const Json &limit = line.at("levels").at(0), &wish = line.at("levels").at(1);
  EXPECT_EQ(limit.at("status"), "met");
  EXPECT_EQ(limit.at("at_bound").at(0).at("row"), "LF torque");
  EXPECT_EQ(wish.at("status"), "missed");
  EXPECT_EQ(wish.at("iterations"), 1);
  EXPECT_NEAR(wish.at("residual").get<double>(), 2.0, 1e-12);
  EXPECT_NEAR(wish.at("missed").at(0).at("by").get<double>(), -2.0, 1e-12);
  EXPECT_LE(wish.at("certificate").get<double>(), 1e-12);
  const Json& by = wish.at("blocked_by").at(0);
  EXPECT_EQ(by.at("level"), 1);
  EXPECT_EQ(by.at("name"), "limit");
  EXPECT_NEAR(by.at("cost").get<double>(), 2.0, 1e-12);
  EXPECT_EQ(by.at("rows").at(0).at("row"), "LF torque");
  EXPECT_NEAR(by.at("rows").at(0).at("multiplier").get<double>(), 2.0, 1e-12);
  EXPECT_GT(line.at("time_s").get<double>(), 0.0);
  EXPECT_LE(limit.at("time_s").get<double>() + wish.at("time_s").get<double>(),
            line.at("time_s").get<double>() + 1e-9);
}

TEST(SolveCommand, ALevelWithoutRowsIsNamedWithItsLineAndAllLinesAreSolved) {
  const CommandRun run(
      "{\"levels\":[{\"A\":[[1]],\"b\":[1]}]}\n"
      "{\"levels\":[{\"A\":[[1]],\"b\":[2]},{\"name\":\"swing\"},{\"D\":[],\"f\":[]}]}\n"
      "{\"levels\":[{\"A\":[[1]],\"b\":[3]}]}\n");
  EXPECT_EQ(run.exit_code, 0);
  ASSERT_EQ(run.results.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(run.results[i]["x"][0].get<double>(), 1.0 + static_cast<double>(i), 1e-12);
  const std::string place = run.file.string() + ":2: note: ";
  EXPECT_EQ(run.err.str(), place + "level 2 (swing) has no rows, so it asks for nothing\n" + place +
                               "level 3 has no rows, so it asks for nothing\n");
  EXPECT_FALSE(run.results[0].contains("notes"));
  EXPECT_EQ(run.results[1].at("notes").size(), 2u);
  EXPECT_EQ(run.results[1].at("notes").at(0),
            "level 2 (swing) has no rows, so it asks for nothing");
}

TEST(SolveCommand, OfManyLevelsWithoutRowsOnlyTheFirstAreToldOutsideOfTheResults) {
  std::string text;
  for (int i = 0; i < 15; ++i) text += "{\"levels\":[{\"A\":[[1]],\"b\":[1]},{}]}\n";
  const CommandRun run(text);
  EXPECT_EQ(std::ranges::count(run.err.str(), '\n'), 11) << run.err.str();
  EXPECT_NE(run.err.str().find("5 more levels without rows"), std::string::npos);
  ASSERT_EQ(run.results.size(), 15u);
  for (const Json& line : run.results) EXPECT_EQ(line.at("notes").size(), 1u);
}

}  // namespace
}  // namespace surefoot::test
