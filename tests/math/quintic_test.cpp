#include "surefoot/math/quintic.hpp"

#include "surefoot/math/types.hpp"
#include "tests/support/random_motion.hpp"

#include <gtest/gtest.h>

namespace surefoot {
namespace {

using test::Random;

Motion<Vec3> random_motion(Random& random) {
  const Vec3 p = random.vector(1.0);
  const Vec3 v = random.vector(2.0);
  return {p, v, random.vector(5.0)};
}

void expect_near(const Motion<Vec3>& a, const Motion<Vec3>& b, double tolerance) {
  EXPECT_LT((a.p - b.p).norm(), tolerance);
  EXPECT_LT((a.v - b.v).norm(), tolerance);
  EXPECT_LT((a.a - b.a).norm(), tolerance);
}

/// Calls check(begin, end, duration, random) on random splines.
template <typename Check>
void on_random_splines(unsigned seed, const Check& check) {
  Random random(seed);
  for (int trial = 0; trial < 100; ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    const Motion<Vec3> begin = random_motion(random);
    const Motion<Vec3> end = random_motion(random);
    check(begin, end, random.uniform(0.1, 2.0), random);
  }
}

TEST(Quintic, PassesThroughItsBoundaryStates) {
  on_random_splines(1, [](const auto& begin, const auto& end, double T, Random&) {
    expect_near(hermite(begin, end, 0.0, T), begin, 1e-12);
    expect_near(hermite(begin, end, T, T), end, 1e-10);
  });
}

TEST(Quintic, HoldsItsBoundaryStatesOutside) {
  on_random_splines(2, [](const auto& begin, const auto& end, double T, Random& random) {
    const double beyond = random.uniform(0.01, 5.0);
    expect_near(hermite(begin, end, -beyond, T), begin, 1e-12);
    expect_near(hermite(begin, end, T + beyond, T), end, 1e-10);
  });
}

TEST(Quintic, VelocityAndAccelerationAreTheRatesOfPositionAndVelocity) {
  on_random_splines(3, [](const auto& begin, const auto& end, double T, Random& random) {
    constexpr double kStep = 1e-5;
    const double t = random.uniform(0.05, 0.95) * T;
    const Motion<Vec3> before = hermite(begin, end, t - kStep * T, T);
    const Motion<Vec3> now = hermite(begin, end, t, T);
    const Motion<Vec3> after = hermite(begin, end, t + kStep * T, T);
    const double scale = 1.0 + now.v.norm() + now.a.norm() / T;
    EXPECT_LT(((after.p - before.p) / (2.0 * kStep * T) - now.v).norm(), 1e-6 * scale);
    EXPECT_LT(((after.v - before.v) / (2.0 * kStep * T) - now.a).norm(), 1e-5 * scale / T);
  });
}

TEST(Quintic, WeightsAreRatesOfEachOther) {
  Random random(4);
  for (int trial = 0; trial < 100; ++trial) {
    constexpr double kStep = 1e-6;
    const double T = random.uniform(0.2, 2.0);
    const double t = random.uniform(0.0, 1.0) * T;
    const HermiteWeights velocity =
        (hermite_position(t + kStep, T) - hermite_position(t - kStep, T)) / (2.0 * kStep);
    const HermiteWeights acceleration =
        (hermite_velocity(t + kStep, T) - hermite_velocity(t - kStep, T)) / (2.0 * kStep);
    EXPECT_LT((velocity - hermite_velocity(t, T)).norm(), 1e-7);
    EXPECT_LT((acceleration - hermite_acceleration(t, T)).norm(), 1e-6);
  }
}

TEST(Quintic, EveryPolynomialOfFifthDegreeIsItsOwnSpline) {
  Random random(5);
  for (int trial = 0; trial < 100; ++trial) {
    std::array<Vec3, 6> c;
    for (Vec3& coefficient : c) coefficient = random.vector(1.0);
    const auto polynomial = [&](double t) -> Motion<Vec3> {
      Motion<Vec3> m{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
      for (int n = 5; n >= 0; --n) {
        m.a = m.a * t + 2.0 * m.v;
        m.v = m.v * t + m.p;
        m.p = m.p * t + c[static_cast<std::size_t>(n)];
      }
      return m;
    };
    const double T = random.uniform(0.1, 2.0);
    const double t = random.uniform(0.0, 1.0) * T;
    expect_near(hermite(polynomial(0.0), polynomial(T), t, T), polynomial(t), 1e-10);
  }
}

}  // namespace
}  // namespace surefoot
