#include "benchmarks/solver/qp_cascade.hpp"

#include <Eigen/QR>

namespace surefoot::benchmarks {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kRank = 1e-9;

}  // namespace

double QpCascade::regularisation = 1e-12;

void QpCascade::prepare(const solver::Hierarchy& problem) {
  levels_.assign(problem.num_levels(), {});
  const Index n = problem.unknowns();
  for (std::size_t k = 0; k < problem.num_levels(); ++k) {
    const solver::Level& level = problem.level(k);
    const auto is_equality = level.lower().array() == level.upper().array();
    const Index num_equal = is_equality.count();
    LevelData& data = levels_[k];
    data.A.resize(num_equal, n);
    data.b.resize(num_equal);
    data.D.resize(level.num_rows() - num_equal, n);
    data.lower.resize(data.D.rows());
    data.upper.resize(data.D.rows());
    for (Index i = 0, equal = 0, limit = 0; i < level.num_rows(); ++i) {
      if (is_equality[i]) {
        data.A.row(equal) = level.A().row(i);
        data.b[equal++] = level.upper()[i];
      } else {
        data.D.row(limit) = level.A().row(i);
        data.lower[limit] = level.lower()[i];
        data.upper[limit++] = level.upper()[i];
      }
    }
  }
  x_.setZero(n);
}

bool QpCascade::solve() {
  const Index n = x_.size();
  x_.setZero();
  Z_.setIdentity(n, n);
  D_.resize(0, n);
  lower_.resize(0);
  upper_.resize(0);
  for (const LevelData& level : levels_) {
    if (Z_.cols() == 0) break;
    if (!solve_level(level)) return false;
  }
  return true;
}

bool QpCascade::solve_level(const LevelData& level) {
  const MatrixXd AZ = level.A * Z_;
  if (!qp_everywhere_ && D_.rows() == 0 && level.D.rows() == 0) {
    Eigen::CompleteOrthogonalDecomposition<MatrixXd> cod;
    cod.setThreshold(kRank);
    if (AZ.rows() > 0) x_ += Z_ * cod.compute(AZ).solve(level.b - level.A * x_);
  } else if (level.A.rows() + level.D.rows() > 0) {
    form_qp(level, AZ);
    if (!solver_->solve(qp_, y_)) return false;
    x_ += Z_ * y_.head(Z_.cols());
  }
  keep_rows(level);
  shrink_null_space(AZ);
  return true;
}

/// y = (z, v)
void QpCascade::form_qp(const LevelData& level, const MatrixXd& AZ) {
  const Index nz = Z_.cols(), nv = level.D.rows(), before = D_.rows();
  qp_.H.setZero(nz + nv, nz + nv);
  qp_.H.topLeftCorner(nz, nz) = AZ.transpose() * AZ;
  qp_.H.diagonal().head(nz).array() += regularisation;
  qp_.H.diagonal().tail(nv).setOnes();
  qp_.g.setZero(nz + nv);
  qp_.g.head(nz) = AZ.transpose() * (level.A * x_ - level.b);
  qp_.C.setZero(nv + before, nz + nv);
  qp_.C.topLeftCorner(nv, nz) = level.D * Z_;
  qp_.C.topRightCorner(nv, nv).diagonal().setConstant(-1.0);
  qp_.C.bottomLeftCorner(before, nz) = D_ * Z_;
  qp_.lower.resize(nv + before);
  qp_.upper.resize(nv + before);
  const VectorXd own = level.D * x_, earlier = D_ * x_;
  qp_.lower << level.lower - own, lower_ - earlier;
  qp_.upper << level.upper - own, upper_ - earlier;
}

/// What is violated may stay so, by as much.
void QpCascade::keep_rows(const LevelData& level) {
  const Index before = D_.rows(), added = level.D.rows();
  D_.conservativeResize(before + added, Eigen::NoChange);
  lower_.conservativeResize(before + added);
  upper_.conservativeResize(before + added);
  D_.bottomRows(added) = level.D;
  lower_.tail(added) = level.lower;
  upper_.tail(added) = level.upper;
  const VectorXd value = D_ * x_;
  lower_ = lower_.cwiseMin(value);
  upper_ = upper_.cwiseMax(value);
}

void QpCascade::shrink_null_space(const MatrixXd& AZ) {
  if (AZ.rows() == 0) return;
  Eigen::ColPivHouseholderQR<MatrixXd> qr;
  qr.setThreshold(kRank);
  qr.compute(AZ.transpose());
  const MatrixXd Q = qr.householderQ();
  Z_ = (Z_ * Q.rightCols(Z_.cols() - qr.rank())).eval();
}

}  // namespace surefoot::benchmarks
