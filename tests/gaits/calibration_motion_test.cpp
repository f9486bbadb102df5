#include "surefoot/gaits/parts/calibration_motion.hpp"

#include "tests/support/random_motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace surefoot::gaits {
namespace {

constexpr CalibrationOptions kOptions{.duration = 6.0};

TEST(CalibrationMotion, BeginsAndEndsAtRest) {
  const CalibrationMotion motion(kOptions);
  for (const double t : {-1.0, 0.0, 0.5 + 1e-9, 6.5 - 1e-9, 6.5, 9.0}) {
    EXPECT_LT(motion.at(t).p.norm(), 1e-9) << t;
    EXPECT_LT(motion.at(t).v.norm(), 1e-7) << t;
    EXPECT_LT(motion.at(t).a.norm(), 1e-6) << t;
  }
}

TEST(CalibrationMotion, RatesAndAccelerationsAreTheDerivatives) {
  const CalibrationMotion motion(kOptions);
  constexpr double kStep = 1e-4;
  for (double t = 0.55; t < 6.5; t += 0.17) {
    const Vec3 v = (motion.at(t + kStep).p - motion.at(t - kStep).p) / (2.0 * kStep);
    const Vec3 a = (motion.at(t + kStep).v - motion.at(t - kStep).v) / (2.0 * kStep);
    EXPECT_LT((motion.at(t).v - v).norm(), 1e-6) << t;
    EXPECT_LT((motion.at(t).a - a).norm(), 1e-4) << t;
  }
}

TEST(CalibrationMotion, OfALargerRobotTakesLongerByTheRootOfItsLength) {
  CalibrationOptions longer = kOptions;
  longer.duration *= 2.0;
  longer.settle *= 2.0;
  const CalibrationMotion one(kOptions), four(longer, Scale{.length = 4.0});
  EXPECT_DOUBLE_EQ(four.duration(), 2.0 * one.duration());
  for (double t = 0.05; t < one.duration() + 0.3; t += 0.1)
    EXPECT_EQ(four.stage(2.0 * t), one.stage(t)) << t;
}

TEST(CalibrationMotion, TurnsAboutEveryAxisUpToItsAmplitude) {
  const CalibrationMotion motion(kOptions);
  Vec3 most = Vec3::Zero();
  for (double t = 0.5; t < 6.5; t += 0.01) most = most.cwiseMax(motion.at(t).p.cwiseAbs());
  const Vec3 amplitudes(kOptions.roll, kOptions.pitch, kOptions.yaw);
  EXPECT_TRUE((most.array() <= amplitudes.array()).all());
  EXPECT_TRUE((most.array() > 0.6 * amplitudes.array()).all());
}

TEST(CalibrationMotion, InItsShortestDurationItsAccelerationsStayBounded) {
  test::Random random(1);
  for (int trial = 0; trial < 50; ++trial) {
    CalibrationOptions options;
    options.roll = random.uniform(0.0, 0.3);
    options.pitch = random.uniform(0.0, 0.3);
    options.yaw = random.uniform(0.0, 0.3);
    options.duration = CalibrationMotion::shortest_duration(options);
    EXPECT_GE(options.duration, 1.0);
    const CalibrationMotion motion(options);
    double most = 0.0;
    for (double t = 0.0; t < 3.0; t += 0.0025)
      most = std::max(most, motion.at(t).a.cwiseAbs().maxCoeff());
    EXPECT_LT(most, 50.0) << trial;
    EXPECT_NEAR(CalibrationMotion::shortest_duration(options, {.length = 4.0}),
                2.0 * options.duration, 1e-12);
  }
}

TEST(CalibrationMotion, WithoutADurationThereIsNone) {
  const CalibrationMotion motion{CalibrationOptions{}};
  EXPECT_EQ(motion.at(0.0).p, Vec3::Zero());
  EXPECT_EQ(motion.at(1.0).p, Vec3::Zero());
  EXPECT_EQ(motion.stage(0.0), CalibrationStage::none);
}

TEST(CalibrationMotion, SettlesTurnsTakesOverWeighsAndFollows) {
  const CalibrationMotion motion(kOptions);
  std::vector<CalibrationStage> stages;
  for (double t = 0.0; t < 12.0; t += 0.0025) {
    if (stages.empty() || stages.back() != motion.stage(t)) stages.push_back(motion.stage(t));
    if (motion.stage(t) != CalibrationStage::turning) {
      EXPECT_EQ(motion.at(t).p, Vec3::Zero());
    }
  }
  using enum CalibrationStage;
  EXPECT_EQ(stages, (std::vector{settling, turning, settling, weighing, settling, none}));
}

}  // namespace
}  // namespace surefoot::gaits
