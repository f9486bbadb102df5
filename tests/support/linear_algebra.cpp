#include "tests/support/linear_algebra.hpp"

#include <Eigen/QR>
#include <Eigen/SVD>

namespace surefoot::test {

Eigen::Index rank(const MatX& A) { return A.colPivHouseholderQr().rank(); }

MatX least_squares(const MatX& A, const MatX& B) {
  return A.completeOrthogonalDecomposition().solve(B);
}

double condition(const MatX& A) {
  const VecX singular = A.jacobiSvd().singularValues();
  return singular[0] / singular[singular.size() - 1];
}

}  // namespace surefoot::test
