#include "surefoot/estimation/guarded_values.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace surefoot::estimation {
namespace {

constexpr double kPeriod = 0.0025;  // [s]
constexpr double kPatience = 0.02;  // [s]
constexpr double kInf = std::numeric_limits<double>::infinity();

/// Three values with a sample at each tick.
struct Group {
  using Values = GuardedValues<Vec3>;

  void take(const Vec3& raw, SampleFault common = SampleFault::none) {
    time += kPeriod;
    watch.update(time, time);
    values.take(raw, common, watch, limits, kPatience);
  }
  [[nodiscard]] GroupHealth health() const { return values.health(time); }

  Values values{3};
  Values::Limits limits{.range = Vec3(10.0, 10.0, 10.0),
                        .tolerance = Vec3(1.0, 1.0, 2.0),
                        .sure = Vec3::Constant(kUnlimited)};
  SampleWatch watch{kPeriod, kPatience, kPatience};
  double time = 0.0;
};

TEST(GuardedValues, EachIsJudgedByItselfAndTheOnlyOneAtFaultIsNamed) {
  const auto fault_of = [](double raw) {
    Group group;
    group.take(Vec3(1.0, 2.0, 3.0));
    group.take(Vec3(1.5, raw, 3.0));
    EXPECT_EQ(group.values.repaired(), Vec3(1.5, 2.0, 3.0)) << raw;
    EXPECT_TRUE(std::isnan(group.values.measured()[1])) << raw;
    EXPECT_EQ(group.values.measured()[0], 1.5) << raw;
    EXPECT_EQ(group.health().joint, 1) << raw;
    EXPECT_NEAR(group.health().age, kPeriod, 1e-12) << raw;
    return group.health().fault;
  };
  EXPECT_EQ(fault_of(kNaN), SampleFault::not_a_number);
  EXPECT_EQ(fault_of(-kInf), SampleFault::not_a_number);
  EXPECT_EQ(fault_of(10.1), SampleFault::out_of_range);
  EXPECT_EQ(fault_of(3.1), SampleFault::jump);
  EXPECT_EQ(fault_of(0.9), SampleFault::jump);
}

TEST(GuardedValues, AJumpThatStaysIsBelievedAfterThePatience) {
  Group group;
  group.take(Vec3::Zero());
  const double seen = group.time;
  for (int i = 0; i < 20; ++i) {
    group.take(Vec3(5.0, 0.0, 0.0));
    const bool is_over = group.time - seen > kPatience + 1e-9;
    EXPECT_EQ(group.health().fault, is_over ? SampleFault::none : SampleFault::jump) << i;
    EXPECT_EQ(group.values.repaired()[0], is_over ? 5.0 : 0.0) << i;
  }
}

TEST(GuardedValues, WhatIsShakenIsBelievedFromTheSecondSampleOnUntilItWasCalm) {
  Group group;
  group.limits.sure.setConstant(0.5);
  for (int shock = 0; shock < 2; ++shock) {
    group.take(Vec3::Zero());
    group.take(Vec3(0.7, 0.0, 0.0));
    EXPECT_EQ(group.health().fault, SampleFault::jump);
    for (int i = 0; i < 20; ++i) {
      const Vec3 raw(i % 2 == 0 ? -0.6 : 0.3, 0.0, 0.0);
      group.take(raw);
      ASSERT_EQ(group.values.repaired(), raw) << i;
    }
    for (int i = 0; i < 10; ++i) group.take(Vec3::Zero());
  }
}

TEST(GuardedValues, ADoubtedSampleThatComesAgainIsNoOtherSample) {
  GuardedValues<Vec3> values{3};
  SampleWatch watch(kPeriod, kPatience, kPatience);
  const GuardedValues<Vec3>::Limits limits{.range = Vec3::Constant(10.0),
                                           .tolerance = Vec3::Constant(kUnlimited),
                                           .sure = Vec3::Constant(0.5)};
  const auto take = [&](int tick, int sampled, double raw) {
    watch.update(tick * kPeriod, sampled * kPeriod);
    values.take(Vec3(raw, 0.0, 0.0), SampleFault::none, watch, limits, kPatience);
    return values.repaired()[0];
  };
  for (int i = 0; i < 20; ++i)
    EXPECT_EQ(take(2 * i, 2 * i, 0.0) + take(2 * i + 1, 2 * i, 0.0), 0.0);
  EXPECT_EQ(take(40, 40, 1.5), 0.0);
  EXPECT_EQ(take(41, 40, 1.5), 0.0) << "every second tick has a sample";
  EXPECT_EQ(take(42, 42, 1.5), 1.5);
}

TEST(GuardedValues, WhatWaitedForTheNextSampleMayBeTwiceAsFarOff) {
  Group group;
  group.limits.sure.setConstant(0.5);
  group.take(Vec3::Zero());
  group.take(Vec3(0.8, 0.0, 0.0));
  group.take(Vec3(1.6, 1.2, 0.0));
  EXPECT_EQ(group.health().joint, 1) << "which did not wait";
  EXPECT_EQ(group.values.repaired()[0], 1.6);
}

}  // namespace
}  // namespace surefoot::estimation
