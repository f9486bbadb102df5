#include "surefoot/solver/tableau.hpp"

#include "surefoot/solver/householder.hpp"
#include "surefoot/solver/index.hpp"
#include "surefoot/solver/tolerances.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace surefoot::solver {
namespace {

template <typename Piece>
void turn_rows(Tableau& tableau, Index row, Index first, const std::vector<Rotation>& rotations) {
  const auto piece = [&](Index column) {
    return Eigen::Map<Piece>(tableau.T.col(column).data() + row);
  };
  Piece carried = piece(tableau.unknowns - 1);
  for (Index column = tableau.unknowns - 2; column >= first; --column) {
    const Rotation& rotation = rotations[at(column - first)];
    const Piece here = piece(column);
    piece(column + 1) = rotation.c * carried - rotation.s * here;
    carried = rotation.c * here + rotation.s * carried;
  }
  piece(first) = carried;
}

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

Rotation Tableau::rotate(Index row, Index first) {
  const Rotation rotation = make_rotation(T(row, first), T(row, first + 1));
  rotate_columns(rotation, T.col(first).head(num_rows), T.col(first + 1).head(num_rows));
  T(row, first + 1) = 0.0;
  return rotation;
}

void Tableau::gather(Index row, Index first, std::vector<Rotation>& rotations) {
  const Index pairs = unknowns - first - 1;
  double carried = T(row, unknowns - 1);
  for (Index k = pairs - 1; k >= 0; --k) {
    const double here = T(row, first + k);
    rotations[at(k)] = make_rotation(here, carried);
    carried = std::hypot(here, carried);
  }
  // A few rows at a time pass all rotations: each element is read and written once.
  constexpr Index kRows = 4;
  using Piece = Eigen::Array<double, kRows, 1>;
  Index i = 0;
  for (; i + kRows <= num_rows; i += kRows) turn_rows<Piece>(*this, i, first, rotations);
  for (; i < num_rows; ++i) turn_rows<Eigen::Array<double, 1, 1>>(*this, i, first, rotations);
  T.row(row).tail(pairs).setZero();
}

void Tableau::set_direction(Index first, const Eigen::Ref<const Eigen::VectorXd>& p,
                            double rounding) {
  motion.head(num_rows).noalias() = rows(first, p.size()) * p;
  const double size = p.norm();
  for (Index i = unknowns; i < num_rows; ++i) {
    const double rate = std::abs(motion[i]), unit = scale[i] * size;
    const bool is_rounding = !(unit > 0.0) || rate <= tolerance::kRounding * unit ||
                             (rate <= rounding * unit && is_dependent(i, first, rounding));
    if (is_rounding) motion[i] = 0.0;
  }
}

bool Tableau::is_dependent(Index row, Index first, double rounding) const {
  return T.row(row).segment(first, unknowns - first).norm() <= rounding * scale[row];
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

}  // namespace surefoot::solver
