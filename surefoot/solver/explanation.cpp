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
/// Relative to the scale of a level: a smaller gradient is one of rounding.
constexpr double kSmall = 1e-9;

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
  const double lower = from.lower()[i];
  const double upper = from.upper()[i];
  const double near = kTolerances.tight * from.A().row(i).norm() * (1.0 + x.norm());
  const bool is_fixed = lower == upper || value < lower - near || value > upper + near;
  copy(from, i, is_fixed ? value : std::min(lower, value),
       is_fixed ? value : std::max(upper, value), to);
}

/// Residual of `level` when the levels before it hold what they have at x, but for the rows that
/// `is_without` names.
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
    copy(own, i, own.lower()[i], own.upper()[i], question.level(1));
  }
  CascadeSolver solver(question);
  return solver.solve(question).levels[1].residual;
}

/// Rows above with a multiplier; those of length 1 become rows of their own length again.
std::vector<Blocker> blockers(const Hierarchy& hierarchy, const LevelConditions& level,
                              const RowSet& fixed, const RowSet& touching) {
  std::vector<Blocker> result;
  const Multipliers found = multipliers(level, fixed, touching, kTolerances.rank);
  const auto add = [&](const RowSet& rows, const VectorXd& strength) {
    for (Index i = 0; i < strength.size(); ++i) {
      if (std::abs(strength[i]) <= kSmall * level.scale) continue;
      const RowIndex at = rows.origin[static_cast<std::size_t>(i)];
      const double size = hierarchy.level(at.level).A().row(at.row).norm();
      result.push_back({at, std::abs(strength[i]) / size, 0.0});
    }
  };
  add(touching, found.touching);  // limits first: of equal cost they are what one can change
  add(fixed, found.fixed);
  return result;
}

}  // namespace

std::vector<LevelExplanation> explain(const Hierarchy& hierarchy, const VectorXd& x) {
  std::vector<LevelExplanation> explanations;
  RowSet fixed(hierarchy.unknowns());
  RowSet touching(hierarchy.unknowns());
  for (std::size_t k = 0; k < hierarchy.num_levels(); ++k) {
    const LevelConditions level = optimality_conditions(hierarchy, k, x, kTolerances.tight);
    LevelExplanation result{.residual = level.residual,
                            .blocked_by = blockers(hierarchy, level, fixed, touching),
                            .cost_of_level = std::vector<double>(k, 0.0)};
    const auto cost = [&](const auto& is_without) {
      return std::max(0.0, level.residual - residual_without(hierarchy, k, x, is_without));
    };
    for (Blocker& blocker : result.blocked_by) {
      blocker.cost = cost(
          [&](RowIndex at) { return at.level == blocker.at.level && at.row == blocker.at.row; });
      double& of_level = result.cost_of_level[blocker.at.level];
      if (of_level == 0.0)
        of_level = cost([&](RowIndex at) { return at.level == blocker.at.level; });
    }
    std::stable_sort(result.blocked_by.begin(), result.blocked_by.end(),
                     [](const Blocker& a, const Blocker& b) { return a.cost > b.cost; });
    explanations.push_back(std::move(result));
    fixed.add(level.fixed);
    touching.add(level.touching);
  }
  return explanations;
}

}  // namespace surefoot
