#include "surefoot/simulation/random.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace surefoot::simulation {
namespace {

TEST(Random, GivesTheReferenceSequenceOfXoshiro256PlusPlusSeededBySplitmix64) {
  Random random(0);  // computed with the algorithms' reference implementations
  EXPECT_EQ(random.bits(), 0x53175d61490b23dfULL);
  EXPECT_EQ(random.bits(), 0x61da6f3dc380d507ULL);
  EXPECT_EQ(random.bits(), 0x5c0fdf91ec9a7bfcULL);
}

TEST(Random, TwoWithTheSameSeedAgreeAndTwoWithDifferentSeedsDoNot) {
  Random first(7);
  Random second(7);
  Random other(8);
  int equal_to_other = 0;
  for (int i = 0; i < 100; ++i) {
    const double value = first.normal();
    EXPECT_EQ(value, second.normal());
    equal_to_other += value == other.normal() ? 1 : 0;
  }
  EXPECT_EQ(equal_to_other, 0);
}

TEST(Random, UniformFillsTheIntervalEvenly) {
  Random random(3);
  double sum = 0.0;
  double square = 0.0;
  const int count = 200000;
  for (int i = 0; i < count; ++i) {
    const double value = random.uniform();
    ASSERT_GE(value, 0.0);
    ASSERT_LT(value, 1.0);
    sum += value;
    square += value * value;
  }
  EXPECT_NEAR(sum / count, 0.5, 0.003);
  EXPECT_NEAR(square / count, 1.0 / 3.0, 0.003);
}

TEST(Random, NormalHasTheMomentsOfAStandardNormal) {
  Random random(5);
  std::array<double, 5> moment{};
  const int count = 200000;
  for (int i = 0; i < count; ++i) {
    const double value = random.normal();
    for (std::size_t power = 1; power < moment.size(); ++power) {
      moment[power] += std::pow(value, static_cast<double>(power)) / count;
    }
  }
  EXPECT_NEAR(moment[1], 0.0, 0.01);
  EXPECT_NEAR(moment[2], 1.0, 0.02);
  EXPECT_NEAR(moment[3], 0.0, 0.04);
  EXPECT_NEAR(moment[4], 3.0, 0.1);
}

TEST(Random, SuccessiveNormalsDoNotCorrelate) {
  Random random(11);
  double product = 0.0;
  double previous = random.normal();
  const int count = 200000;
  for (int i = 0; i < count; ++i) {
    const double value = random.normal();
    product += value * previous / count;
    previous = value;
  }
  EXPECT_NEAR(product, 0.0, 0.01);
}

}  // namespace
}  // namespace surefoot::simulation
