#include "surefoot/logging/logged_model.hpp"

#include <gtest/gtest.h>

#include <random>

namespace surefoot::logging {
namespace {

struct Feet {
  PerLeg<Vec3> p_WF, force;
};

// Feet anywhere on uneven ground, all of which push.
Feet random_feet(std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  Feet feet;
  for (std::size_t k = 0; k < 4; ++k) {
    feet.p_WF[k] = {unit(random), unit(random), 0.2 * unit(random)};
    feet.force[k] = {30.0 * unit(random), 30.0 * unit(random), 60.0 + 50.0 * unit(random)};
  }
  return feet;
}

TEST(MeasuredZmp, TheForcesHaveNoHorizontalMomentAboutIt) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 200; ++i) {
    const Feet feet = random_feet(random);
    const Vec2 zmp = logged::measured_zmp(feet.p_WF, feet.force, 1.0);
    double load = 0.0, height = 0.0;
    for (std::size_t k = 0; k < 4; ++k) load += feet.force[k].z();
    for (std::size_t k = 0; k < 4; ++k) height += feet.p_WF[k].z() * feet.force[k].z() / load;
    Vec3 moment = Vec3::Zero();
    for (std::size_t k = 0; k < 4; ++k)
      moment += (feet.p_WF[k] - Vec3(zmp.x(), zmp.y(), height)).cross(feet.force[k]);
    EXPECT_NEAR(moment.x(), 0.0, 1e-10);
    EXPECT_NEAR(moment.y(), 0.0, 1e-10);
  }
}

TEST(MeasuredZmp, UnderASingleFootThatCarriesItIsThatFoot) {
  std::mt19937_64 random(4);
  for (std::size_t k = 0; k < 4; ++k) {
    Feet feet = random_feet(random);
    for (std::size_t other = 0; other < 4; ++other)
      if (other != k) feet.force[other].setZero();
    EXPECT_TRUE(
        logged::measured_zmp(feet.p_WF, feet.force, 1.0).isApprox(feet.p_WF[k].head<2>(), 1e-12));
  }
}

TEST(MeasuredZmp, IsNotKnownWhileNothingCarriesOrNothingIsBelieved) {
  std::mt19937_64 random(5);
  Feet feet = random_feet(random);
  const PerLeg<Vec3> air{Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  EXPECT_TRUE(logged::measured_zmp(feet.p_WF, air, 1.0).array().isNaN().all());
  feet.force[2].setConstant(kNaN);
  EXPECT_TRUE(logged::measured_zmp(feet.p_WF, feet.force, 1.0).array().isNaN().all());
  EXPECT_TRUE(logged::model_of(TickRecord(), 1.0).zmp.array().isNaN().all());
}

}  // namespace
}  // namespace surefoot::logging
