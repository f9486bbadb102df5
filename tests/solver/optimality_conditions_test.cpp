#include "surefoot/solver/optimality_conditions.hpp"

#include "tests/support/random_hierarchy.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace surefoot::test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

TEST(NonNegativeLeastSquares, MeetsItsOptimalityConditions) {
  for (int seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomMatrices random(static_cast<std::uint64_t>(seed));
    const Index rows = random.integer(1, 8);
    const Index columns = random.integer(1, 12);
    const MatrixXd A = random.matrix(rows, columns);
    const VectorXd b = random.vector(rows);
    const VectorXd mu = non_negative_least_squares(A, b);
    const VectorXd ascent = A.transpose() * (b - A * mu);
    ASSERT_GE(mu.minCoeff(), 0.0);
    ASSERT_LE(ascent.maxCoeff(), 1e-10);
    ASSERT_LE((ascent.array() * mu.array()).abs().maxCoeff(), 1e-10);
  }
}

TEST(NonNegativeLeastSquares, ReachesWhatLiesInTheCone) {
  for (int seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomMatrices random(static_cast<std::uint64_t>(seed));
    MatrixXd A = random.matrix(6, 9);
    A.col(4) = A.col(1);
    A.col(5).setZero();
    const VectorXd b = A * random.vector(9).cwiseAbs();
    ASSERT_LE((A * non_negative_least_squares(A, b) - b).norm(), 1e-9);
  }
}

TEST(NonNegativeLeastSquares, DoesNotDependOnUnits) {
  for (int seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomMatrices random(static_cast<std::uint64_t>(seed));
    const MatrixXd A = random.matrix(6, 4);
    const VectorXd b = random.vector(6);
    const double unit = std::pow(10.0, random.integer(-20, 20));
    VectorXd units(4);
    for (double& one : units) one = std::pow(10.0, random.integer(-20, 20));
    const VectorXd mu = non_negative_least_squares(A, b);
    const VectorXd scaled = non_negative_least_squares(A * units.asDiagonal(), unit * b);
    ASSERT_LE((units.cwiseProduct(scaled) / unit - mu).norm(), 1e-12);
  }
}

}  // namespace
}  // namespace surefoot::test
