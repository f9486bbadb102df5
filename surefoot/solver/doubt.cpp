#include "surefoot/solver/doubt.hpp"

#include "surefoot/math/numbers.hpp"
#include "surefoot/solver/double_double.hpp"
#include "surefoot/solver/index.hpp"
#include "surefoot/solver/non_negative_least_squares.hpp"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>

namespace surefoot::solver {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Wide = DoubleDouble;
using WideMatrix = MatrixOf<Wide>;
using WideVector = VectorOf<Wide>;

/// Independent part of a row that may be rounding of its elements, relative to its length.
constexpr double kDependentRow = 1e-14;
/// Relative length, beyond all other rounding, for directions that no row sees.
constexpr double kUnseen = 1e-16;
/// The same, squared, for directions that a row sees: a row 1e-11 times as long as another of its
/// level still counts.
constexpr double kSeen = 1e-22;
/// A limit violated by less, relative to its `row_unit`, may be at its bound.
constexpr double kAtBound = 1e-9;

/// A power of two near a row's length, to divide by without rounding.
double size_of(const VectorXd& row) { return std::ldexp(1.0, std::ilogb(row.norm())); }

VectorXd row_of(const Hierarchy& hierarchy, RowIndex at) {
  return hierarchy.level(at.level).A().row(at.row).transpose();
}

/// The rows of a set as given, scaled by powers of two and signed as in the set.
WideMatrix exact_rows(const Hierarchy& hierarchy, const RowSet& set) {
  WideMatrix rows(set.rows.rows(), set.rows.cols());
  for (Index i = 0; i < rows.rows(); ++i) {
    const VectorXd row = row_of(hierarchy, set.origin[static_cast<std::size_t>(i)]);
    const double sign = set.rows.row(i).dot(row) < 0.0 ? -1.0 : 1.0;
    rows.row(i) = (sign / size_of(row) * row).transpose().cast<Wide>();
  }
  return rows;
}

/// Row space and null space of some rows.
struct Space {
  explicit Space(const WideMatrix& rows) : Q(WideMatrix::Identity(rows.cols(), rows.cols())) {
    if (rows.rows() == 0) return;
    qr.setThreshold(Wide(kDependentRow));
    qr.compute(rows.transpose());
    rank = qr.rank();
    Q = qr.householderQ() * Q;
  }
  [[nodiscard]] WideMatrix spanned() const { return Q.leftCols(rank); }
  [[nodiscard]] WideMatrix free() const { return Q.rightCols(Q.cols() - rank); }
  [[nodiscard]] double weakest() const {
    if (rank == 0) return 1.0;
    return std::abs(static_cast<double>(qr.matrixR()(rank - 1, rank - 1)));
  }

  Eigen::ColPivHouseholderQR<WideMatrix> qr;
  WideMatrix Q;
  Index rank = 0;
};

/// Rows of a level that are equalities, violated or at a bound, in the unit of the longest of them.
struct Counting {
  std::vector<Index> rows;
  std::vector<Wide> violations;  ///< signed
  std::vector<double> outward;   ///< of a row without violation: 1 at its upper bound, −1; else 0
  double unit = 1.0;             ///< a power of two
  double residual = 0.0;
  double scale = 0.0;     ///< residual, largest bound and longest row together
  double rounding = 0.0;  ///< of the value of a row
  double ratio = 1.0;     ///< of the lengths of the longest and the shortest

