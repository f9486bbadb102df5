#include "surefoot/estimation/invariant_filter.hpp"

#include "surefoot/math/rotation.hpp"
#include "tests/support/nees.hpp"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace surefoot::estimation {
namespace {

constexpr double kPeriod = 0.0025;
constexpr double kNoise = 0.3e-3;  // of a foot's position as seen from B [m]
using Filter = InvariantFilter;

/// A body over four fixed feet that turns and sways; made from functions of time, so that nothing
/// is integrated.
struct Body {
  /// Begins at rest.
  [[nodiscard]] static double begun(double t) { return 1.0 - std::exp(-4.0 * t * t); }
  [[nodiscard]] static Vec3 angles(double t, double turn) {
    return begun(t) * turn * Vec3(std::sin(2.0 * t), std::sin(3.1 * t), std::sin(1.3 * t));
  }
  [[nodiscard]] Mat3 R(double t) const {
    return (from_roll_pitch_yaw(angles(t, turn)) * tilt).toRotationMatrix();
  }
  [[nodiscard]] static Vec3 p(double t) {
    const Vec3 way(0.02 * std::sin(1.5 * t), 0.03 * std::sin(2.2 * t), 0.01 * std::sin(2.7 * t));
    return Vec3(0.0, 0.0, 0.46) + begun(t) * way;
  }
  [[nodiscard]] static Vec3 v(double t) { return (p(t + kStep) - p(t - kStep)) / (2.0 * kStep); }
  [[nodiscard]] static Vec3 a(double t) {
    return (p(t + kStep) - 2.0 * p(t) + p(t - kStep)) / (kStep * kStep);
  }
  [[nodiscard]] Vec3 w(double t) const {
    const Mat3 turned = R(t - kStep).transpose() * R(t + kStep);
    return log_rotation(Quat(turned)) / (2.0 * kStep);
  }
  [[nodiscard]] Vec3 specific_force(double t) const {
    return R(t).transpose() * (a(t) + Vec3(0.0, 0.0, kGravity));
  }

  static constexpr double kStep = 1e-4;
  double turn = 0.0;             // amplitude of its turning [rad]
  Quat tilt = Quat::Identity();  // that it stands with
};

/// The body's sensors and a filter that reads them.
struct Bench {
  explicit Bench(unsigned seed, double turn = 0.0) : random(seed) { body.turn = turn; }

  Vec3 noise(double deviation) {
    return deviation * Vec3(normal(random), normal(random), normal(random));
  }
  [[nodiscard]] Vec3 seen(Leg leg, double t) const {
    return body.R(t).transpose() * (feet[index(leg)] - Body::p(t));
  }
  void start() {
    filter.start(body.specific_force(0.0) + accelerometer_bias, body.w(0.0) + gyro_bias);
    filter.place(Body::p(0.0));
    for (const Leg leg : kLegs) filter.plant(leg, seen(leg, 0.0), Mat3::Identity());
  }
  void tick() {
    const double middle = time + 0.5 * kPeriod;
    filter.propagate(body.w(middle) + gyro_bias + noise(gyro_noise),
                     body.specific_force(middle) + accelerometer_bias + noise(accelerometer_noise),
                     kPeriod);
    time += kPeriod;
    for (const Leg leg : kLegs) {
      if (!filter.stands(leg)) continue;
      filter.move(leg, Vec3::Zero(), 1e-3 * std::sqrt(kPeriod));
      filter.correct(leg, seen(leg, time) + noise(position_noise), Mat3::Identity());
    }
  }
  void run_until(double end) {
    while (time < end) tick();
  }
  /// Angle between the estimated and the true vertical [rad].
  [[nodiscard]] double tilt_error() const {
    const Vec3 up = filter.R_WB().row(2), true_up = body.R(time).row(2);
    return std::atan2(up.cross(true_up).norm(), up.dot(true_up));
  }
  [[nodiscard]] double velocity_error() const {
    return (filter.R_WB().transpose() * filter.v_WB() - body.R(time).transpose() * Body::v(time))
        .norm();
  }

