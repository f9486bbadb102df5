#include "surefoot/solver/turning_least_squares.hpp"

#include "surefoot/solver/index.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::solver {
namespace {

/// Smallest diagonal element of R, relative to the largest, that certainly is no loss of rank.
constexpr double kClearlyFullRank = 1e-6;

}  // namespace

TurningLeastSquares::TurningLeastSquares(Index max_rows, Index max_columns)
    : R_(Eigen::MatrixXd::Zero(max_rows, max_columns)), c_(Eigen::VectorXd::Zero(max_rows)) {}

bool TurningLeastSquares::start(const Eigen::Ref<const Eigen::MatrixXd>& B,
                                const Eigen::Ref<const Eigen::VectorXd>& r) {
  const Index rows = B.rows();
  num_columns_ = B.cols();
  is_running_ = false;
  if (rows < num_columns_) return false;
  c_.head(rows) = r;
  for (Index j = 0; j < num_columns_; ++j) R_.col(j).head(rows) = B.col(num_columns_ - 1 - j);
  double largest = 0.0;
  for (Index j = 0; j < num_columns_; ++j) {
    auto v = R_.col(j).segment(j, rows - j);
    const Reflection reflection = make_reflection(v);
    for (Index k = j + 1; k < num_columns_; ++k) {
      reflect(v, reflection.beta, R_.col(k).segment(j, rows - j));
    }
    reflect(v, reflection.beta, c_.segment(j, rows - j));
    v.setZero();
    v[0] = reflection.head;
    largest = std::max(largest, std::abs(reflection.head));
  }
  is_running_ = R_.diagonal().head(num_columns_).cwiseAbs().minCoeff() > kClearlyFullRank * largest;
  return is_running_;
}

void TurningLeastSquares::rotate(Index column, const Rotation& rotation) {
  const Index j = num_columns_ - 2 - column;
  rotate_columns(rotation, R_.col(j + 1).head(j + 2), R_.col(j).head(j + 2));
  // R(j + 1, j) has filled: turn the two rows until it is zero again.
  const Rotation turn = make_rotation(R_(j, j), R_(j + 1, j));
  const Index columns = num_columns_ - j;
  rotate_columns(turn, R_.row(j).segment(j, columns), R_.row(j + 1).segment(j, columns));
  rotate_columns(turn, c_.segment(j, 1), c_.segment(j + 1, 1));
  R_(j + 1, j) = 0.0;
}

void TurningLeastSquares::step(Eigen::Ref<Eigen::VectorXd> p) {
  const Index free = p.size();
  for (Index k = 0; k < free; ++k) p[free - 1 - k] = -c_[k];
  for (Index j = free - 1; j >= 0; --j) {
    double& q = p[free - 1 - j];
    q /= R_(j, j);
    for (Index i = 0; i < j; ++i) p[free - 1 - i] -= q * R_(i, j);
  }
}

}  // namespace surefoot::solver
