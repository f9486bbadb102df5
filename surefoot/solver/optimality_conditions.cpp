#include "surefoot/solver/optimality_conditions.hpp"

#include "surefoot/solver/index.hpp"
#include "surefoot/solver/non_negative_least_squares.hpp"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <utility>

namespace surefoot::solver {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Of sums over a row's elements, relative to ‖a‖ ‖x‖.
constexpr double kRounding = 100.0 * kEpsilon;
/// Largest stationarity from rounding of g.
constexpr double kRoundingStationarity = 1e-8;

/// Signed violation of a row: positive above, negative below; NaN for NaN.
double violation(double value, double lower, double upper) {
  if (value > upper) return value - upper;
  return value >= lower ? 0.0 : value - lower;
}

/// Rows uᵢ aᵢ, given with the lengths of aᵢ, the longest first, so that a QR preserves short rows.
MatrixXd in_units(const Level& level, std::vector<std::pair<double, Index>> counting,
                  const VectorXd& x) {
  std::ranges::sort(counting, std::greater<>());
  MatrixXd rows(static_cast<Index>(counting.size()), level.A().cols());
  for (Index k = 0; k < rows.rows(); ++k) {
    const auto row = level.A().row(counting[static_cast<std::size_t>(k)].second);
    rows.row(k) = row_unit(row, x) * row;
  }
  return rows;
}

/// Row space and null space of rows of length 1, by Eigen's decomposition: shares no code with a
/// solver.
class RowSpace {
 public:
  RowSpace(const MatrixXd& rows, double rank) : Q_(MatrixXd::Identity(rows.cols(), rows.cols())) {
    if (rows.rows() == 0) return;
    qr_.setThreshold(rank);
    qr_.compute(rows.transpose());
    used_ = qr_.rank();
    Q_.applyOnTheLeft(qr_.householderQ());
  }

  /// Z: an orthonormal basis of the null space.
  [[nodiscard]] MatrixXd free() const { return Q_.rightCols(Q_.cols() - used_); }

  /// Multipliers of independent rows for c's part in the row space; the others are 0.
  [[nodiscard]] VectorXd multipliers_of(const VectorXd& c) const {
    if (used_ == 0) return VectorXd::Zero(0);
    const auto R = qr_.matrixR().topLeftCorner(used_, used_);
    return R.triangularView<Eigen::Upper>().solve(Q_.leftCols(used_).transpose() * c);
  }

 private:
  Eigen::ColPivHouseholderQR<MatrixXd> qr_;
  MatrixXd Q_;
  Index used_ = 0;
};

/// b after the step that minimises ‖A y + b‖.
VectorXd left_over(const MatrixXd& A, const VectorXd& b) {
  if (A.rows() == 0 || A.cols() == 0) return b;
  Eigen::ColPivHouseholderQR<MatrixXd> qr;
  qr.setThreshold(kRounding);
  qr.compute(A);
  VectorXd rest = qr.householderQ().adjoint() * b;
  rest.head(qr.rank()).setZero();
  return qr.householderQ() * rest;
}

/// Rows of a level and their violations.
struct Violations {
  std::vector<Index> rows;
  MatrixXd A;
  VectorXd by;
};

/// Violations of the rows selected by `counts`.
Violations violations(const Level& level, const VectorXd& x, const std::vector<bool>& counts) {
  Violations result;
  for (Index i = 0; i < level.num_rows(); ++i) {
    if (counts[static_cast<std::size_t>(i)]) result.rows.push_back(i);
  }
  const auto count = static_cast<Index>(result.rows.size());
  result.A.resize(count, level.unknowns());
  result.by.resize(count);
  for (Index k = 0; k < count; ++k) {
    const Index i = result.rows[static_cast<std::size_t>(k)];
    result.A.row(k) = level.A().row(i);
    result.by[k] = violation(level.A().row(i).dot(x), level.lower()[i], level.upper()[i]);
  }
  return result;
}

/// Measures g in the space of Z by violations, or rounding of size w: Rᵀ R = I + Zᵀ U² Z / w² with
/// the rows `U` = uᵢ aᵢ, up to an order of the columns.
class Measure {
 public:
  Measure(const MatrixXd& U, const MatrixXd& Z, double w) : qr_(stacked(U, Z, w)) {}

