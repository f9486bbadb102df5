#include "surefoot/config/randomise.hpp"

#include <gtest/gtest.h>

namespace surefoot {
namespace {

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

}  // namespace
}  // namespace surefoot
