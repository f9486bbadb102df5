#include "surefoot/simulation/terrain_generators.hpp"
#include "tests/simulation/plant_support.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace surefoot::simulation {
namespace {

PlantOptions above(std::vector<TerrainElement> elements) {
  PlantOptions options = test::falling_options();
  options.terrain.elements = std::move(elements);
  return options;
}

TEST(Terrain, IsThePlaneAtZeroWhenNoneIsGiven) {
  const Plant plant(test::anymal_b(), above({}));
  for (const double x : {-300.0, 0.0, 0.7})
    EXPECT_NEAR(plant.terrain_height(x, 2.0 * x), 0.0, 1e-9);
}

TEST(Terrain, ARobotAboveItIsNotTerrain) {
  const Plant plant(test::anymal_b(), test::standing_options());
  EXPECT_NEAR(plant.terrain_height(0.0, 0.0), 0.0, 1e-9);
}

TEST(Terrain, HasAHeightOnlyWhereThereIsSome) {
  TerrainBox box;
  box.position = Vec3(1.0, 2.0, 0.3);
  box.size = Vec3(0.4, 0.6, 0.2);
  const Plant plant(test::anymal_b(), above({box}));
  EXPECT_NEAR(plant.terrain_height(1.0, 2.0), 0.4, 1e-9);
  EXPECT_NEAR(plant.terrain_height(1.19, 2.29), 0.4, 1e-9);
  EXPECT_TRUE(std::isnan(plant.terrain_height(1.21, 2.0)));
  EXPECT_TRUE(std::isnan(plant.terrain_height(1.0, 2.31)));
}

TEST(Terrain, TurnsBoxesByRollThenPitchThenYawAboutFixedAxes) {
  TerrainBox box;
  box.size = Vec3(4.0, 0.5, 0.2);
  box.rpy = Vec3(0.0, -0.1, kPi / 2.0);  // rises towards its own +x, which points along y
  const Plant plant(test::anymal_b(), above({box}));
  const double top = 0.1 / std::cos(0.1);
  EXPECT_NEAR(plant.terrain_height(0.0, 1.0), top + std::tan(0.1), 1e-9);
  EXPECT_NEAR(plant.terrain_height(0.0, -1.0), top - std::tan(0.1), 1e-9);
  EXPECT_TRUE(std::isnan(plant.terrain_height(1.0, 0.0)));
}

TEST(Terrain, InclinesPlanes) {
  TerrainLevel plane;
  plane.position = Vec3(0.0, 0.0, 0.5);
  plane.rpy = Vec3(0.15, 0.0, 0.0);
  const Plant plant(test::anymal_b(), above({plane}));
  EXPECT_NEAR(plant.terrain_height(3.0, 2.0), 0.5 + 2.0 * std::tan(0.15), 1e-9);
}

TEST(Terrain, HasTheHeightsOfAFieldAtItsGridPoints) {
  TerrainHeightField field;
  field.position = Vec3(1.0, -2.0, 0.1);
  field.size_x = 3.0;
  field.size_y = 2.0;
  field.columns = 4;
  field.rows = 3;
  field.heights = {0.0,  0.1,  0.2, 0.05,    // y = −3
                   -0.1, 0.0,  0.3, 0.15,    // y = −2
                   0.2,  0.25, 0.1, -0.05};  // y = −1
  const Plant plant(test::anymal_b(), above({field}));
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) {
      // Just inside the border, where a ray can hit.
      const double x = std::clamp(-0.5 + column, -0.4999, 2.4999);
      const double y = std::clamp(-3.0 + row, -2.9999, -1.0001);
      const double expected = 0.1 + field.heights[static_cast<std::size_t>(4 * row + column)];
      EXPECT_NEAR(plant.terrain_height(x, y), expected, 1e-4) << row << " " << column;
    }
  }
}

TEST(Terrain, CarriesARobotOnAHeightField) {
  PlantOptions options = test::standing_options();
  TerrainHeightField field;
  field.size_x = field.size_y = 4.0;
  field.amplitude = 0.02;
  options.terrain.elements = {field};
  test::HeldRobot robot(options);
  robot.run(1.0);
  const double weight = test::kMass * kGravity;
  EXPECT_NEAR(robot.ground_force().z(), weight, 0.01 * weight);
  EXPECT_EQ(robot.truth().shank_contacts, 0);
}

TEST(Terrain, AcceptsAFieldWithoutHeightDifferences) {
  TerrainHeightField field;
  field.position.z() = 0.25;
  field.columns = field.rows = 3;
  field.heights.assign(9, 0.5);
  const Plant plant(test::anymal_b(), above({field}));
  EXPECT_NEAR(plant.terrain_height(0.1, 0.1), 0.75, 1e-6);
}

TEST(GeneratedHeights, FillTheChosenAmplitude) {
  TerrainHeightField field;
  field.size_x = 3.0;
  field.size_y = 2.0;
  field.amplitude = 0.07;
  field.wavelength = 0.5;
  const TerrainHeightField filled = with_heights(field);
  EXPECT_EQ(filled.heights.size(), static_cast<std::size_t>(filled.rows * filled.columns));
  const auto [lowest, highest] = std::minmax_element(filled.heights.begin(), filled.heights.end());
  EXPECT_NEAR(std::max(-*lowest, *highest), 0.07, 1e-12);
  EXPECT_LT(*lowest, -0.02);
  EXPECT_GT(*highest, 0.02);
}