  std::mt19937 random;
  std::normal_distribution<double> normal;
  Body body;
  Filter filter{InvariantFilterOptions{.foot_position_noise = kNoise, .initial_tilt = 0.02}};
  PerLeg<Vec3> feet{Vec3(0.33, 0.22, 0.0), Vec3(0.33, -0.22, 0.0), Vec3(-0.33, 0.22, 0.0),
                    Vec3(-0.33, -0.22, 0.0)};
  Vec3 gyro_bias = Vec3::Zero(), accelerometer_bias = Vec3::Zero();
  double gyro_noise = 0.0, accelerometer_noise = 0.0, position_noise = 0.0;
  double time = 0.0;
};

Bench noisy(unsigned seed, double turn) {
  Bench bench(seed, turn);
  bench.gyro_noise = 2e-4 / std::sqrt(kPeriod);
  bench.accelerometer_noise = 2e-3 / std::sqrt(kPeriod);
  bench.position_noise = kNoise;
  bench.gyro_bias = bench.noise(1e-3);
  bench.accelerometer_bias = bench.noise(0.08);
  return bench;
}

TEST(InvariantFilter, FollowsAMotionWithoutNoise) {
  Bench bench(1, 0.1);
  bench.start();
  bench.run_until(5.0);
  EXPECT_LT(bench.tilt_error(), 1e-4);
  EXPECT_LT(bench.velocity_error(), 1e-3);
  EXPECT_LT((bench.filter.p_WB() - Body::p(bench.time)).norm(), 1e-3);
}

TEST(InvariantFilter, StandingLevelItCannotTellABiasFromATilt) {
  Bench bench = noisy(2, 0.0);
  bench.accelerometer_bias = Vec3(0.1, 0.0, 0.0);
  bench.start();
  bench.run_until(6.0);
  EXPECT_NEAR(bench.tilt_error(), 0.1 / kGravity, 0.3 * 0.1 / kGravity);
  const Filter::Covariance& P = bench.filter.covariance();
  EXPECT_GT(std::sqrt(P(Filter::kTheta + 1, Filter::kTheta + 1)), 0.3 * 0.1 / kGravity)
      << "and knows it";
}

TEST(InvariantFilter, TurningOnTheSpotFindsTheBiasesAndTheVertical) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    Bench bench = noisy(seed, 0.1);
    bench.start();
    bench.run_until(8.0);
    EXPECT_LT(bench.tilt_error(), 0.003) << seed;
    EXPECT_LT((bench.filter.accelerometer_bias() - bench.accelerometer_bias).norm(), 0.03) << seed;
    EXPECT_LT((bench.filter.gyro_bias() - bench.gyro_bias).norm(), 5e-4) << seed;
    EXPECT_LT(bench.velocity_error(), 0.003) << seed;
  }
}

TEST(InvariantFilter, KnowsHowWrongItIs) {
  constexpr int kRuns = 60;
  double sum = 0.0;
  for (unsigned seed = 1; seed <= kRuns; ++seed) {
    Bench bench = noisy(seed + 100, 0.1);
    bench.start();
    bench.run_until(4.0);
    sum += test::nees(bench.filter, bench.body.R(bench.time), Body::v(bench.time));
  }
  // χ² with 5 × 60 degrees of freedom lies in 240 … 366 with 99 %; the foot's walk and the initial
  // deviations of the filter are a little larger than the truth's.
  EXPECT_LT(sum / kRuns, 366.0 / kRuns);
  EXPECT_GT(sum / kRuns, 0.3 * 240.0 / kRuns);
}

