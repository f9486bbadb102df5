#include "app/solve_command.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/config/hierarchy_json.hpp"
#include "surefoot/solver/cascade_solver.hpp"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <iostream>

namespace surefoot {
namespace {

using Json = nlohmann::ordered_json;

std::string format_solution(const Solution& solution, std::size_t num_levels) {
  Json levels = Json::array();
  for (std::size_t k = 0; k < num_levels; ++k) {
    levels.push_back({{"residual", solution.levels[k].residual}});
  }
  const std::vector<double> x(solution.x.data(), solution.x.data() + solution.x.size());
  Json line = {{"x", x}, {"levels", std::move(levels)}};
  if (solution.status == SolveStatus::iteration_cap) line["status"] = "iteration_cap";
  return line.dump();
}

std::string solve_line(const std::string& line, const std::string& place) {
  const Hierarchy hierarchy = parse_hierarchy(line, place);
  CascadeSolver solver(hierarchy);
  const Solution& solution = solver.solve(hierarchy);
  if (solution.status == SolveStatus::invalid_input) {
    throw FileError(place + ": numbers too large to compute with; expected at most about 1e100");
  }
  return format_solution(solution, hierarchy.num_levels());
}

int solve_lines(std::istream& input, const std::string& name, std::ostream& out,
                std::ostream& err) {
  int exit_code = 0;
  std::string line;
  for (int number = 1; std::getline(input, line); ++number) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    try {
      out << solve_line(line, name + ":" + std::to_string(number)) << '\n' << std::flush;
    } catch (const FileError& error) {
      err << error.what() << '\n';
      exit_code = 2;
    }
  }
  return exit_code;
}

}  // namespace

int run_solve(const std::string& file, std::ostream& out, std::ostream& err) {
  if (file == "-") return solve_lines(std::cin, "standard input", out, err);
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) {
    throw FileError(file + ": is a folder; expected a file with one JSON object a line");
  }
  std::ifstream input(file);
  if (!input)
    throw FileError(file + ": can't be read; expected a file with one JSON object a line");
  return solve_lines(input, file, out, err);
}

}  // namespace surefoot
