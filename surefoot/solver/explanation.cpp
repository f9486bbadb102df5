#include "surefoot/solver/explanation.hpp"

#include "surefoot/solver/cascade_solver.hpp"
#include "surefoot/solver/certificate.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot {
namespace {

using Index = Eigen::Index;
using Eigen::VectorXd;

constexpr CertificateOptions kTolerances;
/// Relative to what rounding makes of a level's gradient: a smaller multiplier is none.
constexpr double kSmall = 5e4;

/// A row with the bounds that x leaves it: of the rows' steps from x, not of x itself.
void copy(const Level& from, Index i, double lower, double upper, Level& to) {
  Rows row = to.add(1, 0);
  row.A.row(0) = from.A().row(i);
  row.lower[0] = lower;
  row.upper[0] = upper;
}

/// Copies a row as it stands at x: what is missed stays as it is, what is met stays met. A limit
/// that is missed by no more than rounding is met.
void copy_pinned(const Level& from, Index i, const VectorXd& x, Level& to) {
  const double value = from.A().row(i).dot(x);
  const double lower = from.lower()[i] - value;
  const double upper = from.upper()[i] - value;
  const double near = kTolerances.tight * from.A().row(i).norm() * (1.0 + x.norm());
  const bool is_fixed = from.lower()[i] == from.upper()[i] || lower > near || upper < -near;
  copy(from, i, is_fixed ? 0.0 : std::min(lower, 0.0), is_fixed ? 0.0 : std::max(upper, 0.0), to);
}

/// NaN unless the search comes to an end. Residual of `level` when the levels before it hold what
/// they have at x, but for the rows that `is_without` names. Solved for the step from x, because no
/// step at all keeps what they have: the search for a point that does, from 0, is most of the time
/// otherwise.
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

/// Of each row of E, then of each of T; that of a row of T that doesn't push is 1.
VectorXd independences(const RowSet& fixed, const RowSet& touching, const VectorXd& mu) {
  const Index num_fixed = fixed.rows.rows();
  const std::vector<Index> held = pushing(mu);
  Eigen::MatrixXd rows(num_fixed + static_cast<Index>(held.size()), fixed.rows.cols());
  rows << fixed.rows, touching.rows(held, Eigen::all);
  const VectorXd of_rows = independence(rows.transpose());
  VectorXd result = VectorXd::Ones(num_fixed + mu.size());
  result.head(num_fixed) = of_rows.head(num_fixed);
  result.tail(mu.size())(held) = of_rows.tail(of_rows.size() - num_fixed);
  return result;
}

/// Rows above with a multiplier; those of length 1 become rows of their own length again.
std::vector<Blocker> blockers(const Hierarchy& hierarchy, const LevelConditions& level,
                              const RowSet& fixed, const RowSet& touching) {
  std::vector<Blocker> result;
  const Multipliers found = multipliers(level, fixed, touching, kTolerances.rank);
  const VectorXd independence = independences(fixed, touching, found.touching);
  const auto add = [&](const RowSet& rows, const VectorXd& strength, Index first) {
    for (Index i = 0; i < strength.size(); ++i) {
      if (std::abs(strength[i]) <= kSmall * level.rounding) continue;
      const RowIndex at = rows.origin[static_cast<std::size_t>(i)];
      const double size = hierarchy.level(at.level).A().row(at.row).norm();
      result.push_back({.at = at,
                        .multiplier = std::abs(strength[i]) / size,
                        .independence = independence[first + i]});
    }
  };
  // limits first: of equal cost they are what one can change
  add(touching, found.touching, fixed.rows.rows());
  add(fixed, found.fixed, 0);
  return result;
}

}  // namespace

std::vector<LevelExplanation> explain(const Hierarchy& hierarchy, const VectorXd& x,
                                      const ExplainOptions& options) {
  std::vector<LevelExplanation> explanations;
  RowSet fixed(hierarchy.unknowns());
  RowSet touching(hierarchy.unknowns());
  for (std::size_t k = 0; k < std::min(hierarchy.num_levels(), options.levels); ++k) {
    const LevelConditions level = optimality_conditions(hierarchy, k, x, kTolerances.tight);
    LevelExplanation result{.residual = level.residual,
                            .blocked_by = blockers(hierarchy, level, fixed, touching),
                            .cost_of_level = std::vector<double>(k, 0.0)};
    const auto cost = [&](const auto& is_without) {
      const double fall = level.residual - residual_without(hierarchy, k, x, is_without);
      return fall < 0.0 ? 0.0 : fall;
    };
    double done = 0.0;
    for (Blocker& blocker : result.blocked_by) {
      if (options.progress) {
        options.progress(static_cast<double>(k) +
                         done++ / static_cast<double>(result.blocked_by.size()));
      }
      blocker.cost = cost(
          [&](RowIndex at) { return at.level == blocker.at.level && at.row == blocker.at.row; });
      double& of_level = result.cost_of_level[blocker.at.level];
      if (of_level == 0.0)
        of_level = cost([&](RowIndex at) { return at.level == blocker.at.level; });
    }
    std::stable_sort(result.blocked_by.begin(), result.blocked_by.end(),
                     [](const Blocker& a, const Blocker& b) {
                       return a.cost > b.cost || (std::isnan(b.cost) && !std::isnan(a.cost));
                     });
    explanations.push_back(std::move(result));
    fixed.add(level.fixed);
    touching.add(level.touching);
  }
  return explanations;
}

}  // namespace surefoot
