#include "surefoot/solver/explanation.hpp"

#include "surefoot/solver/cascade_solver.hpp"
#include "surefoot/solver/certificate.hpp"
#include "surefoot/solver/distinct_rows.hpp"
#include "surefoot/solver/even_units.hpp"
#include "surefoot/solver/index.hpp"
#include "surefoot/solver/tolerances.hpp"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace surefoot::solver {
namespace {

using Eigen::VectorXd;

constexpr CertificateOptions kTolerances;
/// Smallest multiplier, relative to the rounding of a level's gradient.
constexpr double kClearMultiplier = 5e4;
/// Smallest cost, relative to the residual.
constexpr double kMinCost = 1e-9;

/// Copies a row with its bounds on the step from x. Drops bounds beyond the solvers' range.
void copy(const Level& from, Index i, double lower, double upper, Level& to) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  if (lower < -tolerance::kLargest) lower = -kNone;
  if (upper > tolerance::kLargest) upper = kNone;
  if (lower == -kNone && upper == kNone) return;
  Rows row = to.add(1, 0);
  row.A.row(0) = from.A().row(i);
  row.lower[0] = lower;
  row.upper[0] = upper;
}

/// Copies a row pinned at x: an equality keeps its value, a satisfied limit stays satisfied, and a
/// violated one may approach its bound. It can't while all rows of its level are there, because the
/// row that contradicts it would be violated more.
void copy_pinned(const Level& from, Index i, const VectorXd& x, Level& to) {
  const double value = from.A().row(i).dot(x);
  const bool is_equality = from.lower()[i] == from.upper()[i];
  const double lower = is_equality ? 0.0 : std::min(from.lower()[i] - value, 0.0);
  const double upper = is_equality ? 0.0 : std::max(from.upper()[i] - value, 0.0);
  copy(from, i, lower, upper, to);
}

/// Residual of `level` when the levels before it keep their results at x, except for the rows of
/// `is_without`; NaN if the search does not end. Solves for the step from x, because a zero step is
/// feasible: otherwise the search for a feasible point takes most of the time.
template <typename Predicate>
double residual_without(const Hierarchy& hierarchy, std::size_t level, const VectorXd& x,
                        const Predicate& is_without) {
  Index rows_above = 0;
  for (std::size_t j = 0; j < level; ++j) rows_above += hierarchy.level(j).num_rows();
  const Level& own = hierarchy.level(level);
  Hierarchy question(hierarchy.unknowns());
  question.add_level("above", rows_above);
  question.add_level(own.name(), own.num_rows());
  for (std::size_t j = 0; j < level; ++j) {
    for (Index i = 0; i < hierarchy.level(j).num_rows(); ++i) {
      if (!is_without(RowIndex{j, i})) {
        copy_pinned(hierarchy.level(j), i, x, question.level(0));
      }
    }
  }
  for (Index i = 0; i < own.num_rows(); ++i) {
    const double value = own.A().row(i).dot(x);
    copy(own, i, own.lower()[i] - value, own.upper()[i] - value, question.level(1));
  }
  CascadeSolver solver(question);
  const Solution& solution = solver.solve(question);
  return solution.status == SolveStatus::optimal ? solution.levels[1].residual : std::nan("");
}

/// Is a row of E clearly violated, and less so along its force on the level?
bool would_gain(const RowSet& fixed, Index i, double force, const Hierarchy& hierarchy,
                const VectorXd& x) {
  const RowIndex at = fixed.origin[static_cast<std::size_t>(i)];
  const Level& level = hierarchy.level(at.level);
  const bool is_equality = level.lower()[at.row] == level.upper()[at.row];
  const double by = missed(fixed, i, hierarchy, x);
  const double rounding = is_equality ? kTolerances.tight * (1.0 + x.norm()) : 0.0;
  return by * force < 0.0 && std::abs(by) > rounding;
}

