#include "app/solve_command.hpp"

#include "app/progress.hpp"
#include "surefoot/base/error.hpp"
#include "surefoot/solver/sweep.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <utility>
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
  EXPECT_NE(run.err.str().find(":1: not proven: level "), std::string::npos) << run.err.str();
  EXPECT_NE(
      run.err.str().find("rows of one level differ in length by at most 10000, and here by 2e+08"),
      std::string::npos)
      << run.err.str();
}

TEST(SolveCommand, OfAnAnswerThatIsNotProvenItTellsWhichLevelByHowMuchAndOfWhatSize) {
  // By 5e-9 of its length the first level's second row is no copy: used by the solvers, too little
  // for the certificate to know of.
  const CommandRun run(R"({"levels":[{"A":[[1,0],[1,5e-9]],"b":[0,1]},{"A":[[0,1]],"b":[0]}]})",
                       {.file = "", .certify = true});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_TRUE(std::regex_search(
      run.err.str(), std::regex(":1: not proven: level 2 is 1 from its optimality "
                                "conditions, relative to .* 1 \\+ ‖x‖ = 2e\\+08; at most 1e-08")))
      << run.err.str();
  EXPECT_EQ(run.err.str().find("not optimal"), std::string::npos);
}

TEST(SolveCommand, AnAnswerThatWasCutOffIsNotBlamedOnLengthsOfRows) {
  const std::string line =
      R"({"levels":[{"D":[[-2e6,1e6],[0,1]],"f":[3e6,-0.8],"A":[[1,-2]],"b":[-0.7]}]})";
  const CommandRun whole(line, {.file = "", .certify = true});
  EXPECT_EQ(whole.exit_code, 0) << whole.err.str();
  const CommandRun run(line, {.file = "", .certify = true, .budget = 1.0});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.err.str().find(":1: not proven, cut off in level 1 of 1; only levels before it"),
            std::string::npos)
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

/// The level in the middle is the one that no budget at all cuts off.
const std::string kCutInTheMiddle =
    R"({"levels":[{"A":[[1,1]],"b":[2]},{"name":"limit","D":[[1,0]],"f":[-3]},)"
    R"({"name":"wish","A":[[0,1]],"b":[1]}]})";

TEST(SolveCommand, OfLevelsThatWereNotFinishedOnlyWhatIsKnownIsTold) {
  const CommandRun run(kCutInTheMiddle, {.file = "", .certify = true, .budget = 0.0});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.err.str().find(":1: not proven, cut off in level 2 of 3"), std::string::npos)
      << run.err.str();
  const Json& levels = run.results.at(0).at("levels");
  EXPECT_FALSE(levels[0].contains("status"));
  EXPECT_TRUE(levels[0].contains("certificate"));
  EXPECT_EQ(levels[1].at("status"), "cut off");
  EXPECT_GT(levels[1].at("residual").get<double>(), 1.0);
  EXPECT_FALSE(levels[1].contains("certificate"));
  EXPECT_EQ(levels[2], Json({{"status", "not reached"}}));
}

TEST(SolveCommand, ExplainsNothingOfLevelsThatWereNotFinished) {
  const SolveArguments text{.file = "", .certify = true, .explain = true, .budget = 0.0};
  SolveArguments json = text;
  json.json = true;
  const CommandRun table(kCutInTheMiddle, text), line(kCutInTheMiddle, json);
  const std::string out = table.out.str();
  EXPECT_NE(out.find("so far: the search ended in this level"), std::string::npos) << out;
  EXPECT_EQ(out.find("held back"), std::string::npos) << out;
  EXPECT_TRUE(std::regex_search(out, std::regex("\n2 limit +cut off +4 ?[^\n]*–\n"))) << out;
  EXPECT_TRUE(std::regex_search(out, std::regex("\n3 wish +not reached +– +1 +– +– +– +– +– +–\n")))
      << out;
  const Json& levels = line.results.at(0).at("levels");
  EXPECT_TRUE(levels[0].contains("blocked_by"));
  EXPECT_EQ(levels[1].at("missed").size(), 1u);
  for (const char* key : {"blocked_by", "certificate", "freedom_left"})
    EXPECT_FALSE(levels[1].contains(key)) << key;
  EXPECT_EQ(levels[2], Json({{"name", "wish"}, {"status", "not reached"}, {"rows", 1}}));
}

