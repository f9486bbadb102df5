#pragma once

#include <iosfwd>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace surefoot::cli {

struct SolveArguments {
  std::string file;      ///< "-": standard input
  bool certify = false;  ///< check each answer against the optimality conditions
  bool explain = false;  ///< tables for people instead of JSON
  bool json = false;     ///< with `explain`: JSON all the same, with all that the tables say
  std::string method = "lexicographic";  ///< of kSolverMethods: which solver
  /// Flops after which a line's search ends, of the lexicographic method.
  double budget = std::numeric_limits<double>::infinity();
  /// The same in microseconds.
  double budget_us = std::numeric_limits<double>::infinity();
  /// The levels from this one on, counted from 1, are solved as one weighted level; none: in
  /// strict order, all of them.
  std::optional<int> weighted_from = std::nullopt;
  std::vector<double> weights = {};  ///< of these levels; 1 where there is none
};

/// `surefoot solve FILE.jsonl`: solves the hierarchy on each line of the file, by the controller's
/// solver or by the reference (`method`: cascade), and writes one line for each,
///
///     {"x": […], "levels": [{"residual": …}, …]}
///     residual = √(‖A x − b‖² + ‖max(0, D x − f)‖²)
///
/// While a line takes long a line on stderr says which, and for how many seconds.
///
/// With `certify` each level has its "certificate", the distance from its optimality conditions
/// that `LevelCertificate` defines, computed without the solver, and its "verdict": "proven", "not
/// judged" or "not proven". With `explain` a table has the
/// status of each level and, by the cascade, its iterations and time, the rows that it missed or
/// holds at a bound, and the rows above that held it back, with multiplier and cost; with `json`
/// too, the line has all of it.
///
/// With `weighted_from` the levels from there on are one (`WeightedLevels`), called "weighted",
/// whose rows have their level's name before theirs. "x_ref" is no level to be weighed: it stays
/// the last. "strict_residuals" has what is left, at the x of the weighted problem, of every level
/// of the line as it was, "x_ref" last, without `weights` but with the rows' own, to be compared
/// with the residuals of the strict order.
///
/// A level without rows asks for nothing: the line is solved, a message on `err` names line and
/// level, and the result has it under "notes".
///
/// A line has at most 500 unknowns and 5000 rows. Blank lines are skipped. A line that can't be
/// understood gives one message on `err`, with file and line, and nothing on `out`; the other lines
/// are still solved. "borderline": true stands in a line where the solution is, see
/// Solution::borderline. "flops" is what a line has counted against a budget, of the lexicographic
/// method. A line that ended at its budget or at the solver's own cap of iterations has "status":
/// "iteration_cap" and "cut_off_by": "budget" or "cap" in its result, the level where it did
/// "status": "cut off" and the residual so far, the levels below "status": "not reached" and no
/// number; neither has a certificate or an explanation. Returns the exit code: 0; 1 if a level
/// isn't proven or has no certificate, or a line ended at the cap; 2 if the input is wrong. Throws
/// FileError if the file can't be read or has no line.
int run_solve(const SolveArguments& arguments, std::ostream& out, std::ostream& err);

}  // namespace surefoot::cli
