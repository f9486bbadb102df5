#include "surefoot/evaluation/effort_judge.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace surefoot::evaluation {
namespace {

constexpr double kPeriod = 0.0025, kMass = 20.0;

// Two joints that work and one that brakes, for a second.
Metrics walk(double way, const Scale& scale = {}) {
  EffortJudge judge(kPeriod, kMass, scale);
  simulation::GroundTruth truth;
  truth.torque.head<3>() = Vec3(10.0, -5.0, 20.0);
  truth.qd.head<3>() = Vec3(2.0, -4.0, -6.0);
  for (int tick = 0; tick < 400; ++tick) {
    judge.add(truth, truth.torque);
    judge.add_walk(truth);
  }
  Metrics metrics;
  judge.write(way, metrics);
  return metrics;
}

TEST(EffortJudge, CostOfTransportIsPositiveWorkOverWeightAndWay) {
  EXPECT_NEAR(walk(2.0).cost_of_transport, 40.0 / (kMass * kGravity * 2.0), 1e-9);
}

TEST(EffortJudge, ShortWaysHaveNoCost) {
  EXPECT_TRUE(std::isnan(walk(0.4).cost_of_transport));
  EXPECT_FALSE(std::isnan(walk(0.4, {.length = 0.5}).cost_of_transport));
}

TEST(EffortJudge, FastestJointCountsInEitherDirection) {
  EXPECT_EQ(walk(2.0).joint_speed_max_radps, 6.0);
}

}  // namespace
}  // namespace surefoot::evaluation
