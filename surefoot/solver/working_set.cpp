#include "surefoot/solver/working_set.hpp"

#include "surefoot/solver/householder.hpp"
#include "surefoot/solver/index.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::solver {

WorkingSet::WorkingSet(Index unknowns)
    : held_(static_cast<std::size_t>(unknowns)),
      v_(Eigen::VectorXd::Zero(unknowns)),
      rotations_(static_cast<std::size_t>(unknowns)) {}

void WorkingSet::clear(Tableau& tableau) {
  for (Index i = 0; i < size_; ++i) tableau.held[static_cast<std::size_t>(at(i).row)] = 0;
  size_ = 0;
}

void WorkingSet::add(Tableau& tableau, Index row, int side, TurningLeastSquares& least_squares) {
  if (least_squares.is_running()) {
    rotate_into_place(tableau, row, least_squares);
  } else {
    reflect_into_place(tableau, row);
  }
  tableau.held[static_cast<std::size_t>(row)] = 1;
  at(size_) = {row, side, 0.0};
  ++size_;
}

void WorkingSet::reflect_into_place(Tableau& tableau, Index row) {
  const Index first = tableau.first_free + size_;
  const Index size = tableau.unknowns - first;
  auto v = v_.head(size);
  v = tableau.T.row(row).tail(size).transpose();
  const Reflection reflection = make_reflection(v);
  tableau.reflect(first, v, reflection.beta);
  tableau.T.row(row).tail(size).setZero();
  tableau.T(row, first) = reflection.head;
}

void WorkingSet::rotate_into_place(Tableau& tableau, Index row,
                                   TurningLeastSquares& least_squares) {
  const Index first = tableau.first_free + size_;
  tableau.gather(row, first, rotations_);
  for (Index column = tableau.unknowns - 2; column >= first; --column) {
    const Rotation& rotation = rotations_[static_cast<std::size_t>(column - first)];
    least_squares.rotate(column - tableau.first_free, rotation);
  }
}

void WorkingSet::remove(Tableau& tableau, Index position, TurningLeastSquares& least_squares) {
  tableau.held[static_cast<std::size_t>(at(position).row)] = 0;
  --size_;
  for (Index i = position; i < size_; ++i) {
    at(i) = at(i + 1);
    const Rotation rotation = tableau.rotate(at(i).row, tableau.first_free + i);
    if (least_squares.is_running()) least_squares.rotate(i, rotation);
  }
}

void WorkingSet::set_forces(const Tableau& tableau, Eigen::Ref<Eigen::VectorXd> gradient) {
  for (Index i = size_ - 1; i >= 0; --i) {
    const Index row = at(i).row;
    const double force = -gradient[i] / tableau.T(row, tableau.first_free + i);
    for (Index j = 0; j < i; ++j) gradient[j] += force * tableau.T(row, tableau.first_free + j);
    at(i).force = force * at(i).side * tableau.scale[row];
  }
}

double WorkingSet::smallest_pivot(const Tableau& tableau) const {
  double smallest = 1.0;
  for (Index i = 0; i < size_; ++i) {
    const Index row = (*this)[i].row;
    const double pivot = std::abs(tableau.T(row, tableau.first_free + i)) / tableau.scale[row];
    smallest = std::min(smallest, pivot);
  }
  return smallest;
}

}  // namespace surefoot::solver
