#include "surefoot/solver/certificate.hpp"

#include "surefoot/solver/null_space.hpp"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <limits>

namespace surefoot {
namespace {

using Index = Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Rows collected one by one.
class RowList {
 public:
  explicit RowList(Index columns) : rows_(0, columns) {}
  void add(const VectorXd& row) {
    rows_.conservativeResize(rows_.rows() + 1, Eigen::NoChange);
    rows_.bottomRows(1) = row.transpose();
  }
  [[nodiscard]] const MatrixXd& rows() const { return rows_; }

 private:
  MatrixXd rows_;
};

/// Signed violation of a row: positive above, negative below.
double violation(double value, double lower, double upper) {
  return std::max(0.0, value - upper) - std::max(0.0, lower - value);
}

double distance_to_cone(const VectorXd& g, const MatrixXd& E, const MatrixXd& T,
                        const CertificateOptions& options) {
  const MatrixXd Z = null_space(E, options.rank);
  if (Z.cols() == 0) return 0.0;
  const VectorXd target = -Z.transpose() * g;
  const MatrixXd generators = (T * Z).transpose();
  const VectorXd mu = non_negative_least_squares(generators, target);
  return (generators * mu - target).norm();
}

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

std::vector<LevelCertificate> certify(const Hierarchy& hierarchy, const VectorXd& x,
                                      const CertificateOptions& options) {
  std::vector<LevelCertificate> certificates;
  RowList E(hierarchy.unknowns());
  RowList T(hierarchy.unknowns());
  for (std::size_t k = 0; k < hierarchy.num_levels(); ++k) {
    const Level& level = hierarchy.level(k);
    VectorXd g = VectorXd::Zero(hierarchy.unknowns());
    double sum_of_squares = 0.0;
    double scale = 1.0;
    RowList own_E(hierarchy.unknowns());
    RowList own_T(hierarchy.unknowns());
    for (Index i = 0; i < level.num_rows(); ++i) {
      const VectorXd row = level.A().row(i).transpose();
      const double value = row.dot(x);
      const double lower = level.lower()[i];
      const double upper = level.upper()[i];
      const double v = violation(value, lower, upper);
      const double size = row.norm();
      const double tight = options.tight * size * (1.0 + x.norm());
      g += v * row;
      sum_of_squares += v * v;
      scale += size * std::abs(v);
      if (size == 0.0) continue;
      if (lower == upper || std::abs(v) > tight) {
        own_E.add(row / size);
      } else if (value >= upper - tight) {
        own_T.add(row / size);
        if (value <= lower + tight) own_T.add(-row / size);
      } else if (value <= lower + tight) {
        own_T.add(-row / size);
      }
    }
    certificates.push_back(
        {std::sqrt(sum_of_squares), distance_to_cone(g, E.rows(), T.rows(), options) / scale});
    for (Index i = 0; i < own_E.rows().rows(); ++i) E.add(own_E.rows().row(i).transpose());
    for (Index i = 0; i < own_T.rows().rows(); ++i) T.add(own_T.rows().row(i).transpose());
  }
  return certificates;
}

double worst_stationarity(const std::vector<LevelCertificate>& levels) {
  double worst = 0.0;
  for (const LevelCertificate& level : levels) worst = std::max(worst, level.stationarity);
  return worst;
}

VectorXd non_negative_least_squares(const MatrixXd& A, const VectorXd& b) {
  VectorXd mu = VectorXd::Zero(A.cols());
  std::vector<Index> passive;  // where mu may be positive
  const double tolerance = 1e-14 * (1.0 + b.norm());
  for (Index iteration = 0; iteration < 3 * A.cols() + 10; ++iteration) {
    VectorXd ascent = A.transpose() * (b - A * mu);
    for (const Index j : passive) ascent[j] = -1.0;
    Index best = -1;
    if (ascent.size() == 0 || !(ascent.maxCoeff(&best) > tolerance)) break;
    passive.push_back(best);
    while (!passive.empty() && !move_to_minimum(A, b, passive, mu)) {
    }
  }
  return mu;
}

}  // namespace surefoot