/// The rows that hold a level, as in `copy_pinned`: violated limits hold only outwards, so they are
/// in T.
struct Pinned {
  explicit Pinned(Index unknowns) : fixed(unknowns), touching(unknowns) {}

  RowSet fixed, touching;
  bool has_missed_limits = false;
};

Pinned pinned(const Hierarchy& hierarchy, const VectorXd& x, const RowSet& fixed,
              const RowSet& touching) {
  Pinned result(x.size());
  result.touching = touching;
  for (Index i = 0; i < fixed.rows.rows(); ++i) {
    const RowIndex at = fixed.origin[static_cast<std::size_t>(i)];
    const Level& level = hierarchy.level(at.level);
    const VectorXd row = fixed.rows.row(i);
    if (level.lower()[at.row] == level.upper()[at.row]) {
      result.fixed.add(row, at);
    } else {
      result.touching.add(missed(fixed, i, hierarchy, x) < 0.0 ? VectorXd(-row) : row, at);
      result.has_missed_limits = true;
    }
  }
  return result;
}

/// Rounding of each multiplier from the rounding of a level's gradient, element by element: of E,
/// then of T, 0 for a row of T that doesn't push. Long rows of the level have no effect in
/// directions orthogonal to them.
VectorXd noise(const Level& level, const VectorXd& x, const RowSet& fixed, const RowSet& touching,
               const VectorXd& mu) {
  VectorXd of_gradient = VectorXd::Zero(x.size());
  for (Index i = 0; i < level.num_rows(); ++i) {
    const double value = level.A().row(i).dot(x);
    const double size = level.A().row(i).norm() * (1.0 + x.norm());
    const double lower = value - level.lower()[i], upper = value - level.upper()[i];
    const double near = kTolerances.tight * size;
    if (level.lower()[i] != level.upper()[i] && lower > near && upper < -near) continue;
    const double by = std::max({0.0, upper, -lower});
    of_gradient += 100.0 * kEpsilon * (by + size) * level.A().row(i).transpose().cwiseAbs();
  }
  const Index num_fixed = fixed.rows.rows();
  const std::vector<Index> held = pushing(mu);
  Eigen::MatrixXd rows(num_fixed + static_cast<Index>(held.size()), x.size());
  rows << fixed.rows, touching.rows(held, Eigen::all);
  VectorXd result = VectorXd::Zero(num_fixed + mu.size());
  if (rows.rows() == 0) return result;
  const VectorXd of_rows =
      rows.transpose().completeOrthogonalDecomposition().pseudoInverse().cwiseAbs() * of_gradient;
  result.head(num_fixed) = of_rows.head(num_fixed);
  result.tail(mu.size())(held) = of_rows.tail(of_rows.size() - num_fixed);
  return result;
}

bool is_of(const DistinctBlocker& blocker, RowIndex at) {
  return blocker.at == at || std::ranges::find(blocker.same, at) != blocker.same.end();
}

struct Candidate {
  DistinctBlocker blocker;
  bool is_certain = false;  ///< of its multiplier; otherwise only a cost counts
};

/// Rows above with a multiplier, scaled back from length 1 to their own length. `all`: however
/// small.
std::vector<Candidate> candidates(const Hierarchy& hierarchy, std::size_t k, const VectorXd& x,
                                  const LevelConditions& level, const DistinctRows& fixed,
                                  const DistinctRows& touching, bool all) {
  std::vector<Candidate> result;
  const Multipliers found = multipliers(level, fixed.rows, touching.rows, kTolerances.rank);
  const VectorXd least = noise(hierarchy.level(k), x, fixed.rows, touching.rows, found.touching);
  const auto add = [&](const DistinctRows& of, const VectorXd& strength, Index first,
                       bool is_fixed) {
    for (Index i = 0; i < strength.size(); ++i) {
      const bool is_certain = std::abs(strength[i]) > kClearMultiplier * level.rounding;
      const double enough = all ? 0.0 : kClearMultiplier * least[first + i];
      if (!is_certain && std::abs(strength[i]) <= enough) continue;
      const RowIndex at = of.rows.origin[static_cast<std::size_t>(i)];
      const double size = hierarchy.level(at.level).A().row(at.row).norm();
      const bool gains = is_fixed && would_gain(of.rows, i, strength[i], hierarchy, x);
      result.push_back({{{.at = at, .multiplier = std::abs(strength[i]) / size},
                         of.same[static_cast<std::size_t>(i)],
                         gains},
                        is_certain});
    }
  };
  // Limits first: at equal cost they are what one can change.
  add(touching, found.touching, fixed.rows.rows.rows(), false);
  add(fixed, found.fixed, 0, true);
  return result;
}

