#include "surefoot/estimation/joint_observer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace surefoot::estimation {
namespace {

constexpr double kPeriod = 0.0025;
constexpr double kBandwidth = 2.0 * kPi * 40.0;

TEST(JointObserver, GoesOnWithReadingsThatAreOlderFromNowOn) {
  JointObserver observer(kBandwidth, kPeriod);
  const JointVector a = JointVector::LinSpaced(kNumLegJoints, -30.0, 50.0);
  const auto q_at = [&](int tick) { return JointVector(0.5 * std::pow(tick * kPeriod, 2) * a); };
  observer.start(q_at(0));
  observer.expect(a);
  int late = 0;
  for (int tick = 1; tick < 200; ++tick) {
    const int now_late = tick < 50 ? 0 : tick < 120 ? 2 : 1;
    observer.go_back(now_late - late);
    late = now_late;
    observer.update(q_at(tick - late), 1);
    ASSERT_LT((observer.velocity() - (tick - late) * kPeriod * a).norm(), 1e-9) << tick;
    ASSERT_LT(observer.disturbance().norm(), 1e-6) << tick;
  }
}

TEST(JointObserver, FindsAnAccelerationThatItsModelDoesNotKnow) {
  JointObserver observer(kBandwidth, kPeriod);
  JointVector q = JointVector::Zero(kNumLegJoints), v = JointVector::Zero(kNumLegJoints);
  const JointVector unknown = JointVector::LinSpaced(kNumLegJoints, -100.0, 100.0);
  observer.start(q);
  double first = 0.0;
  for (int tick = 0; tick < 40; ++tick) {
    q += kPeriod * v + 0.5 * kPeriod * kPeriod * unknown;
    v += kPeriod * unknown;
    observer.update(q, 1);
    if (tick == 0) first = observer.disturbance()[11];
  }
  EXPECT_LT((observer.disturbance() - unknown).norm(), 0.01 * unknown.norm());
  EXPECT_LT((observer.velocity() - v).norm(), 0.01 * v.norm());
  EXPECT_LT(first, 0.2 * unknown[11]) << "one reading is not believed";
}

// A leg that swings by 0.3 rad at 10 rad/s: after a gap the velocity error is at most that of a
// joint at rest.
TEST(JointObserver, AfterAGapAReadingIsNotTakenForOneOfAPeriod) {
  const auto q_at = [](double t) {
    return JointVector(JointVector::Constant(kNumLegJoints, 0.3 * std::sin(10.0 * t)));
  };
  for (const int gap : {2, 4, 8, 40, 41, 80, 200, 400}) {
    for (const bool silent : {false, true}) {
      JointObserver observer(kBandwidth, kPeriod);
      double time = 0.0, worst = 0.0;
      const auto tick = [&](int periods, bool reads) {
        observer.expect(JointVector::Constant(kNumLegJoints, -30.0 * std::sin(10.0 * time)));
        time += periods * kPeriod;
        observer.update(
            reads ? q_at(time) : JointVector(JointVector::Constant(kNumLegJoints, kNaN)), periods);
      };
      for (int i = 0; i < 400; ++i) tick(1, true);
      for (int i = 1; silent && i < gap; ++i) tick(1, false);
      tick(silent ? 1 : gap, true);
      for (int i = 0; i < 400; ++i) {
        worst = std::max(worst, std::abs(observer.velocity()[0] - 3.0 * std::cos(10.0 * time)));
        tick(1, true);
      }
      EXPECT_LT(worst, 3.0) << gap << (silent ? " readings that are not numbers" : " periods");
    }
  }
}

TEST(JointObserver, AJointThatNeverHadAReadingHidesNoOtherAndBeginsAtRestWithItsFirst) {
  JointObserver observer(kBandwidth, kPeriod);
  const auto tick = [&](int number, double third) {
    JointVector q = JointVector::Constant(kNumLegJoints, 0.3 * kPeriod * number);
    q[3] = third;
    observer.update(q, 1);
  };
  for (int i = 0; i < 150; ++i) tick(i, std::numeric_limits<double>::quiet_NaN());
  EXPECT_NEAR(observer.velocity()[2], 0.3, 0.01);
  EXPECT_EQ(observer.velocity()[3], 0.0);
  tick(150, 0.7);
  EXPECT_EQ(observer.q()[3], 0.7);
  EXPECT_EQ(observer.velocity()[3], 0.0);
}

TEST(JointObserver, NoiseOfAnEncoderGivesLessNoiseThanItsDifferences) {
  JointObserver observer(kBandwidth, kPeriod);
  observer.start(JointVector::Zero(kNumLegJoints));
  double sum = 0.0;
  constexpr int kTicks = 4000;
  for (int tick = 0; tick < kTicks; ++tick) {
    // Half a step of an encoder, up and down without a pattern.
    const double noise = 2.2e-4 * std::sin(1.7 * tick * tick);
    observer.update(JointVector::Constant(kNumLegJoints, noise), 1);
    sum += observer.velocity()[0] * observer.velocity()[0];
  }
  const double differences = std::sqrt(2.0) * 2.2e-4 / std::sqrt(2.0) / kPeriod;
  EXPECT_LT(std::sqrt(sum / kTicks), 0.6 * differences);
}

}  // namespace
}  // namespace surefoot::estimation