TEST(SolveCommand, ABudgetThatSufficesForAllLevelsSaysOptimal) {
  for (const char* line : {R"({"levels":[{"A":[[1,1]],"b":[2]},{"A":[[1,0]],"b":[3]}]})",
                           R"({"levels":[{"A":[[1,0],[0,1]],"b":[1,2]},{"D":[[1,1]],"f":[1]}]})"}) {
    const CommandRun run(line, {.file = "", .certify = true, .budget = 0.0});
    EXPECT_FALSE(run.results.at(0).contains("status")) << line;
    EXPECT_EQ(run.exit_code, 0) << run.err.str();
    EXPECT_EQ(run.err.str(), "");
  }
}

TEST(SolveCommand, ABadLineOfAnyKindLeavesTheOthersSolved) {
  const std::string good = R"({"levels":[{"A":[[1]],"b":[3]}]})";
  const std::vector<std::pair<std::string, std::string>> bad{
      {R"({"levels":[{"D":[[1]],"lowr":[0],"f":[1]}]})", "did you mean \"lower\"?"},
      {R"({"levels":[{"A":[[1]],"A":[[2]],"b":[1]}]})", "the key \"A\" is given twice"},
      {R"({"levels":[{"name":1,"A":[[1]],"b":[1]}]})", "name is 1; expected a text"},
      {R"({"levels":[{"A":[[1],[1]],"b":[1,2],"A_ids":[3,3]}]})", "another row of the level has"},
      {R"({"levels":[{"A":[[1e-300]],"b":[1]}]})", "level 1: A: row 1: has nothing larger than"},
      {R"({"levels":[{"D":[[1]]}]})", "level 1: D has 1 row and no f"}};
  for (const auto& [line, message] : bad) {
    const CommandRun run(good + "\n" + line + "\n" + good + "\n");
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_EQ(run.results.size(), 2u);
    EXPECT_EQ(std::ranges::count(run.err.str(), '\n'), 1);
    EXPECT_EQ(run.err.str().find(run.file.string() + ":2: "), 0u) << run.err.str();
    EXPECT_NE(run.err.str().find(message), std::string::npos) << run.err.str();
  }
}

TEST(SolveCommand, AFileWithoutALineIsAnError) {
  for (const char* text : {"", "\n \n"}) {
    try {
      const CommandRun run(text);
      FAIL() << "an empty file passed";
    } catch (const FileError& error) {
      EXPECT_NE(std::string(error.what()).find("is empty; expected a file with one JSON object"),
                std::string::npos)
          << error.what();
    }
  }
}