TEST(GeneratedHeights, AreSmoothAtTheScaleOfTheirWavelength) {
  TerrainHeightField field;
  field.size_x = field.size_y = 4.0;
  field.columns = field.rows = 201;  // 2 cm
  field.amplitude = 0.05;
  field.wavelength = 0.5;
  const TerrainHeightField filled = with_heights(field);
  double steepest = 0.0;
  int crossings = 0;
  for (std::size_t i = 1; i < 201; ++i) {
    steepest = std::max(steepest, std::abs(filled.heights[i] - filled.heights[i - 1]) / 0.02);
    crossings += filled.heights[i] * filled.heights[i - 1] < 0.0 ? 1 : 0;
  }
  EXPECT_LT(steepest, 2.0 * 2.0 * kPi * 0.05 / 0.4);
  EXPECT_GE(crossings, 4);
  EXPECT_LE(crossings, 24);
}

TEST(GeneratedHeights, AreTheSameForASeedAndOthersForAnother) {
  TerrainHeightField field;
  field.amplitude = 0.05;
  field.seed = 3;
  const std::vector<double> first = with_heights(field).heights;
  EXPECT_EQ(first, with_heights(field).heights);
  field.seed = 4;
  EXPECT_NE(first, with_heights(field).heights);
}

TEST(RandomBoxes, HaveTopsBetweenZeroAndTheirMaximum) {
  TerrainRandomBoxes field;
  field.position = Vec3(0.5, 0.0, 0.2);
  field.size_x = 3.0;
  field.size_y = 1.5;
  field.cell = 0.3;
  field.max_height = 0.12;
  const Plant plant(test::anymal_b(), above({field}));
  double lowest = 1.0;
  double highest = -1.0;
  for (int column = 0; column < 10; ++column) {
    for (int row = 0; row < 5; ++row) {
      const double height = plant.terrain_height(0.5 + 0.3 * (column - 4.5), 0.3 * (row - 2.0));
      lowest = std::min(lowest, height);
      highest = std::max(highest, height);
    }
  }
  EXPECT_GE(lowest, 0.2);
  EXPECT_LT(lowest, 0.22);
  EXPECT_LE(highest, 0.32);
  EXPECT_GT(highest, 0.30);
  EXPECT_TRUE(std::isnan(plant.terrain_height(2.1, 0.0)));
}

TEST(RandomBoxes, AreTheSameForASeedAndOthersForAnother) {
  TerrainRandomBoxes field;
  field.seed = 9;
  const Plant first(test::anymal_b(), above({field}));
  const Plant second(test::anymal_b(), above({field}));
  field.seed = 10;
  const Plant other(test::anymal_b(), above({field}));
  int equal = 0;
  for (int i = 0; i < 6; ++i) {
    const double x = -0.75 + 0.3 * i;
    EXPECT_EQ(first.terrain_height(x, 0.1), second.terrain_height(x, 0.1));
    equal += first.terrain_height(x, 0.1) == other.terrain_height(x, 0.1) ? 1 : 0;
  }
  EXPECT_EQ(equal, 0);
}

TEST(InitialHeight, PutsTheFirstFootSphereOnWhateverIsUnderIt) {
  TerrainBox step;  // under the right fore foot alone
  step.position = Vec3(0.5, -0.25, 0.0);
  step.size = Vec3(0.3, 0.3, 0.16);
  PlantOptions options = test::standing_options();
  options.terrain.elements = {TerrainLevel{}, step};
  const Plant plant(test::anymal_b(), options);
  EXPECT_NEAR(plant.truth().p_SF[index(Leg::RF)].z(), 0.08 + 0.031, 1e-9);
  EXPECT_TRUE(plant.truth().feet[index(Leg::RF)].penetration < 1e-6);
}

TEST(InitialHeight, KeepsTheSpheresOutOfASlope) {
  const double angle = 0.3;
  TerrainLevel slope;
  slope.rpy = Vec3(0.0, angle, 0.0);
  PlantOptions options = test::standing_options();
  options.terrain.elements = {slope};
  const Plant plant(test::anymal_b(), options);
  const Vec3 normal(std::sin(angle), 0.0, std::cos(angle));
  double lowest = 1.0;
  for (const Vec3& p_SF : plant.truth().p_SF) lowest = std::min(lowest, p_SF.dot(normal));
  EXPECT_NEAR(lowest, 0.031, 5e-5);
}

TEST(InitialHeight, FollowsYawAndPosition) {
  TerrainBox step;
  step.position = Vec3(2.0, 3.0 + 0.46, 0.0);
  step.size = Vec3(2.0, 0.2, 0.2);
  PlantOptions options = test::standing_options();
  options.terrain.elements = {TerrainLevel{}, step};
  options.initial.position.head<2>() << 2.0, 3.0;
  options.initial.yaw = kPi / 2.0;
  const Plant plant(test::anymal_b(), options);
  EXPECT_NEAR(plant.truth().p_SF[index(Leg::LF)].z(), 0.1 + 0.031, 1e-9);
  EXPECT_NEAR(plant.truth().p_SF[index(Leg::LF)].y(), 3.46, 0.01);
}

TEST(InitialHeight, IsTheGivenOneWhenThereIsOne) {
  PlantOptions options = test::standing_options();
  options.initial.position = Vec3(0.1, 0.2, 1.7);
  const Plant plant(test::anymal_b(), options);
  EXPECT_EQ(plant.truth().p_SB, options.initial.position);
}

}  // namespace
}  // namespace surefoot::simulation
