#include "cli/solve_command.hpp"

#include "cli/exit_code.hpp"
#include "cli/progress.hpp"
#include "surefoot/base/error.hpp"
#include "surefoot/base/printable.hpp"
#include "surefoot/config/hierarchy_json.hpp"
#include "surefoot/config/weighted_question.hpp"
#include "surefoot/control/solver_options.hpp"
#include "surefoot/explain/explanation_json.hpp"
#include "surefoot/runtime/steady_clock.hpp"
#include "surefoot/solver/cascade_solver.hpp"
#include "surefoot/solver/certificate.hpp"
#include "surefoot/solver/even_units.hpp"
#include "surefoot/solver/lexicographic_solver.hpp"
#include "surefoot/solver/sweep.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <optional>

namespace surefoot::cli {
namespace {

using Eigen::Index;
using Json = nlohmann::ordered_json;

/// Limits of a line: it fits in the memory of any machine, and in a minute.
constexpr Index kMaxUnknowns = 500;
constexpr Index kMaxRows = 5000;

Index num_rows(const solver::Hierarchy& hierarchy) {
  Index rows = 0;
  for (std::size_t k = 0; k < hierarchy.num_levels(); ++k) rows += hierarchy.level(k).num_rows();
  return rows;
}

void check_size(const solver::Hierarchy& hierarchy, const std::string& place) {
  const std::string limit = "; expected at most " + std::to_string(kMaxUnknowns) +
                            " unknowns and " + std::to_string(kMaxRows) + " rows in a line";
  if (hierarchy.unknowns() > kMaxUnknowns) {
    throw FileError(place + ": has " + std::to_string(hierarchy.unknowns()) + " unknowns" + limit);
  }
  Index rows = 0;
  for (std::size_t k = 0; k < hierarchy.num_levels(); ++k) {
    const Index more = hierarchy.level(k).num_rows();
    if (rows + more > kMaxRows) {
      throw FileError(place + ": level " + std::to_string(k + 1) + ": row " +
                      std::to_string(kMaxRows - rows + 1) + " is one too many" + limit);
    }
    rows += more;
  }
}

constexpr int kMaxNotes = 10;  // lines on `err`

/// Throws Error on an unknown method, and on a budget that the method does not support.
void check_method(const SolveArguments& arguments) {
  const bool is_cascade = arguments.method == name(control::SolverMethod::cascade);
  if (!is_cascade && arguments.method != name(control::SolverMethod::lexicographic)) {
    throw Error("unknown method \"" + arguments.method + "\"; there are: lexicographic, cascade");
  }
  if (!(arguments.budget >= 0.0)) throw Error("a budget is a number of flops, at least 0");
  if (!(arguments.budget_us >= 0.0))
    throw Error("a budget is a number of microseconds, at least 0");
  if (arguments.weighted_from && *arguments.weighted_from < 1)
    throw Error("--weighted is " + std::to_string(*arguments.weighted_from) +
                "; expected the number of a level, counted from 1");
  if (!arguments.weights.empty() && !arguments.weighted_from)
    throw Error("--weights go with --weighted, the level from which on they are");
  for (const double weight : arguments.weights)
    solver::check_weight(weight, "the weight of a level");
  if (is_cascade && (std::isfinite(arguments.budget) || std::isfinite(arguments.budget_us))) {
    throw Error(
        "the cascade has no budget; --budget and --budget-us go with the lexicographic method");
  }
}

constexpr const char* kExpected = "; expected a file with one JSON object a line";

class SolveCommand {
 public:
  SolveCommand(const SolveArguments& arguments, std::ostream& out, std::ostream& err)
      : arguments_(arguments), out_(out), err_(err) {}

  int solve_lines(std::istream& input, const std::string& name) {
    std::string line;
    bool is_empty = true;
    for (line_ = 1; std::getline(input, line); ++line_) {
      if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
      is_empty = false;
      try {
        solve_line(line, name + ":" + std::to_string(line_));
      } catch (const FileError& error) {
        err_ << error.what() << '\n';
        exit_code_ = kWrongInput;
      }
    }
    if (is_empty) throw FileError(name + ": is empty" + kExpected);
    note_hidden(name);
    return exit_code_;
  }

 private:
  [[nodiscard]] bool is_cascade() const {
    return arguments_.method == name(control::SolverMethod::cascade);
  }

  /// Instruction set of the lexicographic solver's kernels.
  static std::string instructions() { return solver::fastest_kernels().name; }

