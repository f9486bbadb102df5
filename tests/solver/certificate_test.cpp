#include "surefoot/solver/certificate.hpp"

#include "tests/solver/solve.hpp"

#include <gtest/gtest.h>

#include <string>

namespace surefoot::test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVector2d;
using Eigen::Vector2d;
using Eigen::VectorXd;

VectorXd number(double b) { return VectorXd::Constant(1, b); }

TEST(Certificate, AcceptsTheOptimumAndRefusesWhatIsBesideIt) {
  for (int seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomMatrices random(static_cast<std::uint64_t>(seed));
    HierarchyData levels = random_levels(random, {.unknowns = 6, .levels = 3, .max_rows = 3});
    levels.push_back(close_to(random.vector(6)));
    const VectorXd x = solve(6, levels).x;
    ASSERT_LE(optimality_error(6, levels, x), 1e-10);
    ASSERT_GE(optimality_error(6, levels, x + 1e-3 * random.vector(6)), 1e-6);
  }
}

TEST(Certificate, RefusesALowerLevelThatWasServedFirst) {
  const HierarchyData levels{equalities(RowVector2d(1.0, 0.0), number(1.0)),
                             equalities(RowVector2d(1.0, 0.0), number(3.0))};
  EXPECT_LE(optimality_error(2, levels, Vector2d(1.0, 0.0)), 1e-15);
  EXPECT_GE(optimality_error(2, levels, Vector2d(3.0, 0.0)), 0.1);
  EXPECT_GE(optimality_error(2, levels, Vector2d(2.0, 0.0)), 0.1);
}

TEST(Certificate, RefusesALimitThatHoldsWithoutNeed) {
  // x = 1 touches the limit x ≤ 1, but the task x = 0 leads away from it.
  const HierarchyData levels{at_most(RowVector2d(1.0, 0.0), number(1.0)),
                             equalities(RowVector2d(1.0, 0.0), number(0.0))};
  EXPECT_GE(optimality_error(2, levels, Vector2d(1.0, 0.0)), 0.1);
  EXPECT_LE(optimality_error(2, levels, Vector2d(0.0, 0.0)), 1e-15);
}

TEST(Certificate, GivesTheResidualOfEachLevel) {
  const HierarchyData levels{at_most(RowVector2d(1.0, 0.0), number(1.0)),
                             equalities(MatrixXd::Identity(2, 2), Vector2d(0.0, 7.0))};
  const auto certificates = certify(make_hierarchy(2, levels), Vector2d(4.0, 3.0));
  EXPECT_EQ(certificates[0].residual, 3.0);
  EXPECT_NEAR(certificates[1].residual, std::sqrt(32.0), 1e-15);
}

}  // namespace
}  // namespace surefoot::test
