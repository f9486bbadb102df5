#include "surefoot/solver/row_factorization.hpp"

#include "surefoot/solver/householder.hpp"
#include "surefoot/solver/index.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace surefoot::solver {
namespace {

/// A downdated length below this share of its last exact value has lost half of its digits.
constexpr double kDowndateLoss = 1.5e-8;

}  // namespace

RowFactorization::RowFactorization(Index max_rows, Index max_columns)
    : K_(Eigen::MatrixXd::Zero(max_columns, max_rows)),
      scale_(Eigen::VectorXd::Zero(max_rows)),
      beta_(Eigen::VectorXd::Zero(max_columns)),
      length_(Eigen::VectorXd::Zero(max_rows)),
      reference_length_(Eigen::VectorXd::Zero(max_rows)),
      order_(at(max_rows), 0),
      v_(Eigen::VectorXd::Zero(max_columns)),
      q_(Eigen::VectorXd::Zero(max_columns)),
      G_(Eigen::MatrixXd::Zero(max_rows, std::min(max_rows, max_columns))),
      c_(Eigen::VectorXd::Zero(max_rows)),
      column_order_(at(max_columns), 0) {}

void RowFactorization::compute(const RankTolerance& tolerance) {
  rank_ = num_fixed_ = 0;
  smallest_pivot_ = 1.0;
  for (Index j = 0; j < num_rows_; ++j) {
    order_[at(j)] = j;
    length_[j] = reference_length_[j] = K_.col(j).head(num_columns_).norm();
  }
  const Index steps = std::min(num_rows_, num_columns_);
  for (Index step = 0; step < steps; ++step) {
    const Index pivot = choose_pivot(step);
    const double relative = scale_[pivot] > 0.0 ? length_[pivot] / scale_[pivot] : 0.0;
    if (!(relative > tolerance.keep)) break;
    swap_rows(step, pivot);
    eliminate(step);
    ++num_fixed_;
    if (relative > tolerance.solve) {
      ++rank_;
      smallest_pivot_ = std::min(smallest_pivot_, relative);
    }
  }
}

Index RowFactorization::choose_pivot(Index step) const {
  Index best = step;
  double best_length = -1.0;
  for (Index j = step; j < num_rows_; ++j) {
    const double relative = scale_[j] > 0.0 ? length_[j] / scale_[j] : 0.0;
    if (relative > best_length) {
      best_length = relative;
      best = j;
    }
  }
  return best;
}

void RowFactorization::swap_rows(Index i, Index j) {
  if (i == j) return;
  K_.col(i).head(num_columns_).swap(K_.col(j).head(num_columns_));
  std::swap(scale_[i], scale_[j]);
  std::swap(length_[i], length_[j]);
  std::swap(reference_length_[i], reference_length_[j]);
  std::swap(order_[at(i)], order_[at(j)]);
}

void RowFactorization::eliminate(Index step) {
  const Index size = num_columns_ - step;
  auto v = K_.col(step).segment(step, size);
  const Reflection reflection = make_reflection(v);
  beta_[step] = reflection.beta;
  for (Index j = step + 1; j < num_rows_; ++j) {
    reflect(v, reflection.beta, K_.col(j).segment(step, size));
    downdate_length(step, j);
  }
  v[0] = reflection.head;
}

void RowFactorization::downdate_length(Index step, Index row) {
  double& length = length_[row];
  if (length == 0.0) return;
  const double share = std::abs(K_(step, row)) / length;
  const double left = std::max(0.0, (1.0 - share) * (1.0 + share));
  const double loss = length / reference_length_[row];
  if (left * loss * loss <= kDowndateLoss) {
    length = K_.col(row).segment(step + 1, num_columns_ - step - 1).norm();
    reference_length_[row] = length;
  } else {
    length *= std::sqrt(left);
  }
}

