#include "tests/simulation/plant_support.hpp"

#include <gtest/gtest.h>

#include <cstdint>

namespace surefoot::simulation {
namespace {

/// Hills of ±5 cm under a robot that carries a load off its middle.
PlantOptions rough_ground(std::uint64_t seed, double settle = 0.6) {
  PlantOptions options = test::standing_options();
  options.initial.settle = settle;
  TerrainHeightField hills;
  hills.size_x = hills.size_y = 4.0;
  hills.amplitude = 0.05;
  hills.wavelength = 0.6;
  hills.seed = seed;
  options.terrain.elements = {hills};
  options.disturbances.payload = {.mass = 5.0, .position = Vec3(0.0, 0.05, 0.2)};
  return options;
}

int feet_that_touch(const Plant& plant) {
  int count = 0;
  for (const Leg leg : kLegs) count += plant.truth().feet[index(leg)].touching ? 1 : 0;
  return count;
}

TEST(StandUp, OnRoughGroundAllFeetCarryAndNothingMoves) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Plant plant(test::anymal_b(), rough_ground(seed));
    EXPECT_EQ(feet_that_touch(plant), 4) << seed;
    EXPECT_LT(plant.truth().v_SB.norm(), 0.005) << seed;
    EXPECT_EQ(plant.truth().time, 0.0) << seed;
  }
}

TEST(StandUp, WithoutItTheFootThatTouchesFirstIsTheOnlyOne) {
  EXPECT_LE(feet_that_touch(Plant(test::anymal_b(), rough_ground(1, 0.0))), 1);
}

TEST(StandUp, ALimpRobotLiesWhereItHasSunk) {
  PlantOptions options = test::standing_options();
  options.initial.settle = 0.6;
  options.initial.limp = options.initial.is_given = true;
  for (const Leg leg : kLegs) {
    const double side = is_front(leg) ? 1.0 : -1.0;
    options.initial.q.segment<3>(first_joint(leg)) << 0.0, 1.45 * side, -2.8 * side;
  }
  Plant plant(test::anymal_b(), options);
  for (int tick = 0; tick < 40; ++tick) plant.write({});
  EXPECT_TRUE(plant.truth().torso_contact);
  EXPECT_LT(plant.truth().v_SB.norm(), 0.05);
}

// Not in the ground: well-folded legs are above the torso's lowest point.
TEST(StandUp, APostureOfItsOwnRestsOnWhatIsLowest) {
  PlantOptions options = test::standing_options();
  options.initial.is_given = true;
  for (const Leg leg : kLegs) {
    const double side = is_front(leg) ? 1.0 : -1.0;
    options.initial.q.segment<3>(first_joint(leg)) << 0.0, 1.9 * side, -2.6 * side;
  }
  const Plant plant(test::anymal_b(), options);
  EXPECT_GT(plant.truth().p_SB.z(), 0.09);
}

TEST(StandUp, OnLevelGroundThePostureIsKept) {
  PlantOptions options = test::standing_options();
  options.initial.settle = 0.6;
  const Plant plant(test::anymal_b(), options);
  EXPECT_EQ(feet_that_touch(plant), 4);
  EXPECT_LT((plant.truth().q - options.initial.q).cwiseAbs().maxCoeff(), 0.02);
}

TEST(StandUp, OverAnAbyssItEnds) {
  PlantOptions options = test::standing_options();
  options.initial.settle = 0.6;
  options.initial.position.z() = 1000.0;
  const Plant plant(test::anymal_b(), options);
  EXPECT_EQ(feet_that_touch(plant), 0);
}

}  // namespace
}  // namespace surefoot::simulation
