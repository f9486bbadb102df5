#pragma once

#include "cli/solve_command.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace surefoot::test {

using Json = nlohmann::json;

inline const cli::SolveArguments kCertified{.file = "", .certify = true};
inline const cli::SolveArguments kExplained{.file = "", .explain = true};
inline const cli::SolveArguments kExplainedAsJson{.file = "", .explain = true, .json = true};

/// Runs the command on a file with these lines.
struct CommandRun {
  explicit CommandRun(const std::string& text, cli::SolveArguments arguments = {}) {
    file = std::filesystem::path(testing::TempDir()) /
           (std::string("solve_command_") +
            testing::UnitTest::GetInstance()->current_test_info()->name() + ".jsonl");
    std::ofstream(file) << text;
    arguments.file = file.string();
    exit_code = cli::run_solve(arguments, out, err);
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

}  // namespace surefoot::test
