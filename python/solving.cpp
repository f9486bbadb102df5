#include "python/bindings.hpp"
#include "python/explanation.hpp"
#include "python/interpreter.hpp"
#include "python/level_dict.hpp"
#include "python/level_outcome.hpp"
#include "python/numbers.hpp"
#include "python/turn.hpp"
#include "surefoot/config/hierarchy_json.hpp"
#include "surefoot/control/solver_options.hpp"
#include "surefoot/explain/explain.hpp"
#include "surefoot/runtime/steady_clock.hpp"
#include "surefoot/solver/cascade_solver.hpp"
#include "surefoot/solver/certificate.hpp"
#include "surefoot/solver/even_units.hpp"
#include "surefoot/solver/extra_rows.hpp"
#include "surefoot/solver/lexicographic_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace surefoot::python {
namespace {

/// `Solution` in Python.
struct NamedSolution {
  config::NamedHierarchy question;
  solver::Solution solution;
  double budget = 0.0;  ///< that it had [flops]
  std::vector<LevelOutcome> levels;
  std::optional<int> failed_level;  ///< counted from 0
  std::vector<solver::LevelCertificate> certificates;
  std::optional<std::string> verdict;
};

void append(const Block& block, solver::Level& level, std::vector<std::string>& row_names,
            std::vector<double>& weights) {
  for (Eigen::Index i = 0; i < block.A.rows(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    solver::Rows row = level.add(1, block.ids[k]);
    row.A = block.A.row(i);
    row.lower[0] = block.lower[i];
    row.upper[0] = block.upper[i];
    row.weigh(0, block.weights[i]);
    row_names.push_back(block.names[k]);
    weights.push_back(block.weights[i]);
  }
}

/// Names of rows that are counted.
void append_names(const std::string& what, Eigen::Index count, std::vector<std::string>& names) {
  for (Eigen::Index i = 0; i < count; ++i) names.push_back(what + "[" + std::to_string(i) + "]");
}

/// What x is to be close to; none: nothing.
std::optional<Eigen::VectorXd> read_reference(const nb::object& given, Eigen::Index unknowns) {
  if (given.is_none()) return std::nullopt;
  const Array numbers =
      numbers_of(given, "x_ref", 1, [](const std::string& message) { throw Error(message); });
  const Eigen::VectorXd x_ref =
      Eigen::Map<const Eigen::VectorXd>(numbers.data(), static_cast<Eigen::Index>(numbers.size()));
  if (x_ref.size() != unknowns) {
    throw Error("x_ref has " + std::to_string(x_ref.size()) + " elements; expected " +
                std::to_string(unknowns) + ", one for each unknown");
  }
  for (Eigen::Index i = 0; i < unknowns; ++i) {
    const std::string place = "x_ref[" + std::to_string(i) + "] ";
    if (!std::isfinite(x_ref[i]))
      throw Error(place + "is " + text(x_ref[i]) + "; expected a finite number");
    if (std::abs(x_ref[i]) > config::kLargestNumber)
      throw Error(place + config::too_large(text(x_ref[i])));
  }
  return x_ref;
}

/// Every row has one element for each unknown; returns how many there are.
Eigen::Index check_unknowns(const std::vector<LevelDict>& levels,
                            const std::vector<std::vector<Block>>& blocks) {
  Eigen::Index unknowns = 0;
  for (std::size_t k = 0; k < levels.size(); ++k) {
    for (const Block& block : blocks[k]) {
      if (block.A.rows() == 0) continue;
      if (unknowns == 0) unknowns = block.A.cols();
      if (block.A.cols() == unknowns) continue;
      levels[k].fail(block.key + " has " + std::to_string(block.A.cols()) +
                     " columns; the rows before it have " + std::to_string(unknowns) +
                     ", one for each unknown");
    }
  }
  if (unknowns == 0) throw Error("no unknowns; expected at least one row in A or D of a level");
  return unknowns;
}

void append_level(const LevelDict& level, const std::vector<Block>& blocks,
                  const config::RowIds& ids, const Eigen::VectorXd& x_ref,
                  config::NamedHierarchy& result) {
  Eigen::Index rows = 0;
  for (const Block& block : blocks) rows += block.A.rows();
  const double damping = level.damping();
  const std::size_t index =
      result.hierarchy.add_level(level.name(), damping > 0.0 ? 2 * rows : rows);
  std::vector<std::string>& names = result.row_names.emplace_back();
  std::vector<double>& weights = result.weights.emplace_back();
  result.units.push_back(level.unit());
  for (const Block& block : blocks) append(block, result.hierarchy.level(index), names, weights);
  if (damping == 0.0) return;
  solver::add_damping(result.hierarchy.level(index), damping, x_ref, ids.first_of(rows));
  append_names("damping", rows, names);
  weights.resize(names.size(), 1.0);
}

config::NamedHierarchy read_hierarchy(const nb::list& given, const nb::object& given_reference) {
  std::vector<LevelDict> levels;
  std::vector<std::vector<Block>> blocks;
  std::vector<config::RowIds> ids;
  for (const nb::handle level : given) {
    levels.emplace_back(level, levels.size() + 1);
    blocks.push_back(levels.back().blocks(ids.emplace_back()));
  }
  const Eigen::Index unknowns = check_unknowns(levels, blocks);
  const std::optional<Eigen::VectorXd> x_ref = read_reference(given_reference, unknowns);
  const Eigen::VectorXd reference = x_ref.value_or(Eigen::VectorXd::Zero(unknowns));
  config::NamedHierarchy result{solver::Hierarchy(unknowns), {}, {}};
  for (std::size_t k = 0; k < levels.size(); ++k)
    append_level(levels[k], blocks[k], ids[k], reference, result);
  if (!x_ref) return result;
  solver::add_reference(result.hierarchy.level(result.hierarchy.add_level("x_ref", unknowns)),
                        reference, 0);
  append_names("x", unknowns, result.row_names.emplace_back());
  result.weights.emplace_back(static_cast<std::size_t>(unknowns), 1.0);
  result.units.emplace_back();
  result.has_reference = true;
  return result;
}

void check_method(const std::string& method, double budget) {
  const bool is_cascade = method == name(control::SolverMethod::cascade);
  if (!is_cascade && method != name(control::SolverMethod::lexicographic)) {
    throw Error("unknown method \"" + method + "\"; there are: lexicographic, cascade");
  }
  if (!(budget >= 0.0)) throw Error("a budget is a number of flops, at least 0");
  if (is_cascade && std::isfinite(budget)) {
    throw Error("the cascade has no budget; a budget goes with the lexicographic method");
  }
}

solver::Solution solve(const solver::Hierarchy& hierarchy, const std::string& method,
                       double budget) {
  const Interpreter::Unlocked others_may_run;
  if (method == name(control::SolverMethod::cascade))
    return solver::solve_in_even_units<solver::CascadeSolver>(
        hierarchy, solver::CascadeOptions{.rank = {}, .clock = runtime::steady_seconds});
  solver::LexicographicOptions options;
  options.budget.flops = budget;
  options.clock = runtime::steady_seconds;
  return solver::solve_in_even_units<solver::LexicographicSolver>(hierarchy, options);
}

/// Where the search ended early: levels below were not reached, so nothing is known of them.
void tell_end(NamedSolution& result) {
  const solver::Solution& solution = result.solution;
  const auto num_levels = static_cast<int>(result.levels.size());
  if (solution.status == solver::SolveStatus::optimal || solution.failed_level < 0 ||
      solution.failed_level >= num_levels)
    return;
  result.failed_level = solution.failed_level;
  for (int k = solution.failed_level + 1; k < num_levels; ++k) {
    LevelOutcome& level = result.levels[static_cast<std::size_t>(k)];
    level.report.residual = std::numeric_limits<double>::quiet_NaN();
    level.report.degrees_of_freedom_left = 0;
    level.report.num_active = 0;
    level.active.clear();
  }
}

/// Of the levels that are finished.
void tell_certificates(NamedSolution& result) {
  const solver::Hierarchy& hierarchy = result.question.hierarchy;
  const std::size_t finished =
      result.failed_level ? static_cast<std::size_t>(*result.failed_level) : hierarchy.num_levels();
  std::vector<solver::LevelCertificate>& certificates = result.certificates;
  {
    const Interpreter::Unlocked others_may_run;
    certificates = solver::certify(hierarchy, result.solution.x, {.levels = finished});
  }
  for (std::size_t k = 0; k < certificates.size(); ++k) {
    result.levels[k].certificate = certificates[k].stationarity;
    result.levels[k].verdict = std::string(name(solver::verdict(certificates[k])));
    if (certificates[k].rests_on >= 0) result.levels[k].rests_on = certificates[k].rests_on;
  }
  const solver::Verdict worst =
      result.failed_level ? solver::Verdict::not_proven : solver::verdict(certificates);
  result.verdict = std::string(name(worst));
}

NamedSolution answer(config::NamedHierarchy question, solver::Solution solution, double budget,
                     bool is_certified) {
  if (solution.status == solver::SolveStatus::invalid_input) {
    throw Error(
        "the answer is beyond the range of doubles; expected rows and bounds of similar size");
  }
  NamedSolution result{std::move(question), std::move(solution), budget, {}, {}, {}, {}};
  for (std::size_t k = 0; k < result.question.hierarchy.num_levels(); ++k) {
    result.levels.push_back(outcome(result.question.hierarchy.level(k).name(),
                                    result.solution.levels[k], result.question.row_names[k]));
  }
  tell_end(result);
  if (is_certified) tell_certificates(result);
  return result;
}

NamedSolution solve_levels(const nb::list& levels, const nb::object& x_ref,
                           const std::string& method, double budget, bool is_certified) {
  check_method(method, budget);
  config::NamedHierarchy question = read_hierarchy(levels, x_ref);
  solver::Solution solution = solve(question.hierarchy, method, budget);
  return answer(std::move(question), std::move(solution), budget, is_certified);
}

/// The controller's solver, kept over ticks; `HierarchicalSolver` in Python.
class WarmSolver {
 public:
  explicit WarmSolver(double budget) : budget_(budget) {
    check_method(std::string(name(control::SolverMethod::lexicographic)), budget);
  }

  NamedSolution solve(const nb::list& levels, const nb::object& x_ref, bool is_certified) {
    config::NamedHierarchy question = read_hierarchy(levels, x_ref);
    const Turn::Taken taken(turn_, Turn::Kind::tick);
    if (!fits(question.hierarchy)) make_room(question.hierarchy);
    {
      const Interpreter::Unlocked others_may_run;
      solver_->solve(question.hierarchy);
    }
    return answer(std::move(question), solver_->solution(), budget_, is_certified);
  }
  void forget() {
    turn_.look();
    if (solver_) solver_->forget();
  }
  [[nodiscard]] int num_sweeps() {
    turn_.look();
    return solver_ ? solver_->num_sweeps() : 0;
  }

 private:
  [[nodiscard]] bool fits(const solver::Hierarchy& hierarchy) const {
    bool is_enough = hierarchy.unknowns() == capacity_.unknowns() &&
                     hierarchy.num_levels() <= capacity_.num_levels();
    for (std::size_t k = 0; is_enough && k < hierarchy.num_levels(); ++k)
      is_enough = hierarchy.level(k).num_rows() <= capacity_.level(k).max_rows();
    return is_enough;
  }
  /// The next solve begins cold.
  void make_room(const solver::Hierarchy& hierarchy) {
    solver::Hierarchy capacity(hierarchy.unknowns());
    for (std::size_t k = 0; k < std::max(hierarchy.num_levels(), capacity_.num_levels()); ++k) {
      const auto rows = [k](const solver::Hierarchy& of) {
        return k < of.num_levels() ? of.level(k).max_rows() : 0;
      };
      capacity.add_level("", std::max(rows(hierarchy), rows(capacity_)));
    }
    capacity_ = std::move(capacity);
    solver::LexicographicOptions options;
    options.budget.flops = budget_;
    options.clock = runtime::steady_seconds;
    solver_.emplace(capacity_, options);
  }

  double budget_;  // [flops]
  solver::Hierarchy capacity_{0};
  std::optional<solver::LexicographicSolver> solver_;
  Turn turn_{"solver", false};
};

Explanation explained(const NamedSolution& solved) {
  const Interpreter::Unlocked others_may_run;
  explain::SolutionExplanation told = explain::explain_solution(solved.question, solved.solution);
  told.certificates = solved.certificates;
  told.is_budget_spent = solved.solution.flops >= solved.budget;
  return Explanation::of(told);
}

}  // namespace

void bind_solving(nb::module_& module) {
  nb::class_<NamedSolution>(module, "Solution", "The lexicographic optimum of a hierarchy.")
      .def_prop_ro(
          "x",
          [](nb::handle_t<NamedSolution> self) {
            const Eigen::VectorXd& x = nb::inst_ptr<NamedSolution>(self)->solution.x;
            return nb::ndarray<nb::numpy, const double, nb::shape<-1>>(
                x.data(), {static_cast<std::size_t>(x.size())}, self);
          },
          "shape (unknowns,)")
      .def_ro("levels", &NamedSolution::levels, "how each level came out, highest priority first")
      .def_prop_ro(
          "status", [](const NamedSolution& self) { return explain::name(self.solution.status); },
          "optimal, or iteration_cap: ended early, x is feasible for all levels that are finished")
      .def_prop_ro(
          "borderline", [](const NamedSolution& self) { return self.solution.borderline; },
          "which answer is the optimum depends on less than doubles can tell")
      .def_prop_ro(
          "flops", [](const NamedSolution& self) { return self.solution.flops; },
          "additions and multiplications that budget counts; 0 of the cascade")
      .def_ro(
          "failed_level", &NamedSolution::failed_level,
          "index of the level in which the search ended early: those before it are optimal, of\n"
          "those after it nothing is known; None where all are optimal")
      .def_ro("verdict", &NamedSolution::verdict,
              "the worst of all levels, with certify=True: proven, not judged or not proven; a\n"
              "search that ended early is not proven")
      .def("explain", &explained,
           "Why each level came out as it did, as `surefoot solve --explain` tells it: what it\n"
           "missed, which rows above hold it back, and what they cost, in the level's unit. Takes\n"
           "one solve for each row that may hold a level back.")
      .def(
          "__reduce__",
          [](const NamedSolution&) -> nb::object {
            throw nb::type_error(
                "a Solution can't be pickled; its x, status, flops and verdict can, and "
                "{level.name: level.residual for level in solution.levels}");
          },
          nb::sig("def __reduce__(self) -> tuple[typing.Any, ...]"))
      .def("__repr__", [](nb::handle_t<NamedSolution> self) {
        return nb::str("Solution({!r}, x={}, levels={})")
            .format(self.attr("status"), self.attr("x"), self.attr("levels"));
      });

  using Warm = WarmSolver;
  nb::class_<Warm>(module, "HierarchicalSolver",
                   "The controller's solver, kept over ticks: each solve begins with the active "
                   "rows of the last,\nfound by the name of their level and their place or id "
                   "(A_ids, D_ids). The answer is that of solve();\nonly the time differs.",
                   nb::type_slots(kNoVectorcall))
      .def(nb::init<double>(), nb::arg("budget") = std::numeric_limits<double>::infinity(),
           "budget: of each solve, as for solve().")
      .def("solve", &Warm::solve, nb::arg("levels"), nb::kw_only(), nb::arg("x_ref") = nb::none(),
           nb::arg("certify") = false,
           nb::sig("def solve(self, levels: list[dict[str, typing.Any]], *, x_ref: "
                   "collections.abc.Sequence[float] | None = None, certify: bool = False) -> "
                   "Solution"),
           "A tick: levels, x_ref and certify as for surefoot.solve(), weights of rows and damping "
           "included.")
      .def("forget", &Warm::forget, "The next solve begins without a guess.")
      .def_prop_ro("num_sweeps", &Warm::num_sweeps,
                   "of the last solve, over all levels: 1 where the guess was right")
      .def("__repr__", [](Warm& self) {
        return "<hierarchical solver, " + std::to_string(self.num_sweeps()) +
               " sweeps in the last solve>";
      });

  module.def(
      "solve", &solve_levels, nb::arg("levels"), nb::kw_only(), nb::arg("x_ref") = nb::none(),
      nb::arg("method") = std::string(name(control::SolverMethod::lexicographic)),
      nb::arg("budget") = std::numeric_limits<double>::infinity(), nb::arg("certify") = false,
      nb::sig("def solve(levels: list[dict[str, typing.Any]], *, x_ref: "
              "collections.abc.Sequence[float] | None = None, "
              "method: str = 'lexicographic', budget: float = float('inf'), certify: bool = False) "
              "-> Solution"),
      "Solves a strict hierarchy exactly, highest priority first (Eqs. 8–13).\n\n"
      "A level is a dict of arrays or nested lists:\n"
      "  A, b          A x = b, shapes (rows, unknowns) and (rows,)\n"
      "  D, lower, f   lower ≤ D x ≤ f; one of the two may be missing, and None or infinite is no\n"
      "                bound: a row with none at all asks for nothing\n"
      "  A_names, D_names   what rows are called in the result; A_ids and D_ids, which lines of\n"
      "                `surefoot dump` have, change nothing; unique in a level\n"
      "  unit          of the rows, a text for Solution.explain()\n"
      "  A_weights, D_weights   by which each row and its bounds are multiplied, above 0: "
      "residuals\n"
      "                are those of the weighted rows\n"
      "  damping d     adds the rows d E (x - x_ref) = 0, E an orthonormal basis of the rows' "
      "span\n"
      "  name          a text, for the result\n"
      "Each level is met as well as possible, in least squares of its violation, without\n"
      "disturbing any before it. What all of them leave open stays at the least norm, or with\n"
      "x_ref, an array or list, closest to that: it is a last level of this name.\n\n"
      "method is lexicographic, the controller's solver, or cascade, the reference. budget ends\n"
      "the search of the former after so many additions and multiplications: then the status is\n"
      "iteration_cap, and the levels that are finished are optimal.\n\n"
      "certify=True checks each level against its optimality conditions, without the solver: not\n"
      "judged is what meets them as far as doubles can tell, but by exact arithmetic something\n"
      "could be gained.");
}

}  // namespace surefoot::python