template <typename Predicate>
RowSet without(const RowSet& rows, const Predicate& is_left_out) {
  RowSet result(rows.rows.cols());
  for (Index i = 0; i < rows.rows.rows(); ++i) {
    const RowIndex at = rows.origin[static_cast<std::size_t>(i)];
    if (!is_left_out(at)) result.add(rows.rows.row(i).transpose(), at);
  }
  return result;
}

/// Is there a violation beyond rounding?
bool is_missed(const Level& level, const VectorXd& x) {
  for (Index i = 0; i < level.num_rows(); ++i) {
    const double value = level.A().row(i).dot(x);
    const double by = std::max(value - level.upper()[i], level.lower()[i] - value);
    if (by > kMinCost * level.A().row(i).norm() * x.norm()) return true;
  }
  return false;
}

/// The same, plus rows that appear only if violated limits hold merely outwards. If the level gains
/// without a row, every choice of multipliers then has one for it, so the found one has all such
/// rows.
std::vector<Candidate> all_candidates(const Hierarchy& hierarchy, std::size_t k, const VectorXd& x,
                                      const LevelConditions& level, const RowSet& fixed,
                                      const RowSet& touching, bool all) {
  std::vector<Candidate> list =
      candidates(hierarchy, k, x, level, distinct_fixed(fixed, hierarchy, x),
                 distinct_touching(touching, hierarchy, x), all);
  const Pinned rows = pinned(hierarchy, x, fixed, touching);
  if (!rows.has_missed_limits) return list;
  const std::vector<Candidate> more =
      candidates(hierarchy, k, x, level, distinct_fixed(rows.fixed, hierarchy, x),
                 distinct_touching(rows.touching, hierarchy, x), all);
  const std::size_t num_first = list.size();
  for (Candidate candidate : more) {
    const auto is_known = [&](const Candidate& other) {
      return is_of(other.blocker, candidate.blocker.at);
    };
    if (std::any_of(list.begin(), list.begin() + static_cast<Index>(num_first), is_known)) continue;
    candidate.is_certain = false;  // listed only for its cost
    list.push_back(std::move(candidate));
  }
  return list;
}

/// Rows that hold the level in place of the listed ones, without which it would gain nothing. Found
/// by repeatedly searching multipliers after their removal.
std::vector<Candidate> others_that_hold(const Hierarchy& hierarchy, std::size_t k,
                                        const VectorXd& x, const LevelConditions& level,
                                        const RowSet& fixed, const RowSet& touching,
                                        std::vector<DistinctBlocker> named) {
  const Pinned rows = pinned(hierarchy, x, fixed, touching);
  const auto is_named = [&](RowIndex at) {
    return std::ranges::any_of(named,
                               [&](const DistinctBlocker& blocker) { return is_of(blocker, at); });
  };
  std::vector<Candidate> others;
  while (
      !(level.residual - residual_without(hierarchy, k, x, is_named) > kMinCost * level.residual)) {
    const RowSet left_fixed = without(rows.fixed, is_named);
    const RowSet left_touching = without(rows.touching, is_named);
    const std::vector<Candidate> found =
        candidates(hierarchy, k, x, level, distinct_fixed(left_fixed, hierarchy, x),
                   distinct_touching(left_touching, hierarchy, x), false);
    if (found.empty()) break;
    for (const Candidate& candidate : found) named.push_back(candidate.blocker);
    others.insert(others.end(), found.begin(), found.end());
  }
  return others;
}

