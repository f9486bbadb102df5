#include "surefoot/solver/tableau.hpp"

#include "surefoot/solver/householder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace surefoot {
namespace {

using Index = Eigen::Index;

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

}  // namespace

Tableau::Tableau(Index num_unknowns, Index max_rows)
    : unknowns(num_unknowns),
      T(Eigen::MatrixXd::Zero(num_unknowns + max_rows, num_unknowns)),
      value(Eigen::VectorXd::Zero(num_unknowns + max_rows)),
      lower(Eigen::VectorXd::Constant(num_unknowns + max_rows,
                                      -std::numeric_limits<double>::infinity())),
      upper(-lower),
      scale(Eigen::VectorXd::Ones(num_unknowns + max_rows)),
      motion(Eigen::VectorXd::Zero(num_unknowns + max_rows)),
      keep(at(num_unknowns + max_rows), 0),
      held(at(num_unknowns + max_rows), 0),
      scratch(Eigen::VectorXd::Zero(num_unknowns + max_rows)) {}

void Tableau::reset() {
  first_free = 0;
  level_begin = num_rows = unknowns;
  x_size = 0.0;
  T.topRows(unknowns).setIdentity();
  value.head(unknowns).setZero();
  std::fill(held.begin(), held.end(), char{0});
}

void Tableau::append(const Level& level) {
  const Index count = level.num_rows();
  level_begin = num_rows;
  num_rows += count;
  lower.segment(level_begin, count) = level.lower();
  upper.segment(level_begin, count) = level.upper();
  for (Index i = 0; i < count; ++i) {
    scale[level_begin + i] = level.A().row(i).norm();
    value[level_begin + i] = level.A().row(i).dot(value.head(unknowns));
  }
  if (first_free == 0 && level_begin == unknowns) {  // still Q = I
    T.middleRows(level_begin, count) = level.A();
    return;
  }
  for (Index j = first_free; j < unknowns; ++j) {
    T.col(j).segment(level_begin, count).noalias() = level.A() * T.col(j).head(unknowns);
  }
}

void Tableau::reflect(Index first, const Eigen::Ref<const Eigen::VectorXd>& v, double beta) {
  reflect_columns(v, beta, rows(first, v.size()), scratch.head(num_rows));
}

void Tableau::rotate(Index row, Index first) {
  rotate_columns(T(row, first), T(row, first + 1), T.col(first).head(num_rows),
                 T.col(first + 1).head(num_rows));
}

void Tableau::set_direction(Index first, const Eigen::Ref<const Eigen::VectorXd>& p,
                            double negligible) {
  motion.head(num_rows).noalias() = rows(first, p.size()) * p;
  for (Index i = unknowns; i < num_rows; ++i) {
    if (std::abs(motion[i]) <= negligible * scale[i]) motion[i] = 0.0;
  }
}

void Tableau::move(double step) {
  value.head(num_rows) += step * motion.head(num_rows);
  x_size = std::max(x_size, value.head(unknowns).norm());
}

void Tableau::retire() {
  Index to = unknowns;
  for (Index from = unknowns; from < num_rows; ++from) {
    if (!keep[at(from)]) continue;
    if (to != from) {
      T.row(to).tail(num_free()) = T.row(from).tail(num_free());
      value[to] = value[from];
      lower[to] = lower[from];
      upper[to] = upper[from];
      scale[to] = scale[from];
    }
    ++to;
  }
  level_begin = num_rows = to;
}

}  // namespace surefoot