  void add(const Level& level, Index i, const VectorXd& x, double tight);
};

void Counting::add(const Level& level, Index i, const VectorXd& x, double tight) {
  const VectorXd row = level.A().row(i).transpose() / unit;
  const double lower = level.lower()[i] / unit, upper = level.upper()[i] / unit;
  Wide value = 0.0;
  for (Index j = 0; j < x.size(); ++j) value += Wide(row[j]) * Wide(x[j]);
  const Wide near = tight * row_unit(row.transpose(), x);
  const Wide above = upper == kInfinity ? Wide(-kInfinity) : value - Wide(upper);
  const Wide below = lower == -kInfinity ? Wide(-kInfinity) : Wide(lower) - value;
  const bool is_at_upper = above >= -near, is_at_lower = below >= -near;
  if (!is_at_upper && !is_at_lower) return;
  const bool is_met = above <= Wide(0.0) && below <= Wide(0.0);
  rows.push_back(i);
  violations.push_back(is_met ? Wide(0.0) : (above > Wide(0.0) ? above : -below));
  outward.push_back(!is_met || (is_at_upper && is_at_lower) ? 0.0 : (is_at_upper ? 1.0 : -1.0));
  residual = std::hypot(residual, static_cast<double>(violations.back()));
  for (const double bound : {lower, upper})
    if (std::isfinite(bound)) scale = std::max(scale, std::abs(bound));
  rounding = std::max(rounding, kEpsilon * row.cwiseAbs().dot(x.cwiseAbs()));
}

Counting counting(const Level& level, const VectorXd& x, double tight) {
  Counting result;
  const VectorXd lengths = level.A().rowwise().norm();
  if (lengths.size() == 0 || lengths.maxCoeff() == 0.0) return result;
  result.unit = std::ldexp(1.0, std::ilogb(lengths.maxCoeff()));
  double longest = 0.0, shortest = kInfinity;
  for (Index i = 0; i < level.num_rows(); ++i) {
    if (lengths[i] > 0.0) result.add(level, i, x, tight);
    if (result.rows.empty() || result.rows.back() != i) continue;
    longest = std::max(longest, lengths[i]);
    shortest = std::min(shortest, lengths[i]);
  }
  if (result.rows.empty()) return result;
  result.scale += result.residual + longest / result.unit;
  result.ratio = longest / shortest;
  return result;
}

/// The same, with limits violated only by rounding at their bounds: they hold outwards, but nothing
/// stops others from pulling them inwards.
Counting at_bounds(Counting own, const Level& level, const VectorXd& x) {
  for (std::size_t k = 0; k < own.rows.size(); ++k) {
    const Index i = own.rows[k];
    const double by = static_cast<double>(own.violations[k]);
    const double size = row_unit(level.A().row(i), x) / own.unit;
    if (level.lower()[i] == level.upper()[i] || by == 0.0) continue;
    if (std::abs(by) > kAtBound * size) continue;
    own.violations[k] = 0.0;
    own.outward[k] = by > 0.0 ? 1.0 : -1.0;
  }
  return own;
}

/// False if doubles decide clearly which rows are independent, and what is left to gain.
bool is_needed(const Level& level, const Counting& own, const VectorXd& x, const RowSet& fixed,
               const RowSet& touching) {
  constexpr double kLargeRatio = 1e3;
  if (x.norm() > kLargeX || own.ratio > kLargeRatio) return true;
  const auto count = static_cast<Index>(own.rows.size());
  MatrixXd rows(fixed.rows.rows() + touching.rows.rows() + count, x.size());
  rows << fixed.rows, touching.rows, level.A()(own.rows, Eigen::all);
  rows.bottomRows(count).rowwise().normalize();
  const VectorXd left = rows.transpose().colPivHouseholderQr().matrixR().diagonal().cwiseAbs();
  return std::ranges::any_of(left,
                             [](double size) { return size > kDependentRow && size < kClearRank; });
}

/// min ½ ‖M d‖² + ½ ‖max(0, S d)‖² + gᵀ d over d with T d ≤ 0, as √(−2 of it): the gain of a step d
/// from a residual with the gradient g. By its dual, over μ, ν ≥ 0: r = g + Tᵀ μ + Sᵀ ν,
///
///     min √(rᵀ (Mᵀ M + Wᵀ W)⁻¹ r + ‖ν‖²)
///
/// with W beyond all rounding, so that the inverse exists. ∞ if a square overflows.
double gain(const WideMatrix& M, const WideMatrix& S, const WideMatrix& T, const WideVector& g,
            const WideMatrix& W) {
  const Index n = M.cols();
  WideMatrix stacked(M.rows() + W.rows(), n);
  stacked << M, W;
  const Eigen::ColPivHouseholderQR<WideMatrix> qr(stacked);
  WideMatrix columns(n, T.rows() + S.rows() + 1);
  columns << T.transpose(), S.transpose(), -g;
  columns = qr.colsPermutation().transpose() * columns;
  qr.matrixR().topRows(n).triangularView<Eigen::Upper>().transpose().solveInPlace(columns);
  WideMatrix A = WideMatrix::Zero(n + S.rows(), T.rows() + S.rows());
  A.topRows(n) = columns.leftCols(A.cols());
  A.bottomRightCorner(S.rows(), S.rows()).setIdentity();
  WideVector b = WideVector::Zero(A.rows());
  b.head(n) = columns.rightCols(1);
  const auto result = static_cast<double>((A * non_negative_least_squares<Wide>(A, b) - b).norm());
  return std::isfinite(result) ? result : kInfinity;
}

/// A level's rows in the null space of the levels above, at x.
struct Question {
  WideMatrix rows;      ///< counting rows
  WideVector gradient;  ///< Σ violation · row
  WideMatrix touching;  ///< T
  WideMatrix unseen;    ///< projects onto directions that none of them sees
};

/// Gain of a step; `units` of each row, which measure its length; `w` for directions that rows see,
/// `w_unseen` for others.
double gain(const Question& question, const Counting& own, const VectorXd& units, double w,
            double w_unseen) {
  WideMatrix M = units.cast<Wide>().asDiagonal() * question.rows;
  WideMatrix S = WideMatrix::Zero(M.rows(), M.cols());
  for (Index i = 0; i < M.rows(); ++i) {
    const double outward = own.outward[static_cast<std::size_t>(i)];
    if (outward == 0.0) continue;
    S.row(i) = M.row(i) * Wide(outward);
    M.row(i).setZero();
  }
  const WideMatrix W =
      WideMatrix::Identity(M.cols(), M.cols()) * Wide(w) + question.unseen * Wide(w_unseen);
  return gain(M, S, question.touching, question.gradient, W);
}

}  // namespace