/// In the units of x.
std::vector<LevelExplanation> explain_as_given(const Hierarchy& hierarchy, const VectorXd& x,
                                               const ExplainOptions& options) {
  std::vector<LevelExplanation> explanations;
  RowSet fixed(hierarchy.unknowns());
  RowSet touching(hierarchy.unknowns());
  // As in `certify`, with pushing rows in E: they leave the level its free directions.
  RowSet settled(hierarchy.unknowns());
  RowSet open(hierarchy.unknowns());
  for (std::size_t k = 0; k < std::min(hierarchy.num_levels(), options.levels); ++k) {
    LevelConditions level = optimality_conditions(hierarchy, k, x, kTolerances.tight);
    LevelExplanation result{
        .residual = level.residual, .blocked_by = {}, .cost_of_level = std::vector<double>(k, 0.0)};
    const auto cost = [&](const auto& is_without) {
      const double fall = level.residual - residual_without(hierarchy, k, x, is_without);
      return fall < 0.0 ? 0.0 : fall;
    };
    const DistinctRows held = held_rows(fixed, touching, hierarchy, x);
    const VectorXd own = independence(held.rows.rows.transpose());
    const auto add = [&](const std::vector<Candidate>& list) {
      double done = 0.0;
      for (const auto& [candidate, is_certain] : list) {
        if (options.progress)
          options.progress(static_cast<double>(k) + done++ / static_cast<double>(list.size()));
        DistinctBlocker blocker = candidate;
        blocker.independence = own[held.place_of(blocker.at)];
        blocker.cost = cost([&](RowIndex at) { return is_of(blocker, at); });
        if (!is_certain && !(blocker.cost > kMinCost * level.residual)) continue;
        double& of_level = result.cost_of_level[blocker.at.level];
        if (of_level == 0.0)
          of_level = cost([&](RowIndex at) { return at.level == blocker.at.level; });
        result.blocked_by.push_back(std::move(blocker));
      }
    };
    const auto find = [&](bool all) {
      add(all_candidates(hierarchy, k, x, level, fixed, touching, all));
    };
    find(false);
    // Try this before claiming that nothing above holds it back.
    const bool may_be_held = k > 0 && result.blocked_by.empty() && is_missed(hierarchy.level(k), x);
    if (may_be_held && cost([](RowIndex) { return true; }) > kMinCost * level.residual) find(true);
    const auto costs = [&](const Blocker& row) {
      return !(row.cost <= kMinCost * level.residual);  // NaN too
    };
    if (!result.blocked_by.empty() && std::ranges::none_of(result.blocked_by, costs))
      add(others_that_hold(hierarchy, k, x, level, fixed, touching, result.blocked_by));
    std::stable_sort(result.blocked_by.begin(), result.blocked_by.end(),
                     [](const Blocker& a, const Blocker& b) {
                       return a.cost > b.cost || (std::isnan(b.cost) && !std::isnan(a.cost));
                     });
    explanations.push_back(std::move(result));
    fix_pushing(multipliers(level, settled, open, kTolerances.rank), settled, open);
    fix_violated(hierarchy.level(k), x, settled, kTolerances.rank, level);
    settled.add(level.fixed);
    open.add(level.touching);
    fixed.add(level.fixed);
    touching.add(level.touching);
  }
  return explanations;
}

}  // namespace

std::vector<LevelExplanation> explain(const Hierarchy& hierarchy, const VectorXd& x,
                                      const ExplainOptions& options) {
  const VectorXd units = even_units(hierarchy);
  if ((units.array() == 1.0).all()) return explain_as_given(hierarchy, x, options);
  return explain_as_given(in_units(hierarchy, units), x.cwiseQuotient(units), options);
}

}  // namespace surefoot::solver
