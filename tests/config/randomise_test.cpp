#include "surefoot/config/randomise.hpp"

#include "tests/logging/temporary_folder.hpp"
#include "tests/support/messages.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace surefoot::config {
namespace {

using test::holds;
using test::message_of;

std::vector<RandomDraw> drawn(const std::string& text, std::uint64_t seed,
                              const std::vector<std::string>& assigned = {}) {
  ConfigNode tree = parse_yaml(text, "t.yaml");
  return randomise(tree, seed, assigned);
}

TEST(Randomise, fills_its_range_evenly_over_seeds) {
  constexpr int kSeeds = 4000;
  double sum = 0.0, squares = 0.0, smallest = 1.0, largest = 0.0;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    const double value = uniform_of(static_cast<std::uint64_t>(seed), "terrain.friction");
    sum += value;
    squares += value * value;
    smallest = std::min(smallest, value);
    largest = std::max(largest, value);
  }
  EXPECT_NEAR(sum / kSeeds, 1.0 / 2.0, 0.02);
  EXPECT_NEAR(squares / kSeeds, 1.0 / 3.0, 0.02);
  EXPECT_LT(smallest, 0.01);
  EXPECT_GT(largest, 0.99);
  EXPECT_GE(smallest, 0.0);
  EXPECT_LT(largest, 1.0);
}

TEST(Randomise, draws_two_paths_of_a_seed_without_correlation) {
  constexpr int kSeeds = 4000;
  double product = 0.0;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    const auto number = static_cast<std::uint64_t>(seed);
    product += (uniform_of(number, "initial.x") - 0.5) * (uniform_of(number, "initial.yaw") - 0.5);
  }
  EXPECT_NEAR(product / kSeeds, 0.0, 0.005);
}

TEST(Randomise, draws_the_same_from_the_same_seed_on_every_machine) {
  EXPECT_EQ(uniform_of(1, "initial.x"), 0.5039935001863055);
  EXPECT_EQ(uniform_of(3, "terrain.friction"), 0.18727137029717278);
}

TEST(Randomise, draws_each_number_of_a_vector_by_itself_and_names_it) {
  const std::string text = "randomise: {sensors.encoders.offset: [-0.01, 0.01]}";
  const std::vector<RandomDraw> values = drawn(text, 3);
  ASSERT_EQ(values.size(), 12u);
  std::set<double> different;
  for (const RandomDraw& draw : values) {
    EXPECT_EQ(draw.key, "sensors.encoders.offset");
    EXPECT_LE(std::abs(draw.value), 0.01);
    different.insert(draw.value);
  }
  EXPECT_EQ(different.size(), 12u);
  EXPECT_EQ(values[0].path, "sensors.encoders.offset.LF_HAA");
  EXPECT_EQ(values[11].path, "sensors.encoders.offset.RH_KFE");
  EXPECT_EQ(drawn("randomise: {disturbances.thigh_length_offset: [0, 1]}", 1).size(), 4u);
  EXPECT_EQ(drawn("randomise: {disturbances.base_com_offset: [0, 1]}", 1).at(2).path,
            "disturbances.base_com_offset.z");
}

TEST(Randomise, keeps_the_numbers_of_a_vector_that_were_assigned) {
  const std::string text = "randomise: {sensors.encoders.offset: [-0.01, 0.01]}";
  EXPECT_TRUE(drawn(text, 3, {"sensors.encoders.offset"}).empty());
  const std::vector<RandomDraw> values = drawn(text, 3, {"sensors.encoders.offset.LF_HFE"});
  ASSERT_EQ(values.size(), 11u);
  EXPECT_TRUE(std::ranges::none_of(
      values, [](const RandomDraw& draw) { return draw.path.ends_with("LF_HFE"); }));
}

TEST(Randomise, lays_what_it_draws_over_a_list) {
  ConfigNode tree = parse_yaml(
      "disturbances: {base_com_offset: [7, 8, 9]}\n"
      "randomise: {disturbances.base_com_offset: [0, 1]}",
      "t.yaml");
  (void)randomise(tree, 2, {"disturbances.base_com_offset.y"});
  const ConfigNode* offset = tree.find("disturbances")->find("base_com_offset");
  ASSERT_EQ(offset->kind, ConfigNode::Kind::map);
  EXPECT_EQ(offset->find("y")->text, "8");
  EXPECT_NE(offset->find("x")->text, "7");
}