  /// Wrong lines have no answer, so each answer has its line's number.
  [[nodiscard]] Json with_place(Json line, const solver::Solution& solution) const {
    line["line"] = line_;
    if (!is_cascade()) {
      line["instructions"] = instructions();
      line["flops"] = solution.flops;
    }
    if (solution.borderline) line["borderline"] = true;
    if (solution.status == solver::SolveStatus::iteration_cap)
      line["cut_off_by"] = is_budget_spent(solution) ? "budget" : "cap";
    return line;
  }

  /// If not, a solve that was cut off was ended by the solver's own cap.
  [[nodiscard]] bool is_budget_spent(const solver::Solution& solution) const {
    const bool is_late =
        std::isfinite(arguments_.budget_us) && solution.time >= 1e-6 * arguments_.budget_us;
    return solution.flops >= arguments_.budget || is_late;
  }

  [[nodiscard]] solver::Solution solve(const solver::Hierarchy& hierarchy) const {
    const bool is_timed = arguments_.explain || std::isfinite(arguments_.budget_us);
    double (*clock)() = is_timed ? runtime::steady_seconds : nullptr;
    if (is_cascade()) {
      return solver::solve_in_even_units<solver::CascadeSolver>(
          hierarchy, solver::CascadeOptions{.rank = {}, .clock = clock});
    }
    solver::LexicographicOptions options;
    options.budget.flops = arguments_.budget;
    options.budget.seconds = 1e-6 * arguments_.budget_us;
    options.clock = clock;
    return solver::solve_in_even_units<solver::LexicographicSolver>(hierarchy, options);
  }

  static std::string waiting_for(const std::string& place, const solver::Hierarchy& hierarchy) {
    return "solving " + place + " (" + std::to_string(hierarchy.unknowns()) + " unknowns, " +
           std::to_string(num_rows(hierarchy)) + " rows)";
  }

  void solve_line(const std::string& line, const std::string& place) {
    const config::NamedHierarchy strict = config::parse_hierarchy(line, place);
    check_size(strict.hierarchy, place);
    const config::NamedHierarchy question =
        arguments_.weighted_from ? config::weighted_question(strict, *arguments_.weighted_from,
                                                             arguments_.weights, place)
                                 : strict;
    std::optional<Waiting> waiting(std::in_place, waiting_for(place, question.hierarchy));
    const solver::Solution solution = solve(question.hierarchy);
    if (solution.status == solver::SolveStatus::invalid_input) {
      throw FileError(
          place +
          ": the answer is beyond the range of doubles; expected rows and bounds of similar size");
    }
    const std::size_t num_levels = question.hierarchy.num_levels();
    const std::size_t finished = explain::num_finished(solution, num_levels);
    std::vector<solver::LevelCertificate> certificates;
    if (arguments_.certify)
      certificates = solver::certify(question.hierarchy, solution.x, {.levels = finished});
    waiting.reset();
    if (arguments_.explain) {
      explain_line(place, question, solution, certificates, strict.hierarchy);
    } else {
      const Json answer =
          with_strict_residuals(with_place(json_line(question, solution, certificates), solution),
                                strict.hierarchy, solution);
      out_ << printable(with_notes(answer, question.hierarchy).dump()) << std::endl;
    }
    note_levels_without_rows(place, question.hierarchy);
    if (solver::verdict(certificates) != solver::Verdict::proven) {
      err_ << place << ": " << explain::verdict_text(question.hierarchy, solution.x, certificates)
           << '\n';
      exit_code_ = std::max(exit_code_, static_cast<int>(kFailed));
    }
    const bool is_cut_off = solution.status == solver::SolveStatus::iteration_cap;
    const bool is_capped = is_cut_off && !is_budget_spent(solution);
    if (is_capped || (arguments_.certify && finished < num_levels))
      report_cut_off(place, finished, num_levels, is_budget_spent(solution));
  }

  [[nodiscard]] Json with_strict_residuals(Json line, const solver::Hierarchy& strict,
                                           const solver::Solution& solution) const {
    if (arguments_.weighted_from)
      line["strict_residuals"] = config::residuals_at(strict, solution.x);
    return line;
  }

  void explain_line(const std::string& place, const config::NamedHierarchy& question,
                    const solver::Solution& solution,
                    const std::vector<solver::LevelCertificate>& certificates,
                    const solver::Hierarchy& strict) {
    explain::SolutionExplanation explanation = explained(place, question, solution);
    explanation.certificates = certificates;
    explanation.is_budget_spent = is_budget_spent(solution);
    if (arguments_.json) {
      const Json line = with_strict_residuals(
          with_place(explain::explanation_json(explanation), solution), strict, solution);
      out_ << printable(with_notes(line, question.hierarchy).dump()) << std::endl;
    } else {
      out_ << place << (is_cascade() ? "" : ", " + instructions() + " instructions") << "\n"
           << explanation.text() << std::endl;
    }
  }