  /// R⁻ᵀ of each column.
  [[nodiscard]] MatrixXd of(const MatrixXd& columns) const {
    MatrixXd result = qr_.colsPermutation().transpose() * columns;
    const auto R = qr_.matrixR().topRows(columns.rows());
    R.triangularView<Eigen::Upper>().transpose().solveInPlace(result);
    return result;
  }

 private:
  static MatrixXd stacked(const MatrixXd& U, const MatrixXd& Z, double w) {
    MatrixXd rows(U.rows() + Z.cols(), Z.cols());
    rows << U / w * Z, MatrixXd::Identity(Z.cols(), Z.cols());
    return rows;
  }

  Eigen::ColPivHouseholderQR<MatrixXd> qr_;
};

}  // namespace

void RowSet::add(const VectorXd& row, RowIndex from) {
  rows.conservativeResize(rows.rows() + 1, Eigen::NoChange);
  rows.bottomRows(1) = row.transpose();
  origin.push_back(from);
}

void RowSet::add(const RowSet& other) {
  rows.conservativeResize(rows.rows() + other.rows.rows(), Eigen::NoChange);
  rows.bottomRows(other.rows.rows()) = other.rows;
  origin.insert(origin.end(), other.origin.begin(), other.origin.end());
}

double row_unit(const Eigen::Ref<const Eigen::RowVectorXd>& row, const VectorXd& x) {
  constexpr double kShareOfX = 1e-3;
  return row.cwiseAbs().dot(x.cwiseAbs()) + row.norm() * (1.0 + kShareOfX * x.norm());
}

LevelConditions optimality_conditions(const Hierarchy& hierarchy, std::size_t k, const VectorXd& x,
                                      double tight) {
  const Index n = hierarchy.unknowns();
  LevelConditions result{.gradient = VectorXd::Zero(n),
                         .in_units = MatrixXd(0, n),
                         .fixed = RowSet(n),
                         .touching = RowSet(n)};
  const Level& level = hierarchy.level(k);
  const double x_size = 1.0 + x.norm();
  double sum_of_squares = 0.0;
  std::vector<std::pair<double, Index>> counting;  // those through which an error of x enters g
  for (Index i = 0; i < level.num_rows(); ++i) {
    const VectorXd row = level.A().row(i).transpose();
    const double value = row.dot(x);
    const double lower = level.lower()[i];
    const double upper = level.upper()[i];
    const double v = violation(value, lower, upper);
    const double size = row.norm();
    const double near = tight * row_unit(level.A().row(i), x);
    result.gradient += v * row;
    sum_of_squares += v * v;
    if (size == 0.0) continue;
    if (lower == upper || value >= upper - near || value <= lower + near) {
      counting.emplace_back(size, i);
      result.pull += size * std::abs(v);
      result.rounding += kRounding * size * (std::abs(v) + size * x_size);
    }
    if (lower == upper || std::abs(v) > near) {
      result.fixed.add(row / size, {k, i});
      continue;
    }
    if (value >= upper - near) result.touching.add(row / size, {k, i});
    if (value <= lower + near) result.touching.add(-row / size, {k, i});
  }
  if (!counting.empty()) {
    const double shortest = std::ranges::min(counting).first;
    result.pull += shortest * shortest * x_size;
  }
  result.in_units = in_units(level, std::move(counting), x);
  result.residual = std::sqrt(sum_of_squares);
  return result;
}

std::vector<Index> pushing(const VectorXd& mu) {
  std::vector<Index> result;
  for (Index j = 0; j < mu.size(); ++j) {
    if (mu[j] > 0.0) result.push_back(j);
  }
  return result;
}

VectorXd independence(const MatrixXd& columns) {
  const Index count = columns.cols();
  if (count == 0) return VectorXd(0);
  const auto decomposition = columns.completeOrthogonalDecomposition();
  const MatrixXd inverse = decomposition.pseudoInverse();
  const VectorXd growth = inverse.rowwise().norm();
  VectorXd result = growth.cwiseInverse();
  if (decomposition.rank() == count) return result;
  const MatrixXd by_others = MatrixXd::Identity(count, count) - inverse * columns;
  for (Index j = 0; j < count; ++j) {
    if (by_others.row(j).norm() > kRounding * growth[j]) result[j] = 0.0;
  }
  return result;
}

