#include "surefoot/solver/extra_rows.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/solver/index.hpp"

#include <cmath>
#include <string>

namespace surefoot::solver {
namespace {

/// A smaller independent part of a row, relative to its length, is rounding.
constexpr double kDependent = 1e-12;

void check_length(const Level& level, const Eigen::Ref<const Eigen::VectorXd>& x_ref) {
  if (x_ref.size() == level.unknowns()) return;
  throw Error("a reference of " + std::to_string(x_ref.size()) + " elements for level \"" +
              level.name() + "\"; expected " + std::to_string(level.unknowns()) +
              ", one for each unknown");
}

/// Orthonormalises the rows, from first to last; dependent rows become zero. Two passes remove
/// rounding.
void orthonormalise(Eigen::Map<Rows::RowMajor>& A) {
  for (Index i = 0; i < A.rows(); ++i) {
    const double length = A.row(i).norm();
    for (int pass = 0; pass < 2; ++pass) {
      for (Index j = 0; j < i; ++j) {
        const double along = A.row(i).dot(A.row(j));
        A.row(i) -= along * A.row(j);
      }
    }
    const double left = A.row(i).norm();
    A.row(i) *= left > kDependent * length ? 1.0 / left : 0.0;
  }
}

}  // namespace

void add_reference(Level& level, const Eigen::Ref<const Eigen::VectorXd>& x_ref, int first_id,
                   double weight) {
  check_length(level, x_ref);
  check_weight(weight, "the weight of a reference");
  Rows rows = level.add(x_ref.size(), first_id);
  rows.A.setIdentity();
  rows.lower = rows.upper = x_ref;
  rows.weigh(weight);
}

void add_damping(Level& level, double damping, const Eigen::Ref<const Eigen::VectorXd>& x_ref,
                 int first_id) {
  check_length(level, x_ref);
  check_weight(damping, "damping");
  const Index num_damped = level.num_rows();
  Rows rows = level.add(num_damped, first_id);
  rows.A = level.A().topRows(num_damped);
  for (Index i = 0; i < num_damped; ++i) {
    if (std::isinf(level.lower()[i]) && std::isinf(level.upper()[i])) rows.A.row(i).setZero();
  }
  orthonormalise(rows.A);
  for (Index i = 0; i < num_damped; ++i) rows.set_equal(i, rows.A.row(i).dot(x_ref));
  rows.weigh(damping);
}

}  // namespace surefoot::solver
