#include "app/solve_command.hpp"

#include "surefoot/base/error.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

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
    for (std::string line; !arguments.explain && std::getline(lines, line);) {
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

TEST(SolveCommand, RowsOfLengthsTooDifferentToBeProvenAreTold) {
  const std::string level = R"({"levels":[{"A":[[SIZE,SIZE],[1,0],[0,1]],"b":[SIZE,3,4]}]})";
  const auto with = [&](const std::string& size) {
    return std::regex_replace(level, std::regex("SIZE"), size);
  };
  const CommandRun proven(with("1e3"), {.file = "", .certify = true});
  EXPECT_EQ(proven.exit_code, 0) << proven.err.str();
  const CommandRun run(with("1e12"), {.file = "", .certify = true});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.err.str().find(":1: not proven"), std::string::npos) << run.err.str();
  EXPECT_NEAR(run.results[0]["x"][0].get<double>(), 0.0, 1e-9);
}

TEST(SolveCommand, AnswersBeyondTheRangeOfDoublesAreNamed) {
  const CommandRun run(
      R"({"levels":[{"A":[[1e-90,0]],"b":[1e100]},{"A":[[0,1e-90]],"b":[1e100]}]})");
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(run.results.size(), 1u);
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
  for (const char* part : {"2 wish", "A 1 is 2 too low", "held back by 1 limit",
                           "LF torque, at its upper bound, costs 2 (multiplier 2)"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
  }
}

}  // namespace
}  // namespace surefoot::test