TEST(Randomise, draws_whole_numbers_with_both_ends_where_the_key_takes_no_others) {
  std::set<double> seen;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    seen.insert(drawn("randomise: {actuators.delay_ticks: [1, 3]}", seed).at(0).value);
  }
  EXPECT_EQ(seen, (std::set<double>{1.0, 2.0, 3.0}));
  EXPECT_TRUE(
      holds(message_of([] { (void)drawn("randomise: {actuators.delay_ticks: [1, 2.5]}", 1); }),
            "t.yaml:1: randomise.actuators.delay_ticks: the ends of this range must be "
            "whole numbers"));
}

/// Scenarios that include ranges of files beside them.
class IncludedRanges : public testing::Test {
 protected:
  IncludedRanges() {
    test::write_file(folder_ / "worn.yaml", "terrain.friction: [0.3, 0.5]\ninitial.x: [0, 1]\n");
  }
  std::vector<RandomDraw> read(const std::string& text) {
    ConfigNode tree = parse_yaml(text, "t.yaml");
    files_ = include_ranges(tree, folder_.path());
    return randomise(tree, 1, {});
  }
  std::string complaint(const std::string& text) {
    return message_of([&] { (void)read(text); });
  }

  test::TemporaryFolder folder_;
  std::vector<std::filesystem::path> files_;
};

TEST_F(IncludedRanges, are_drawn_beside_the_scenarios_own) {
  const std::vector<RandomDraw> values =
      read("randomise: {include: worn.yaml, initial.yaw: [0, 1]}");
  ASSERT_EQ(values.size(), 3u);
  EXPECT_EQ(files_.size(), 1u);
  const std::vector<RandomDraw> several = read("randomise: {include: [worn.yaml, mismatch]}");
  EXPECT_EQ(files_.size(), 5u) << "mismatch includes three others";
  EXPECT_GT(several.size(), 40u);
  const auto friction = std::ranges::find(several, "terrain.friction", &RandomDraw::path);
  EXPECT_LE(friction->value, 0.5) << "the first file that names a path counts";
}

TEST_F(IncludedRanges, give_way_to_the_scenarios_own) {
  const std::vector<RandomDraw> values =
      read("randomise:\n  include: worn.yaml\n  terrain.friction: [0.9, 1.0]\n  initial.x:\n");
  ASSERT_EQ(values.size(), 1u);
  EXPECT_GE(values[0].value, 0.9);
  EXPECT_TRUE(read("randomise: {include: }").empty());
}

TEST_F(IncludedRanges, that_make_no_sense_are_told_with_file_and_line) {
  EXPECT_TRUE(holds(complaint("a: 1\nrandomise:\n  include: mismtch\n"),
                    "t.yaml:3: randomise.include: unknown randomisation \"mismtch\"; did you mean "
                    "\"mismatch\"?"));
  EXPECT_TRUE(
      holds(complaint("randomise: {include: {a: b}}"), "t.yaml:1: randomise.include: a map"));
  test::write_file(folder_ / "bad.yaml", "initial.x: [0, 1]\nterrain.friction: 0.5\n");
  EXPECT_TRUE(holds(complaint("randomise: {include: bad.yaml}"),
                    "bad.yaml:2: randomise.terrain.friction: must be a range [min, max]"));
}

TEST_F(IncludedRanges, include_others_and_each_counts_once) {
  test::write_file(folder_ / "a.yaml", "include: b.yaml\ninitial.x: [2, 3]\n");
  test::write_file(folder_ / "b.yaml", "include: [a.yaml, worn.yaml]\n");
  const std::vector<RandomDraw> values = read("randomise: {include: [a.yaml, b.yaml]}");
  EXPECT_EQ(files_.size(), 3u);
  ASSERT_EQ(values.size(), 2u);
  test::write_file(folder_ / "a.yaml", "include: c.yaml\n");
  EXPECT_TRUE(holds(complaint("randomise: {include: a.yaml}"), "a.yaml:1: randomise.include"));
}

}  // namespace
}  // namespace surefoot::config
