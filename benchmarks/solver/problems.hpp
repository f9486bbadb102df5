#pragma once

#include "surefoot/solver/hierarchy.hpp"

#include <functional>
#include <string>
#include <vector>

namespace surefoot::benchmarks {

/// Problems that are solved one after the other.
struct ProblemSet {
  std::string name;
  bool is_sequence = false;  ///< consecutive ticks: a solver may keep what it knows
  std::vector<solver::Hierarchy> problems;
};

/// How many problems to make.
struct Amount {
  int problems = 200;  ///< of each generated family
  int ticks = 2000;    ///< of each recorded run
};

/// A set by its name, made when it is asked for.
struct Family {
  std::string name, about;
  std::function<ProblemSet(const Amount& amount)> make;
};

[[nodiscard]] std::vector<Family> families();

/// The hierarchies of a file as `surefoot dump` writes it. Throws FileError with file and line.
[[nodiscard]] ProblemSet read_problems(const std::string& file, bool is_sequence);

/// Rows and bounds over the rows' norms, so that a solver's own normalisation changes nothing.
[[nodiscard]] solver::Hierarchy normalised(const solver::Hierarchy& hierarchy);

/// What remains when the first `levels` levels, equalities that can be met, are eliminated.
[[nodiscard]] solver::Hierarchy reduced(const solver::Hierarchy& hierarchy, std::size_t levels);

/// Table I of the paper for ANYmal B at a random state near its stance, with 2, 3 or 4 feet down.
enum class Difficulty { nominal, aggressive, infeasible, degenerate };
[[nodiscard]] solver::Hierarchy table_one_problem(unsigned seed, Difficulty difficulty);

}  // namespace surefoot::benchmarks
