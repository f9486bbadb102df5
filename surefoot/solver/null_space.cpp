#include "surefoot/solver/null_space.hpp"

#include "surefoot/solver/row_factorization.hpp"

namespace surefoot::solver {
namespace {

// Z N(A Z) for given rows A Z and their lengths before the projection.
Eigen::MatrixXd shrink(const Eigen::MatrixXd& AZ, const Eigen::VectorXd& lengths,
                       const Eigen::MatrixXd& Z, double relative_tolerance) {
  if (AZ.rows() == 0 || Z.cols() == 0) return Z;
  RowFactorization factorization(AZ.rows(), AZ.cols());
  factorization.rows_to_fill(AZ.rows(), AZ.cols()) = AZ.transpose();
  factorization.scales_to_fill() = lengths;
  factorization.compute({relative_tolerance, relative_tolerance});
  Eigen::MatrixXd basis = Z;
  Eigen::VectorXd scratch(Z.rows());
  factorization.apply_on_the_right(basis, scratch);
  return basis.rightCols(Z.cols() - factorization.num_fixed());
}

}  // namespace

Eigen::MatrixXd null_space(const Eigen::Ref<const Eigen::MatrixXd>& A, double relative_tolerance) {
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(A.cols(), A.cols());
  return shrink(A, A.rowwise().norm(), identity, relative_tolerance);
}

Eigen::MatrixXd null_space_within(const Eigen::Ref<const Eigen::MatrixXd>& A2,
                                  const Eigen::Ref<const Eigen::MatrixXd>& Z1,
                                  double relative_tolerance) {
  return shrink(A2 * Z1, A2.rowwise().norm(), Z1, relative_tolerance);
}

}  // namespace surefoot::solver
