#include "surefoot/config/terrain_section.hpp"

#include "surefoot/config/robot_file.hpp"
#include "surefoot/simulation/plant.hpp"
#include "tests/config/messages.hpp"

#include <cmath>

namespace surefoot {
namespace {

using test::holds;
using test::message_of;

TerrainOptions read(const std::string& text) {
  const ConfigNode tree = parse_yaml(text, "t.yaml");
  TerrainOptions terrain;
  Section section(tree, "terrain");
  read_terrain(section, terrain);
  section.finish();
  return terrain;
}

/// The physics that a terrain becomes.
Plant plant_on(const std::string& text) {
  PlantOptions options;
  options.terrain = read(text);
  options.initial.position.z() = 5.0;
  return Plant(load_robot("anymal_b"), options);
}

TEST(TerrainSection, without_elements_is_the_plane) {
  const TerrainOptions terrain = read("friction: 0.4");
  ASSERT_EQ(terrain.elements.size(), 1u);
  EXPECT_TRUE(std::holds_alternative<TerrainLevel>(terrain.elements[0]));
  EXPECT_EQ(terrain.friction, 0.4);
}

TEST(TerrainSection, a_step_down_is_level_up_to_the_edge_and_lower_behind_it) {
  const Plant plant = plant_on("elements: {ground: {shape: steps, edge: 0.5, height: -0.14}}");
  EXPECT_NEAR(plant.terrain_height(-3.0, 0.3), 0.0, 1e-9);
  EXPECT_NEAR(plant.terrain_height(0.499, -0.3), 0.0, 1e-9);
  EXPECT_NEAR(plant.terrain_height(0.501, 0.0), -0.14, 1e-9);
  EXPECT_NEAR(plant.terrain_height(5.0, 2.0), -0.14, 1e-9);
}

TEST(TerrainSection, stairs_up_rise_by_one_step_a_tread) {
  const Plant plant = plant_on(
      "elements: {ground: {shape: steps, edge: 0.5, height: 0.15, tread: 0.35, count: 3}}");
  EXPECT_NEAR(plant.terrain_height(0.4, 0.0), 0.0, 1e-9);
  EXPECT_NEAR(plant.terrain_height(0.6, 0.0), 0.15, 1e-9);
  EXPECT_NEAR(plant.terrain_height(1.0, 0.0), 0.30, 1e-9);
  EXPECT_NEAR(plant.terrain_height(1.3, 0.0), 0.45, 1e-9);
  EXPECT_NEAR(plant.terrain_height(4.0, 0.0), 0.45, 1e-9);
}

TEST(TerrainSection, a_slope_rises_from_its_start_on) {
  const Plant plant = plant_on("elements: {ground: {shape: slope, start: 0.5, pitch: 0.2}}");
  EXPECT_NEAR(plant.terrain_height(0.4, 0.0), 0.0, 1e-9);
  EXPECT_NEAR(plant.terrain_height(1.5, 0.7), std::tan(0.2), 1e-9);
}

TEST(TerrainSection, a_slope_down_falls_and_one_along_rises_to_the_left) {
  const Plant down = plant_on("elements: {ground: {shape: slope, start: 0.5, pitch: -0.2}}");
  EXPECT_NEAR(down.terrain_height(1.5, 0.0), -std::tan(0.2), 1e-9);
  const Plant along = plant_on("elements: {ground: {shape: slope, start: 0.5, roll: 0.2}}");
  EXPECT_NEAR(along.terrain_height(1.5, 0.3), 0.3 * std::tan(0.2), 1e-9);
  EXPECT_NEAR(along.terrain_height(1.5, -0.3), -0.3 * std::tan(0.2), 1e-9);
}

TEST(TerrainSection, an_unknown_shape_lists_the_shapes) {
  EXPECT_TRUE(
      holds(message_of([] { (void)read("elements: {a: {shape: bxo}}"); }),
            "t.yaml:1: terrain.elements.a.shape: unknown choice \"bxo\"; did you mean \"box\"?"));
}

TEST(TerrainSection, keys_of_another_shape_are_unknown) {
  EXPECT_TRUE(
      holds(message_of([] { (void)read("elements: {a: {shape: plane, size: [1, 1, 1]}}"); }),
            "terrain.elements.a.size: unknown key"));
}

TEST(TerrainSection, a_box_without_thickness_is_an_error) {
  EXPECT_TRUE(holds(message_of([] { (void)read("elements: {a: {shape: box, size: [1, 1, 0]}}"); }),
                    "above 0"));
}

TEST(TerrainSection, an_element_of_the_base_is_taken_away_by_naming_nothing) {
  EXPECT_EQ(read("elements: {a: , b: {shape: plane}}").elements.size(), 1u);
}

}  // namespace
}  // namespace surefoot
