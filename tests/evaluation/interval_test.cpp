#include "surefoot/evaluation/interval.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace surefoot {
namespace {

TEST(WilsonInterval, HasThePublishedValues) {
  // Wilson 1927; Newcombe 1998, table I: 81/263, 15/148, 0/20, 1/29.
  EXPECT_NEAR(wilson_interval(81, 263).low, 0.2553, 5e-5);
  EXPECT_NEAR(wilson_interval(81, 263).high, 0.3662, 5e-5);
  EXPECT_NEAR(wilson_interval(15, 148).low, 0.0624, 5e-5);
  EXPECT_NEAR(wilson_interval(15, 148).high, 0.1605, 5e-5);
  EXPECT_NEAR(wilson_interval(0, 20).low, 0.0, 5e-5);
  EXPECT_NEAR(wilson_interval(0, 20).high, 0.1611, 5e-5);
  EXPECT_NEAR(wilson_interval(1, 29).low, 0.0061, 5e-5);
  EXPECT_NEAR(wilson_interval(1, 29).high, 0.1718, 5e-5);
}

TEST(WilsonInterval, EndsAreWhereTheRateIsAsFarAwayAsItsOwnSpreadAllows) {
  for (int trials = 1; trials <= 100; ++trials) {
    for (int successes = 0; successes <= trials; ++successes) {
      const Interval interval = wilson_interval(successes, trials);
      const double p = static_cast<double>(successes) / trials;
      ASSERT_LE(0.0, interval.low);
      ASSERT_LE(interval.low, p);
      ASSERT_LE(p, interval.high);
      ASSERT_LE(interval.high, 1.0);
      for (const double end : {interval.low, interval.high}) {
        ASSERT_NEAR(std::abs(p - end), 1.959963984540054 * std::sqrt(end * (1.0 - end) / trials),
                    1e-9);
      }
    }
  }
}

TEST(WilsonInterval, SaysNothingWithoutTrials) {
  EXPECT_EQ(wilson_interval(0, 0).low, 0.0);
  EXPECT_EQ(wilson_interval(0, 0).high, 1.0);
}

}  // namespace
}  // namespace surefoot