Multipliers multipliers(const LevelConditions& level, const RowSet& fixed, const RowSet& touching,
                        double rank) {
  Multipliers result;
  result.fixed = VectorXd::Zero(fixed.rows.rows());
  result.touching = result.rounding = VectorXd::Zero(touching.rows.rows());
  const RowSpace space(fixed.rows, rank);
  const MatrixXd Z = space.free();
  if (Z.cols() > 0 && level.pull > 0.0 && std::isfinite(level.rounding)) {
    MatrixXd generators = (touching.rows * Z).transpose();
    for (auto generator : generators.colwise()) {
      if (generator.norm() <= rank) generator.setZero();  // dependent on E, up to rounding
    }
    double forces = 0.0;
    for (int pass = 0; pass < 2; ++pass) {  // the first pass finds the size of the multipliers
      const double w = kRounding * (level.pull + forces) / kRoundingStationarity;
      const Measure measure(level.in_units, Z, w);
      const VectorXd target = -Z.transpose() * level.gradient / w;
      const VectorXd mu = non_negative_least_squares(measure.of(generators), measure.of(target));
      const VectorXd rest = generators * mu - target;
      result.touching = w * mu;
      result.distance = w * rest.norm();
      result.stationarity = measure.of(rest).norm();
      const VectorXd held = level.gradient + touching.rows.transpose() * result.touching;
      forces = result.touching.sum() + space.multipliers_of(held).lpNorm<1>();
    }
    const std::vector<Index> held = pushing(result.touching);
    result.rounding(held) = (level.rounding + kRounding * forces + 10.0 * result.distance) *
                            independence(generators(Eigen::all, held)).cwiseInverse();
  }
  if (fixed.rows.rows() > 0) {
    const VectorXd rest = -level.gradient - touching.rows.transpose() * result.touching;
    result.fixed = fixed.rows.transpose().completeOrthogonalDecomposition().solve(rest);
  }
  return result;
}

void fix_pushing(const Multipliers& multipliers, RowSet& fixed, RowSet& touching) {
  RowSet rest(touching.rows.cols());
  for (Index i = 0; i < touching.rows.rows(); ++i) {
    RowSet& to = multipliers.touching[i] > multipliers.rounding[i] ? fixed : rest;
    to.add(touching.rows.row(i).transpose(), touching.origin[static_cast<std::size_t>(i)]);
  }
  touching = std::move(rest);
}

void fix_violated(const Level& rows, const VectorXd& x, const RowSet& fixed, double rank,
                  LevelConditions& level) {
  const auto beyond = [&](Index i) {
    return violation(rows.A().row(i).dot(x), rows.lower()[i], rows.upper()[i]);
  };
  std::vector<bool> counts(static_cast<std::size_t>(rows.num_rows()), false);
  for (const RowIndex at : level.fixed.origin) counts[static_cast<std::size_t>(at.row)] = true;
  std::set<Index> candidates;
  for (const auto [k, i] : level.touching.origin) {
    if (std::abs(beyond(i)) <= kRounding * rows.A().row(i).norm() * (1.0 + x.norm())) continue;
    counts[static_cast<std::size_t>(i)] = true;
    candidates.insert(i);
  }
  if (candidates.empty()) return;
  const MatrixXd Z = RowSpace(fixed.rows, rank).free();
  for (bool is_settled = false; !is_settled;) {
    const Violations now = violations(rows, x, counts);
    const VectorXd rest = left_over(now.A * Z, now.by);
    is_settled = true;
    for (Index k = 0; k < rest.size(); ++k) {
      const Index i = now.rows[static_cast<std::size_t>(k)];
      if (rest[k] * now.by[k] >= 0.5 * now.by[k] * now.by[k] || candidates.erase(i) == 0) continue;
      counts[static_cast<std::size_t>(i)] = false;
      is_settled = false;
    }
  }
  RowSet touching(x.size());
  for (Index j = 0; j < level.touching.rows.rows(); ++j) {
    const RowIndex at = level.touching.origin[static_cast<std::size_t>(j)];
    RowSet& to = candidates.erase(at.row) > 0 ? level.fixed : touching;  // once of two sides
    to.add(level.touching.rows.row(j).transpose(), at);
  }
  level.touching = std::move(touching);
}

VectorXd non_negative_least_squares(const MatrixXd& A, const VectorXd& b) {
  return non_negative_least_squares<double>(A, b);
}

}  // namespace surefoot::solver