  /// Shows progress: it needs one solve for each row that may hold a level back.
  static explain::SolutionExplanation explained(const std::string& place,
                                                const config::NamedHierarchy& question,
                                                const solver::Solution& solution) {
    const auto num_levels = static_cast<double>(question.hierarchy.num_levels());
    Progress progress("explaining " + place, num_levels, "levels");
    return explain::explain_solution(question, solution,
                                     [&](double done) { progress.update(done); });
  }

  static std::string without_rows(const solver::Hierarchy& hierarchy, std::size_t level) {
    const std::string number = "level " + std::to_string(level + 1);
    const std::string& name = hierarchy.level(level).name();
    return number + (name == number ? "" : " (" + name + ")") +
           " has no rows, so it asks for nothing";
  }

  static Json with_notes(Json line, const solver::Hierarchy& hierarchy) {
    for (const std::size_t level : explain::levels_without_rows(hierarchy))
      line["notes"].push_back(without_rows(hierarchy, level));
    return line;
  }

  /// At most `kMaxNotes`: a recorded walk has thousands of lines with the same empty level.
  void note_levels_without_rows(const std::string& place, const solver::Hierarchy& hierarchy) {
    for (const std::size_t level : explain::levels_without_rows(hierarchy)) {
      if (++num_notes_ <= kMaxNotes)
        err_ << place << ": note: " << printable(without_rows(hierarchy, level)) << '\n';
    }
  }

  void note_hidden(const std::string& name) {
    if (num_notes_ <= kMaxNotes) return;
    err_ << name << ": note: " << num_notes_ - kMaxNotes
         << " more levels without rows are named in the results only\n";
  }

  void report_cut_off(const std::string& place, std::size_t finished, std::size_t num_levels,
                      bool is_budget_spent) {
    const bool is_unproven = arguments_.certify && finished < num_levels;
    const std::string what = is_unproven ? ": not proven, cut off" : ": cut off";
    err_ << place << what;
    if (finished < num_levels) err_ << " in level " << finished + 1 << " of " << num_levels;
    err_ << " " << explain::what_ended(is_budget_spent) << "; ";
    if (finished == num_levels)
      err_ << "all levels are optimal, x is not yet the shortest\n";
    else
      err_ << "only levels before it "
           << (arguments_.certify ? "have certificates\n" : "are optimal\n");
    exit_code_ = std::max(exit_code_, static_cast<int>(kFailed));
  }

  static Json json_line(const config::NamedHierarchy& question, const solver::Solution& solution,
                        const std::vector<solver::LevelCertificate>& certificates) {
    Json levels = Json::array();
    const std::size_t num_levels = question.hierarchy.num_levels();
    const std::size_t finished = explain::num_finished(solution, num_levels);
    for (std::size_t k = 0; k < num_levels; ++k) {
      Json level = Json::object();
      if (k >= finished) level["status"] = k == finished ? explain::kCutOff : explain::kNotReached;
      if (k <= finished) level["residual"] = solution.levels[k].residual;
      if (k < certificates.size()) {
        level["certificate"] = certificates[k].stationarity;
        level["verdict"] = name(solver::verdict(certificates[k]));
        if (certificates[k].rests_on >= 0) level["rests_on"] = certificates[k].rests_on + 1;
      }
      levels.push_back(std::move(level));
    }
    const std::vector<double> x(solution.x.data(), solution.x.data() + solution.x.size());
    Json line = {{"x", x}, {"levels", std::move(levels)}};
    if (solution.status == solver::SolveStatus::iteration_cap) line["status"] = "iteration_cap";
    return line;
  }

  SolveArguments arguments_;
  std::ostream& out_;
  std::ostream& err_;
  int line_ = 0;  // of the input, counted from 1
  int exit_code_ = 0;
  int num_notes_ = 0;
};

}  // namespace

int run_solve(const SolveArguments& arguments, std::ostream& out, std::ostream& err) {
  check_method(arguments);
  const std::string& file = arguments.file;
  const std::string name = printable(file);
  SolveCommand command(arguments, out, err);
  if (file == "-") return command.solve_lines(std::cin, "standard input");
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) {
    throw FileError(name + ": is a folder" + kExpected);
  }
  std::ifstream input(file);
  if (!input) throw FileError(name + ": can't be read" + kExpected);
  return command.solve_lines(input, name);
}

}  // namespace surefoot::cli
