#include "surefoot/solver/optimality_conditions.hpp"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

namespace surefoot {
namespace {

using Index = Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
/// Of sums over a row's elements, relative to ‖a‖ ‖x‖.
constexpr double kRounding = 100.0 * kEpsilon;
/// Multipliers above this share of what pulls at all are no rounding of zero.
constexpr double kPositive = 1e-9;
/// Beside the longest row of its level, a row this much shorter is rounding of zero.
constexpr double kNoRow = 1e-13;

/// Signed violation of a row: positive above, negative below; NaN of a value that is none.
double violation(double value, double lower, double upper) {
  if (value > upper) return value - upper;
  return value >= lower ? 0.0 : value - lower;
}

/// Length of the shortest row that is one; 1 where there is none.
double shortest_row(const Level& level) {
  const VectorXd length = level.A().rowwise().norm();
  if (length.size() == 0 || !(length.maxCoeff() > 0.0)) return 1.0;
  const double least = kNoRow * length.maxCoeff();
  double shortest = length.maxCoeff();
  for (const double row : length) shortest = row > least ? std::min(shortest, row) : shortest;
  return shortest;
}

/// Rows (1 + ‖x‖) √(‖aᵢ‖² − s²) aᵢ of those longer than s, given with their lengths, the longest
/// first: in this order a QR keeps what short rows say.
MatrixXd longer_rows(const Level& level, std::vector<std::pair<double, Index>> longer,
                     double shortest, double x_size) {
  std::erase_if(longer, [&](const auto& row) { return row.first <= shortest; });
  std::ranges::sort(longer, std::greater<>());
  MatrixXd rows(static_cast<Index>(longer.size()), level.A().cols());
  for (Index k = 0; k < rows.rows(); ++k) {
    const auto [size, i] = longer[static_cast<std::size_t>(k)];
    rows.row(k) = x_size * std::sqrt((size - shortest) * (size + shortest)) * level.A().row(i);
  }
  return rows;
}

struct NullSpace {
  MatrixXd Z;
  double smallest_pivot = 1.0;
};

/// Orthonormal basis of what rows of length 1 leave free, by Eigen's own decomposition: nothing
/// here shares code with a solver.
NullSpace null_space_of(const MatrixXd& rows, double rank) {
  const Index n = rows.cols();
  if (rows.rows() == 0) return {MatrixXd::Identity(n, n)};
  Eigen::ColPivHouseholderQR<MatrixXd> decomposition(n, rows.rows());
  decomposition.setThreshold(rank);
  decomposition.compute(rows.transpose());
  MatrixXd Q = MatrixXd::Identity(n, n);
  Q.applyOnTheLeft(decomposition.householderQ());
  const Index used = decomposition.rank();
  if (used == 0) return {Q};
  return {Q.rightCols(n - used), std::abs(decomposition.matrixQR()(used - 1, used - 1))};
}

/// What an error of x does to g in the space of Z, so that directions that long rows see are
/// measured in larger units: Rᵀ R = I + Zᵀ longerᵀ longer Z / scale², up to an order of the
/// columns.
class Measure {
 public:
  Measure(const LevelConditions& level, const MatrixXd& Z) : qr_(stacked(level, Z)) {}

  /// R⁻ᵀ of each column.
  [[nodiscard]] MatrixXd of(const MatrixXd& columns) const {
    MatrixXd result = qr_.colsPermutation().transpose() * columns;
    const auto R = qr_.matrixR().topRows(columns.rows());
    R.triangularView<Eigen::Upper>().transpose().solveInPlace(result);
    return result;
  }

 private:
  static MatrixXd stacked(const LevelConditions& level, const MatrixXd& Z) {
    MatrixXd rows(level.longer.rows() + Z.cols(), Z.cols());
    rows << level.longer / level.scale * Z, MatrixXd::Identity(Z.cols(), Z.cols());
    return rows;
  }