Doubt what_doubles_hide(const Hierarchy& hierarchy, std::size_t k, const VectorXd& x, double tight,
                        const RowSet& fixed, const RowSet& touching, const VectorXd& units) {
  Doubt result;
  const Level& level = hierarchy.level(k);
  const Counting own = counting(level, x, tight);
  const bool are_given = (units.array() == 1.0).all();
  if (own.rows.empty() || (are_given && !is_needed(level, own, x, fixed, touching))) return result;
  const Space above(exact_rows(hierarchy, fixed));
  const WideMatrix Z = above.free();
  if (Z.cols() == 0) return result;
  const MatrixXd A = level.A()(own.rows, Eigen::all) / own.unit;
  const VectorXd lengths = A.rowwise().norm();
  MatrixXd directions = A;
  for (auto row : directions.rowwise()) row /= size_of(row.transpose());
  const Space seen(directions.cast<Wide>() * Z);
  WideMatrix all(fixed.rows.rows() + touching.rows.rows() + A.rows(), x.size());
  all << exact_rows(hierarchy, fixed), exact_rows(hierarchy, touching), directions.cast<Wide>();
  result.weakest = Space(all).weakest();
  const WideMatrix P = seen.spanned();
  Question question;
  question.rows = A.cast<Wide>() * Z * P * P.transpose();
  for (Index i = 0; i < lengths.size(); ++i) {  // of a dependent row only rounding is left
    if (question.rows.row(i).norm() <= Wide(kDependentRow * lengths[i]))
      question.rows.row(i).setZero();
  }
  question.unseen = WideMatrix::Identity(Z.cols(), Z.cols()) - P * P.transpose();
  question.touching = exact_rows(hierarchy, touching) * Z;
  for (auto row : question.touching.rowwise()) {
    if (row.norm() <= Wide(kDependentRow)) row.setZero();
  }
  const double scale = own.scale;
  const auto set_gradient = [&](const Counting& of) {
    const auto count = static_cast<Index>(of.violations.size());
    question.gradient =
        question.rows.transpose() * Eigen::Map<const WideVector>(of.violations.data(), count);
  };
  VectorXd sizes(A.rows());
  for (Index i = 0; i < A.rows(); ++i) sizes[i] = row_unit(A.row(i), x);
  const auto stationarity = [&](const Counting& of) {
    set_gradient(of);
    return gain(question, of, sizes, kSeen * scale * scale, kUnseen * scale * scale);
  };
  result.stationarity = std::max(stationarity(own), stationarity(at_bounds(own, level, x)));
  set_gradient(own);
  const double gained = gain(question, own, VectorXd::Ones(lengths.size()), kUnseen * scale, 0.0);
  const double squared = own.residual * own.residual - gained * gained;
  const double least = squared > 0.0 ? std::sqrt(squared) : 0.0;
  // A row may be much longer than given, if the units suit a level above it.
  const MatrixXd as_given = A * units.cwiseInverse().asDiagonal();
  const double excess = lengths.maxCoeff() - as_given.rowwise().norm().maxCoeff();
  const double shorter = own.scale - std::max(excess, 0.0);
  result.residual = std::max(own.residual - least, own.rounding) / shorter;
  return result;
}

}  // namespace surefoot::solver