TEST(SolveCommand, NumbersAtTheEndsOfWhatIsAcceptedAreSolved) {
  const std::string lines =
      R"({"levels":[{"A":[[1e100]],"b":[-1e100]}]})"
      "\n"
      R"({"levels":[{"A":[[1e-100]],"b":[3e-100]}]})"
      "\n"
      R"({"levels":[{"D":[[1]],"lower":[-1e100],"f":[1e100]},{"A":[[1]],"b":[2]}]})";
  for (const char* method : {"lexicographic", "cascade"}) {
    const CommandRun run(lines, {.file = "", .certify = true, .method = method});
    EXPECT_EQ(run.exit_code, 0) << run.err.str();
    ASSERT_EQ(run.results.size(), 3u);
    EXPECT_NEAR(run.results[0]["x"][0].get<double>(), -1.0, 1e-12);
    EXPECT_NEAR(run.results[1]["x"][0].get<double>(), 3.0, 1e-12);
    EXPECT_NEAR(run.results[2]["x"][0].get<double>(), 2.0, 1e-12);
  }
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

TEST(SolveCommand, ALimitThatIsGivenTwiceIsToldOnceWithWhatBothCost) {
  const std::string line =
      R"({"levels":[{"D":[[1],[2]],"f":[1,2]},{"D":[[1]],"f":[1]},{"A":[[1]],"b":[3]}]})";
  const std::string text = CommandRun(line, {.file = "", .explain = true}).out.str();
  EXPECT_NE(
      text.find("D 1, at its upper bound, with D 2 and D 1 of level 2, which say the same, costs 2 "
                "(multiplier 2)\n"),
      std::string::npos)
      << text;
  EXPECT_EQ(text.find("alone costs"), std::string::npos) << text;
  const CommandRun json(line, {.file = "", .explain = true, .json = true});
  const Json& row = json.results.at(0)["levels"][2]["blocked_by"][0]["rows"][0];
  EXPECT_EQ(row.at("same"), Json({"D 2", "D 1 of level 2"}));
  EXPECT_NEAR(row.at("cost").get<double>(), 2.0, 1e-12);
  EXPECT_FALSE(CommandRun(kLimitedWish, {.file = "", .explain = true, .json = true})
                   .results.at(0)["levels"][1]["blocked_by"][0]["rows"][0]
                   .contains("same"));
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

/// Nothing that a terminal would obey, but for the ends of lines.
bool is_harmless(const std::string& text) {
  const auto is_control = [](char c) {
    const auto code = static_cast<unsigned char>(c);
    return (code < 0x20 && c != '\n') || code == 0x7f;
  };
  return std::ranges::none_of(text, is_control) && text.find("\xc2\x9b") == std::string::npos;
}

TEST(SolveCommand, ControlCharactersInNamesAreWrittenOutWhereverTheyAreTold) {
  const std::string odd = "\\u001b[31m\u007f\u009b1m\\ttab\\n";
  const std::string named = R"("name":")" + odd + R"(","unit":")" + odd + R"(")";
  const std::string line = "{\"levels\":[{" + named + R"(,"D":[[1],[0]],"f":[1,0],"D_names":[")" +
                           odd + R"(","b"]},{)" + named + R"(,"A":[[1]],"b":[3],"A_names":[")" +
                           odd + "\"]},{" + named + "}]}";
  for (const bool is_text : {false, true}) {
    for (const bool is_explained : {false, true}) {
      const CommandRun run(
          line, {.file = "", .certify = true, .explain = is_explained, .json = !is_text});
      EXPECT_EQ(run.exit_code, 0) << run.err.str();
      EXPECT_TRUE(is_harmless(run.out.str())) << run.out.str();
      EXPECT_TRUE(is_harmless(run.err.str())) << run.err.str();
      EXPECT_NE(run.err.str().find("level 3 (\\u001b[31m\\u007f\\u009b1m\\u0009tab\\u000a) has"),
                std::string::npos)
          << run.err.str();
    }
  }
  const CommandRun json(line, {.file = "", .explain = true, .json = true});
  EXPECT_EQ(json.results.at(0)["levels"][0]["name"],
            "\x1b[31m\x7f\xc2\x9b"
            "1m\ttab\n");
  const CommandRun text(line, {.file = "", .explain = true});
  EXPECT_NE(text.out.str().find("2 \\u001b[31m\\u007f\\u009b1m"), std::string::npos)
      << text.out.str();
}

TEST(SolveCommand, ControlCharactersInWhatIsWrongAreWrittenOut) {
  for (const std::string& line : std::vector<std::string>{
           R"({"levels":[{"\u001b[31m":1,"A":[[1]],"b":[1]}]})",
           "{\"levels\":[{\"\x7f\":1,\"A\":[[1]],\"b\":[1]}]}",
           R"({"levels":[{"\u001b":1,"\u001b":2}]})",
           "{\"levels\":[{\"A\":[[1]],\"b\":[\"\xc2\x9b\"]}]}", "{\"levels\":[{\"A\":\x7f}]}",
           R"({"levels":[{"name":"\u001b[31m","A":[["\u001b"]],"b":[1]}]})"}) {
    const CommandRun run(line);
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_TRUE(is_harmless(run.err.str())) << run.err.str();
    EXPECT_NE(run.err.str().find("\\u00"), std::string::npos) << run.err.str();
  }
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

TEST(SolveCommand, WeightsDampingAndAReferenceAreThoseOfTheLine) {
  const CommandRun run(
      R"({"levels":[{"A":[[1,0],[1,0]],"b":[0,4],"A_weights":[1,3],"damping":2}],"x_ref":[1,5]})",
      {.file = "", .certify = true});
  EXPECT_EQ(run.exit_code, 0) << run.err.str();
  ASSERT_EQ(run.results.size(), 1u);
  // x₁² + (3 x₁ − 12)² + 4 (x₁ − 1)² is least at 40 / 14.
  const double x = 40.0 / 14.0;
  EXPECT_NEAR(run.results[0]["x"][0].get<double>(), x, 1e-12);
  EXPECT_NEAR(run.results[0]["x"][1].get<double>(), 5.0, 1e-12);
  const Json& levels = run.results[0]["levels"];
  ASSERT_EQ(levels.size(), 2u);
  EXPECT_NEAR(levels[0]["residual"].get<double>(),
              std::sqrt(x * x + std::pow(3 * x - 12, 2) + 4 * std::pow(x - 1, 2)), 1e-12);
  EXPECT_NEAR(levels[1]["residual"].get<double>(), x - 1.0, 1e-12);
}

TEST(SolveCommand, EndsALineAtItsBudgetOfMicroseconds) {
  const std::string line = R"({"levels":[{"D":[[1,0]],"f":[-1]},{"D":[[0,1]],"f":[-2]}]})";
  const CommandRun run(line, {.file = "", .budget_us = 0.0});
  EXPECT_EQ(run.exit_code, 0) << run.err.str();
  EXPECT_EQ(run.results[0]["status"], "iteration_cap");
  const CommandRun whole(line, {.file = "", .budget_us = 1e9});
  EXPECT_FALSE(whole.results[0].contains("status"));
  EXPECT_NEAR(whole.results[0]["x"][1].get<double>(), -2.0, 1e-12);
  for (const SolveArguments& wrong :
       {SolveArguments{.file = "", .budget_us = -1.0},
        SolveArguments{.file = "", .method = "cascade", .budget_us = 1.0}})
    EXPECT_THROW(CommandRun(line, wrong), Error);
}

TEST(SolveCommand, OfNearlyDependentRowsItSaysThatMultipliersSayLittle) {
  const std::string line = R"({"levels":[{"A":[[1,0],[1,1e-9]],"b":[0,0]},{"A":[[0,1]],"b":[1]}]})";
  const CommandRun run(line, {.file = "", .explain = true});
  EXPECT_NE(run.out.str().find("nearly dependent on others that hold, only 1e-09 of its length"),
            std::string::npos)
      << run.out.str();
  const CommandRun json(line, {.file = "", .explain = true, .json = true});
  const Json& rows = json.results[0]["levels"][1]["blocked_by"][0]["rows"];
  ASSERT_EQ(rows.size(), 2u);
  for (const Json& row : rows) EXPECT_NEAR(row["independence"].get<double>(), 1e-9, 1e-14);
  const CommandRun other(R"({"levels":[{"D":[[0,1]],"f":[0]},{"A":[[0,1]],"b":[1]}]})",
                         {.file = "", .explain = true});
  EXPECT_EQ(other.out.str().find("nearly dependent"), std::string::npos) << other.out.str();
}

/// The first line that goes to stderr while `Something` lives; waits for it.
template <typename Something>
std::string first_line_while(Something make) {
  std::array<int, 2> ends{};
  EXPECT_EQ(pipe(ends.data()), 0);
  const int before = dup(STDERR_FILENO);
  dup2(ends[1], STDERR_FILENO);
  std::string line;
  {
    const auto something = make();
    for (char letter = 0; letter != '\n' && read(ends[0], &letter, 1) == 1;) line += letter;
  }
  dup2(before, STDERR_FILENO);
  for (const int end : {before, ends[0], ends[1]}) close(end);
  return line;
}

TEST(SolveCommand, WhatTakesLongSaysThatItGoesOn) {
  const auto line =
      first_line_while([] { return Waiting("solving a.jsonl:1", std::chrono::milliseconds(1)); });
  EXPECT_TRUE(std::regex_match(line, std::regex("solving a\\.jsonl:1: [0-9]+ s\n"))) << line;
}

}  // namespace
}  // namespace surefoot::test