TEST(InvariantFilter, AFootThatSlipsMovesTheFootAndHardlyTheBase) {
  Bench bench = noisy(5, 0.1);
  bench.start();
  bench.run_until(6.0);
  const Vec3 slip(0.05, -0.03, 0.0);
  bench.feet[1] += slip;
  const Vec3 foot_before = bench.filter.p_WF(Leg::RF);
  bench.run_until(6.2);
  EXPECT_LT(bench.velocity_error(), 0.02);
  EXPECT_LT(((bench.filter.p_WF(Leg::RF) - foot_before) - slip).norm(), 0.01);
  bench.run_until(6.6);
  EXPECT_LT(bench.velocity_error(), 0.005);
}

/// Estimated heading after the feet turned by 10 mrad in 5 s, for a filter that expects a turn with
/// this standard deviation [rad/√s].
double heading_over_turning_feet(double told) {
  Bench bench(9, 0.0);
  bench.start();
  bench.run_until(6.0);
  const Mat3 turn = rotation_about_z(0.01 * kPeriod / 5.0);
  while (bench.time < 11.0) {
    for (Vec3& foot : bench.feet) foot = turn * foot;
    bench.filter.turn_feet(told * std::sqrt(kPeriod));
    bench.tick();
  }
  return yaw(bench.filter.R_WB()) - yaw(bench.body.R(bench.time));
}

TEST(InvariantFilter, FeetThatMayTurnTogetherSayLittleOfTheHeading) {
  const double trusted = std::abs(heading_over_turning_feet(0.0));
  EXPECT_GT(trusted, 1e-3);
  EXPECT_LT(std::abs(heading_over_turning_feet(0.02)), 0.1 * trusted);
}

TEST(InvariantFilter, FeetMayComeAndGo) {
  Bench bench = noisy(6, 0.1);
  bench.start();
  bench.run_until(6.0);
  for (int step = 0; step < 8; ++step) {
    const Leg leg = kLegs[static_cast<std::size_t>(step % kNumLegs)];
    bench.filter.release(leg);
    bench.run_until(bench.time + 0.3);
    bench.feet[index(leg)] += Vec3(0.05, 0.01, step % 2 == 0 ? -0.14 : 0.0);
    bench.filter.plant(leg, bench.seen(leg, bench.time), Mat3::Identity());
    bench.run_until(bench.time + 0.2);
  }
  EXPECT_LT(bench.velocity_error(), 0.003);
  EXPECT_LT(bench.tilt_error(), 0.002);
  const Vec3 drift = bench.filter.p_WB() - Body::p(bench.time);
  EXPECT_LT(drift.norm(), 0.02);
}

TEST(InvariantFilter, TheCovarianceStaysSymmetricAndPositive) {
  Bench bench = noisy(7, 0.1);
  bench.start();
  bench.run_until(3.0);
  bench.filter.release(Leg::LH);
  bench.run_until(4.0);
  const Filter::Covariance& P = bench.filter.covariance();
  EXPECT_LT((P - P.transpose()).norm(), 1e-12);
  const Eigen::SelfAdjointEigenSolver<Filter::Covariance> eigen(P);
  EXPECT_GT(eigen.eigenvalues().minCoeff(), -1e-12);
  EXPECT_EQ(P.middleRows<3>(Filter::kFeet + 6).norm(), 0.0);
}

TEST(InvariantFilter, HasSixFeetIfTheRobotHas) {
  Filter filter({}, kMaxLegs);
  filter.start(Vec3(0.0, 0.0, kGravity), Vec3::Zero());
  const Leg last{kMaxLegs - 1};
  filter.plant(last, Vec3(-0.5, -0.2, -0.5), Mat3::Identity());
  EXPECT_EQ(filter.covariance().rows(), 9 + 3 * kMaxLegs + 6);
  filter.propagate(Vec3::Zero(), Vec3(0.1, 0.0, kGravity), 0.1);
  const double before = filter.v_WB().x();
  filter.correct(last, Vec3(-0.5, -0.2, -0.5), Mat3::Identity());
  EXPECT_LT(std::abs(filter.v_WB().x()), before) << "the foot stands, so the base does";
}

}  // namespace
}  // namespace surefoot::estimation
