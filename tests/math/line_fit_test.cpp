#include "surefoot/math/line_fit.hpp"

#include <gtest/gtest.h>

namespace surefoot {
namespace {

TEST(LineFit, FindsSlopeMeanAndEndOfALine) {
  const Vec3 start(1.0, -2.0, 0.5), slope(0.1, 0.2, -0.3);
  LineFit fit;
  for (int k = 0; k < 7; ++k) fit.add(start + k * slope);
  EXPECT_EQ(fit.size(), 7);
  EXPECT_LT((fit.slope() - slope).norm(), 1e-12);
  EXPECT_LT((fit.mean() - start - 3.0 * slope).norm(), 1e-12);
  EXPECT_LT((fit.last() - start - 6.0 * slope).norm(), 1e-12);
}

// Of 0, 1, 0, 2 the line is 0.5 k.
TEST(LineFit, LeavesTheLeastSquares) {
  LineFit fit;
  for (const double y : {0.0, 1.0, 0.0, 2.0}) fit.add(Vec3::Constant(y));
  EXPECT_NEAR(fit.slope().x(), 0.5, 1e-12);
  EXPECT_NEAR(fit.last().x(), 1.5, 1e-12);
}

TEST(LineFit, OfASingleSampleIsFlat) {
  LineFit fit;
  fit.add(Vec3(1.0, 2.0, 3.0));
  EXPECT_EQ(fit.slope(), Vec3::Zero());
  EXPECT_EQ(fit.last(), Vec3(1.0, 2.0, 3.0));
}

}  // namespace
}  // namespace surefoot