  Eigen::ColPivHouseholderQR<MatrixXd> qr_;
};

/// Moves mu towards the minimum over its passive elements, which are > 0 there; else stops where
/// the first becomes zero, takes it out and returns false.
bool move_to_minimum(const MatrixXd& A, const VectorXd& b, std::vector<Index>& passive,
                     VectorXd& mu) {
  MatrixXd columns(A.rows(), static_cast<Index>(passive.size()));
  for (Index k = 0; k < columns.cols(); ++k)
    columns.col(k) = A.col(passive[static_cast<std::size_t>(k)]);
  const VectorXd target = columns.completeOrthogonalDecomposition().solve(b);
  double length = 1.0;
  auto first = passive.end();
  for (auto j = passive.begin(); j != passive.end(); ++j) {
    const double goal = target[j - passive.begin()];
    const double here = mu[*j];
    if (goal > 0.0) continue;
    const double zero_at = here > 0.0 ? here / (here - goal) : 0.0;
    if (zero_at >= length) continue;
    length = zero_at;
    first = j;
  }
  for (std::size_t k = 0; k < passive.size(); ++k) {
    double& here = mu[passive[k]];
    here = std::max(0.0, here + length * (target[static_cast<Index>(k)] - here));
  }
  if (first == passive.end()) return true;
  mu[*first] = 0.0;
  passive.erase(first);
  return false;
}

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

LevelConditions optimality_conditions(const Hierarchy& hierarchy, std::size_t k, const VectorXd& x,
                                      double tight) {
  const Index n = hierarchy.unknowns();
  LevelConditions result{.gradient = VectorXd::Zero(n),
                         .longer = MatrixXd(0, n),
                         .fixed = RowSet(n),
                         .touching = RowSet(n)};
  const Level& level = hierarchy.level(k);
  const double x_size = 1.0 + x.norm();
  double sum_of_squares = 0.0, sum = 0.0;
  std::vector<std::pair<double, Index>> counting;  // those that an error of x may put into g
  for (Index i = 0; i < level.num_rows(); ++i) {
    const VectorXd row = level.A().row(i).transpose();
    const double value = row.dot(x);
    const double lower = level.lower()[i];
    const double upper = level.upper()[i];
    const double v = violation(value, lower, upper);
    const double size = row.norm();
    const double near = tight * size * x_size;
    result.gradient += v * row;
    sum += std::abs(v);
    sum_of_squares += v * v;
    result.pull += std::abs(v) * size;
    result.rounding += kRounding * size * size * x_size;
    if (size == 0.0) continue;
    if (lower == upper || value >= upper - near || value <= lower + near)
      counting.emplace_back(size, i);
    if (lower == upper || std::abs(v) > near) {
      result.fixed.add(row / size, {k, i});
      continue;
    }
    if (value >= upper - near) result.touching.add(row / size, {k, i});
    if (value <= lower + near) result.touching.add(-row / size, {k, i});
  }
  const double shortest = shortest_row(level);
  result.scale = shortest * (shortest * x_size + sum);
  result.longer = longer_rows(level, std::move(counting), shortest, x_size);
  result.residual = std::sqrt(sum_of_squares);
  return result;
}

Multipliers multipliers(const LevelConditions& level, const RowSet& fixed, const RowSet& touching,
                        double rank) {
  Multipliers result;
  result.fixed = VectorXd::Zero(fixed.rows.rows());
  result.touching = VectorXd::Zero(touching.rows.rows());
  const auto [Z, smallest_pivot] = null_space_of(fixed.rows, rank);
  if (Z.cols() > 0) {
    const Measure measure(level, Z);
    const VectorXd target = -Z.transpose() * level.gradient / level.scale;
    MatrixXd generators = (touching.rows * Z).transpose();
    for (auto generator : generators.colwise()) {
      if (generator.norm() <= rank) generator.setZero();  // E has it, but for rounding
    }
    const VectorXd mu = non_negative_least_squares(measure.of(generators), measure.of(target));
    const VectorXd rest = generators * mu - target;
    result.touching = level.scale * mu;
    result.distance = level.scale * rest.norm();
    result.stationarity = measure.of(rest).norm();
    const double largest = result.touching.size() > 0 ? result.touching.maxCoeff() : 0.0;
    result.rounding = kRounding / smallest_pivot * largest;
  }
  if (fixed.rows.rows() > 0) {
    const VectorXd rest = -level.gradient - touching.rows.transpose() * result.touching;
    result.fixed = fixed.rows.transpose().completeOrthogonalDecomposition().solve(rest);
  }
  return result;
}

void fix_pushing(const LevelConditions& level, const Multipliers& multipliers, RowSet& fixed,
                 RowSet& touching) {
  const double positive =
      kPositive * level.pull + level.rounding + multipliers.rounding + 10.0 * multipliers.distance;
  RowSet rest(touching.rows.cols());
  for (Index i = 0; i < touching.rows.rows(); ++i) {
    RowSet& to = multipliers.touching[i] > positive ? fixed : rest;
    to.add(touching.rows.row(i).transpose(), touching.origin[static_cast<std::size_t>(i)]);
  }
  touching = std::move(rest);
}

// With columns and b of length 1, so that neither their units nor each other's decide.
VectorXd non_negative_least_squares(const MatrixXd& A, const VectorXd& b) {
  constexpr double kTolerance = 2e-14;
  VectorXd mu = VectorXd::Zero(A.cols());
  if (A.cols() == 0 || b.norm() == 0.0) return mu;
  const VectorXd lengths = A.colwise().norm();
  const VectorXd per_length = (lengths.array() > 0.0).select(lengths.cwiseInverse(), 0.0);
  const MatrixXd columns = A * per_length.asDiagonal();
  const VectorXd target = b / b.norm();
  std::vector<Index> passive;  // where mu may be positive
  for (Index iteration = 0; iteration < 3 * A.cols() + 10; ++iteration) {
    VectorXd ascent = columns.transpose() * (target - columns * mu);
    for (const Index j : passive) ascent[j] = -1.0;
    Index best = -1;
    if (!(ascent.maxCoeff(&best) > kTolerance)) break;
    passive.push_back(best);
    while (!passive.empty() && !move_to_minimum(columns, target, passive, mu)) {
    }
  }
  return b.norm() * mu.cwiseProduct(per_length);
}

}  // namespace surefoot
