#include "tests/support/substitutions.hpp"

#include <Eigen/QR>

namespace surefoot::test {

using Eigen::MatrixXd;

solver::Substitution substitution_of(const HierarchyData& levels, std::size_t num_levels) {
  LevelData all = levels[0];
  for (std::size_t k = 1; k < num_levels; ++k) all = joined(all, levels[k]);
  const MatrixXd Q = Eigen::HouseholderQR<MatrixXd>(all.A.transpose()).householderQ();
  solver::Substitution result;
  result.num_levels = num_levels;
  result.basis = Q.rightCols(all.A.cols() - all.A.rows());
  result.offset = all.A.completeOrthogonalDecomposition().solve(all.upper);
  return result;
}

solver::Substitution skew_substitution_of(const HierarchyData& levels, std::size_t num_levels,
                                          RandomMatrices& random) {
  solver::Substitution result = substitution_of(levels, num_levels);
  const MatrixXd N = result.basis;
  result.basis = N * random.matrix(N.cols(), N.cols());
  result.offset += N * random.vector(N.cols());
  return result;
}

}  // namespace surefoot::test
