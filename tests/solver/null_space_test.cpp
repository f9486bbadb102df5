#include "surefoot/solver/null_space.hpp"

#include "tests/support/random_hierarchy.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace surefoot::solver {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

void expect_basis(const MatrixXd& A, const MatrixXd& Z, Index dimension) {
  ASSERT_EQ(Z.rows(), A.cols());
  ASSERT_EQ(Z.cols(), dimension);
  ASSERT_LE((A * Z).norm(), 1e-12 * (1.0 + A.norm()));
  ASSERT_LE((Z.transpose() * Z - MatrixXd::Identity(dimension, dimension)).norm(), 1e-12);
}

TEST(NullSpace, IsOrthonormalAndComplete) {
  for (int seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    test::RandomMatrices random(static_cast<std::uint64_t>(seed));
    const Index n = random.integer(1, 12);
    const Index rank = random.integer(0, static_cast<int>(n));
    const Index rows = rank + random.integer(0, 4);
    const MatrixXd A = random.matrix(rows, rank) * random.matrix(rank, n);
    expect_basis(A, null_space(A), n - rank);
  }
}

TEST(NullSpace, OfAFullRankMatrixHasZeroColumns) {
  test::RandomMatrices random(1);
  EXPECT_EQ(null_space(random.matrix(5, 5)).cols(), 0);
  EXPECT_EQ(null_space(random.matrix(9, 5)).cols(), 0);
}

TEST(NullSpace, OfNoRowsOrZeroRowsIsEverything) {
  expect_basis(MatrixXd(0, 4), null_space(MatrixXd(0, 4)), 4);
  expect_basis(MatrixXd::Zero(3, 4), null_space(MatrixXd::Zero(3, 4)), 4);
}

TEST(NullSpace, DoesNotDependOnTheScaleOfRows) {
  test::RandomMatrices random(2);
  MatrixXd A = random.matrix(3, 6);
  A.row(0) *= 1e-9;
  A.row(2) *= 1e9;
  EXPECT_EQ(null_space(A).cols(), 3);
}

TEST(NullSpace, LosesADirectionAtTheTolerance) {
  for (const double weak : {1e-2, 1e-5, 1e-7}) {
    EXPECT_EQ(null_space((MatrixXd(2, 2) << 1.0, 0.0, 1.0, weak).finished()).cols(), 0) << weak;
  }
  for (const double weak : {1e-9, 1e-12, 1e-14, 0.0}) {
    EXPECT_EQ(null_space((MatrixXd(2, 2) << 1.0, 0.0, 1.0, weak).finished()).cols(), 1) << weak;
  }
}

TEST(NullSpace, StageByStageIsTheNullSpaceOfTheStack) {
  for (int seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    test::RandomMatrices random(static_cast<std::uint64_t>(seed));
    const MatrixXd A1 = random.matrix(3, 9);
    MatrixXd A2 = random.matrix(4, 9);
    A2.row(1) = A1.row(0) - 2.0 * A1.row(2);  // in conflict with the first stage
    const MatrixXd Z = null_space_within(A2, null_space(A1));
    MatrixXd stack(7, 9);
    stack << A1, A2;
    expect_basis(stack, Z, 3);
  }
}

TEST(NullSpace, WithinAnEmptyNullSpaceIsEmpty) {
  test::RandomMatrices random(3);
  const MatrixXd Z = null_space_within(random.matrix(2, 4), MatrixXd(4, 0));
  EXPECT_EQ(Z.rows(), 4);
  EXPECT_EQ(Z.cols(), 0);
}

}  // namespace
}  // namespace surefoot::solver
