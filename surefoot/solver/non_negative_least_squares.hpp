#pragma once

#include <Eigen/Core>
#include <Eigen/QR>

#include <vector>

namespace surefoot::solver {

/// Matrix and vector of any scalar type.
template <typename Scalar>
using MatrixOf = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
template <typename Scalar>
using VectorOf = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

/// Moves mu towards the minimum over its passive elements, as long as all stay > 0. Otherwise stops
/// where the first becomes zero, removes it and returns false.
template <typename Scalar>
bool move_to_minimum(const MatrixOf<Scalar>& A, const VectorOf<Scalar>& b,
                     std::vector<Eigen::Index>& passive, VectorOf<Scalar>& mu) {
  MatrixOf<Scalar> columns(A.rows(), static_cast<Eigen::Index>(passive.size()));
  for (Eigen::Index k = 0; k < columns.cols(); ++k)
    columns.col(k) = A.col(passive[static_cast<std::size_t>(k)]);
  const VectorOf<Scalar> target = columns.completeOrthogonalDecomposition().solve(b);
  Scalar length = 1.0;
  auto first = passive.end();
  for (auto j = passive.begin(); j != passive.end(); ++j) {
    const Scalar goal = target[j - passive.begin()];
    const Scalar here = mu[*j];
    if (goal > Scalar(0.0)) continue;
    const Scalar zero_at = here > Scalar(0.0) ? here / (here - goal) : Scalar(0.0);
    if (zero_at >= length) continue;
    length = zero_at;
    first = j;
  }
  for (std::size_t k = 0; k < passive.size(); ++k) {
    Scalar& here = mu[passive[k]];
    const Scalar moved = here + length * (target[static_cast<Eigen::Index>(k)] - here);
    here = moved > Scalar(0.0) ? moved : Scalar(0.0);
  }
  if (first == passive.end()) return true;
  mu[*first] = 0.0;
  passive.erase(first);
  return false;
}

/// μ ≥ 0 that minimises ‖A μ − b‖ (Lawson and Hanson 1974, ch. 23); scales columns and b to length
/// 1, so that units have no effect.
template <typename Scalar>
[[nodiscard]] VectorOf<Scalar> non_negative_least_squares(const MatrixOf<Scalar>& A,
                                                          const VectorOf<Scalar>& b) {
  const Scalar kTolerance = Scalar(90.0) * Eigen::NumTraits<Scalar>::epsilon();
  VectorOf<Scalar> mu = VectorOf<Scalar>::Zero(A.cols());
  const Scalar size = b.norm();
  if (A.cols() == 0 || size == Scalar(0.0)) return mu;
  MatrixOf<Scalar> columns = A;
  VectorOf<Scalar> per_length(A.cols());
  for (Eigen::Index j = 0; j < A.cols(); ++j) {
    const Scalar length = A.col(j).norm();
    per_length[j] = length > Scalar(0.0) ? Scalar(1.0) / length : Scalar(0.0);
    columns.col(j) *= per_length[j];
  }
  const VectorOf<Scalar> target = b / size;
  std::vector<Eigen::Index> passive;  // indices with μ > 0
  for (Eigen::Index iteration = 0; iteration < 3 * A.cols() + 10; ++iteration) {
    VectorOf<Scalar> ascent = columns.transpose() * (target - columns * mu);
    for (const Eigen::Index j : passive) ascent[j] = -1.0;
    Eigen::Index best = -1;
    if (!(ascent.maxCoeff(&best) > kTolerance)) break;
    passive.push_back(best);
    while (!passive.empty() && !move_to_minimum(columns, target, passive, mu)) {
    }
  }
  return size * mu.cwiseProduct(per_length);
}

}  // namespace surefoot::solver
