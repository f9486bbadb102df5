#include "surefoot/config/terrain_fields.hpp"

#include "surefoot/config/field_reader.hpp"
#include "surefoot/config/robot_file.hpp"
#include "surefoot/simulation/plant.hpp"
#include "tests/support/messages.hpp"

#include <cmath>

namespace surefoot::config {
namespace {

using simulation::Plant;
using test::holds;
using test::message_of;

simulation::TerrainOptions read(const std::string& text) {
  const ConfigNode tree = parse_yaml(text, "t.yaml");
  simulation::TerrainOptions terrain;
  Section section(tree, "terrain");
  read(section, terrain_fields(terrain));
  section.finish();
  return terrain;
}

/// The physics that a terrain becomes.
Plant plant_on(const std::string& text) {
  simulation::PlantOptions options;
  options.terrain = read(text);
  options.initial.position.z() = 5.0;
  return Plant(load_robot("anymal_b"), options);
}

TEST(Terrain, without_elements_is_the_plane) {
  const simulation::TerrainOptions terrain = read("friction: 0.4");
  ASSERT_EQ(terrain.elements.size(), 1u);
  EXPECT_TRUE(std::holds_alternative<simulation::TerrainLevel>(terrain.elements[0]));
  EXPECT_EQ(terrain.friction, 0.4);
}

TEST(Terrain, steps_and_slopes_have_their_heights_before_and_behind_their_edge) {
  struct Case {
    std::string ground;
    std::vector<Vec3> points;
  };
  const double slope = std::tan(0.2);
  for (const auto& [ground, points] : std::vector<Case>{
           {"steps, edge: 0.5, height: -0.14",
            {{-3.0, 0.3, 0.0}, {0.499, -0.3, 0.0}, {0.501, 0.0, -0.14}, {5.0, 2.0, -0.14}}},
           {"steps, edge: 0.5, height: 0.15, tread: 0.35, count: 3",
            {{0.4, 0.0, 0.0}, {0.6, 0.0, 0.15}, {1.0, 0.0, 0.30}, {1.3, 0, 0.45}, {4.0, 0, 0.45}}},
           {"slope, start: 0.5, pitch: 0.2", {{0.4, 0.0, 0.0}, {1.5, 0.7, slope}}},
           {"slope, start: 0.5, pitch: -0.2", {{1.5, 0.0, -slope}}},
           {"slope, start: 0.5, roll: 0.2",
            {{1.5, 0.3, 0.3 * slope}, {1.5, -0.3, -0.3 * slope}}}}) {
    const Plant plant = plant_on("elements: {ground: {shape: " + ground + "}}");
    for (const Vec3& p : points)
      EXPECT_NEAR(plant.terrain_height(p.x(), p.y()), p.z(), 1e-9) << ground << " at " << p.x();
  }
}

TEST(Terrain, a_slope_rises_to_where_uphill_is) {
  for (const double uphill : {-2.5, -0.8, 0.0, 0.4, 1.6, 3.1}) {
    const Plant plant = plant_on(
        "elements: {ground: {shape: slope, start: 0.5, incline: 0.2, "
        "uphill: " +
        std::to_string(uphill) + "}}");
    const double x = 1.4, y = 0.3;
    const double way = (x - 0.5) * std::cos(uphill) + y * std::sin(uphill);
    EXPECT_NEAR(plant.terrain_height(x, y), way * std::tan(0.2), 1e-6) << uphill;
  }
}

TEST(Terrain, friction_tiles_are_level_and_each_has_its_own_friction_from_the_seed) {
  const auto tiles = [](int seed) {
    return read(
               "elements: {a: {shape: friction_tiles, size_x: 4, size_y: 2, tile: 0.5, position: "
               "[1, "
               "0, -0.2], friction_min: 0.3, friction_max: 0.9, seed: " +
               std::to_string(seed) + "}}")
        .elements;
  };
  const std::vector<simulation::TerrainElement> first = tiles(4), again = tiles(4),
                                                other = tiles(5);
  ASSERT_EQ(first.size(), 32u);
  double lowest = 1.0, highest = 0.0;
  int same = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    const auto& box = std::get<simulation::TerrainBox>(first[i]);
    EXPECT_NEAR(box.position.z() + box.size.z() / 2.0, -0.2, 1e-12);
    EXPECT_EQ(box.friction, std::get<simulation::TerrainBox>(again[i]).friction);
    same += box.friction == std::get<simulation::TerrainBox>(other[i]).friction ? 1 : 0;
    lowest = std::min(lowest, box.friction);
    highest = std::max(highest, box.friction);
  }
  EXPECT_EQ(same, 0);
  EXPECT_TRUE(lowest >= 0.3 && lowest < 0.4 && highest > 0.8 && highest <= 0.9)
      << lowest << ", " << highest;
}

TEST(Terrain, friction_tiles_that_make_no_sense_say_why) {
  const auto says = [](const std::string& keys, const char* what) {
    const std::string text =
        message_of([&] { (void)read("elements: {a: {shape: friction_tiles, " + keys + "}}"); });
    EXPECT_TRUE(holds(text, what)) << text;
  };
  says("size_x: 4, size_y: 2, friction_min: 0.3", "terrain.elements.a.friction_max: this key is");
  says("size_x: 4, size_y: 2, friction_min: 0.9, friction_max: 0.3", "not be below friction_min");
  says("size_x: 4, size_y: 2, tile: 0.01, friction_min: 0, friction_max: 1", "a.tile: makes more");
}

TEST(Terrain, rough_ground_and_boxes_stay_within_their_heights) {
  const Plant rough = plant_on(
      "elements: {a: {shape: height_field, size_x: 6, size_y: 4, amplitude: 0.05, wavelength: 0.6, "
      "seed: 3}}");
  const Plant boxes = plant_on(
      "elements: {a: {shape: random_boxes, size_x: 6, size_y: 4, cell: 0.4, max_height: 0.1, seed: "
      "3}}");
  double rough_lowest = 1.0, rough_highest = -1.0, box_lowest = 1.0, box_highest = -1.0;
  for (double x = -2.7; x < 2.7; x += 0.11) {
    for (double y = -1.7; y < 1.7; y += 0.11) {
      rough_lowest = std::min(rough_lowest, rough.terrain_height(x, y));
      rough_highest = std::max(rough_highest, rough.terrain_height(x, y));
      box_lowest = std::min(box_lowest, boxes.terrain_height(x, y));
      box_highest = std::max(box_highest, boxes.terrain_height(x, y));
    }
  }
  EXPECT_TRUE(rough_lowest >= -0.0501 && rough_lowest < -0.02) << rough_lowest;
  EXPECT_TRUE(rough_highest <= 0.0501 && rough_highest > 0.02) << rough_highest;
  EXPECT_TRUE(box_lowest >= 0.0 && box_lowest < 0.02) << box_lowest;
  EXPECT_TRUE(box_highest <= 0.1 && box_highest > 0.08) << box_highest;
}

TEST(Terrain, shapes_and_their_keys_that_are_wrong_are_told) {
  const auto told = [](const std::string& element) {
    return message_of([&] { (void)read("elements: {a: {shape: " + element + "}}"); });
  };
  EXPECT_TRUE(holds(told("bxo"),
                    "t.yaml:1: terrain.elements.a.shape: unknown choice \"bxo\"; did "
                    "you mean \"box\"?"));
  EXPECT_TRUE(holds(told("plane, size: [1, 1, 1]"), "terrain.elements.a.size: unknown key"));
  EXPECT_TRUE(holds(told("box, size: [1, 1, 0]"), "above 0"));
}

TEST(Terrain, an_element_of_the_base_is_taken_away_by_naming_nothing) {
  EXPECT_EQ(read("elements: {a: , b: {shape: plane}}").elements.size(), 1u);
}

}  // namespace
}  // namespace surefoot::config