void RowFactorization::least_squares_step(const Eigen::Ref<const Eigen::VectorXd>& r,
                                          Eigen::Ref<Eigen::VectorXd> p) {
  if (num_rows_ == rank_) {
    solve_triangle(r);
  } else {
    solve_trapezoid(r);
  }
  p.head(rank_) = q_.head(rank_);
  p.tail(num_columns_ - rank_).setZero();
  for (Index s = rank_ - 1; s >= 0; --s) {
    const Index size = num_columns_ - s;
    auto v = v_.head(size);
    v = K_.col(s).segment(s, size);
    v[0] = 1.0;
    reflect(v, beta_[s], p.segment(s, size));
  }
}

// L q = −P r by forward substitution; exact for rows of any scale.
void RowFactorization::solve_triangle(const Eigen::Ref<const Eigen::VectorXd>& r) {
  for (Index i = 0; i < rank_; ++i) {
    const double known = K_.col(i).head(i).dot(q_.head(i));
    q_[i] = (-r[order_[at(i)]] - known) / K_(i, i);
  }
}

// min ‖L q + P r‖ with more rows than directions. Householder QR with column pivoting and the
// longest row on top in each step: stable for rows of different scales (Powell and Reid 1969).
void RowFactorization::solve_trapezoid(const Eigen::Ref<const Eigen::VectorXd>& r) {
  auto G = G_.topLeftCorner(num_rows_, rank_);
  auto c = c_.head(num_rows_);
  for (Index i = 0; i < num_rows_; ++i) {
    const Index filled = std::min(i + 1, rank_);
    G.row(i).head(filled) = K_.col(i).head(filled).transpose();
    G.row(i).tail(rank_ - filled).setZero();
    c[i] = -r[order_[at(i)]];
  }
  for (Index j = 0; j < rank_; ++j) column_order_[at(j)] = j;
  for (Index s = 0; s < rank_; ++s) {
    pivot_trapezoid(s);
    const Index left = num_rows_ - s;
    auto v = G.col(s).tail(left);
    const Reflection reflection = make_reflection(v);
    for (Index j = s + 1; j < rank_; ++j) {
      reflect(v, reflection.beta, G.col(j).tail(left));
    }
    reflect(v, reflection.beta, c.tail(left));
    v[0] = reflection.head;
  }
  for (Index s = rank_ - 1; s >= 0; --s) {
    double sum = c[s];
    for (Index j = s + 1; j < rank_; ++j) sum -= G(s, j) * c[j];
    c[s] = G(s, s) != 0.0 ? sum / G(s, s) : 0.0;
  }
  for (Index s = 0; s < rank_; ++s) q_[column_order_[at(s)]] = c[s];
}

// Moves the longest column to place s, and its longest element to the top.
void RowFactorization::pivot_trapezoid(Index s) {
  auto G = G_.topLeftCorner(num_rows_, rank_);
  const Index left = num_rows_ - s;
  Index column = s;
  double longest = -1.0;
  for (Index j = s; j < rank_; ++j) {
    const double length = G.col(j).tail(left).squaredNorm();
    if (length > longest) {
      longest = length;
      column = j;
    }
  }
  if (column != s) {
    G.col(s).swap(G.col(column));
    std::swap(column_order_[at(s)], column_order_[at(column)]);
  }
  Index row = 0;
  G.col(s).tail(left).cwiseAbs().maxCoeff(&row);
  if (row == 0) return;
  G.row(s).swap(G.row(s + row));
  std::swap(c_[s], c_[s + row]);
}

void RowFactorization::apply_on_the_right(Eigen::Ref<Eigen::MatrixXd> T,
                                          Eigen::Ref<Eigen::VectorXd> scratch) {
  for (Index s = 0; s < num_fixed_; ++s) {
    const Index size = num_columns_ - s;
    auto v = v_.head(size);
    v = K_.col(s).segment(s, size);
    v[0] = 1.0;
    reflect_columns(v, beta_[s], T.rightCols(size), scratch);
  }
}

}  // namespace surefoot::solver
