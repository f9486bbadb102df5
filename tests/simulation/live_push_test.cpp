#include "tests/simulation/plant_support.hpp"

#include <gtest/gtest.h>

namespace surefoot::simulation {
namespace {

using test::kMass;

Vec3 momentum(const Plant& plant) {
  return kMass * (plant.truth().v_SCom + Vec3(0.0, 0.0, kGravity * plant.time()));
}

TEST(LivePush, gives_its_impulse_from_the_tick_on_at_which_it_is_given) {
  Plant plant(test::anymal_b(), test::falling_options());
  while (plant.time() < 0.1 - 1e-9) plant.write({});
  EXPECT_LT(momentum(plant).norm(), 1e-6);
  plant.push({"LF_THIGH", 0.0, 0.05, Vec3(30.0, -50.0, 20.0)});
  while (plant.time() < 0.2 - 1e-9) plant.write({});
  EXPECT_LT((momentum(plant) - 0.05 * Vec3(30.0, -50.0, 20.0)).norm(), 0.02);
}

TEST(LivePush, many_pushes_one_after_the_other_all_count_and_leave_nothing_behind) {
  Plant plant(test::anymal_b(), test::falling_options());
  for (int i = 0; i < 12; ++i) {
    plant.push({i % 2 == 0 ? "base" : "RH_SHANK", 0.0, 0.02, Vec3(0.0, 10.0, 0.0)});
    for (int tick = 0; tick < 80; ++tick) plant.write({});
  }
  EXPECT_NEAR(momentum(plant).y(), 12 * 0.2, 0.02);
  for (const double force : plant.truth().xfrc_applied) EXPECT_EQ(force, 0.0);
}

TEST(LivePush, one_that_is_asked_for_later_leaves_those_that_act) {
  Plant plant(test::anymal_b(), test::falling_options());
  plant.push({"base", 0.0, 0.1, Vec3(0.0, 10.0, 0.0)});
  for (int tick = 0; tick < 10; ++tick) plant.write({});
  plant.push({"LF_THIGH", 100.0, 0.1, Vec3(0.0, 10.0, 0.0)});
  while (plant.time() < 0.2 - 1e-9) plant.write({});
  EXPECT_NEAR(momentum(plant).y(), 1.0, 0.02);
  for (const double force : plant.truth().xfrc_applied) EXPECT_EQ(force, 0.0);
}

TEST(LivePush, a_body_that_does_not_exist_is_told_with_those_that_do) {
  Plant plant(test::anymal_b(), test::falling_options());
  EXPECT_THROW(plant.push({"LF_SHNK", 0.0, 0.1, Vec3::Zero()}), UnknownNameError);
  EXPECT_THROW(plant.push({"world", 0.0, 0.1, Vec3::Zero()}), UnknownNameError);
  const std::vector<std::string> bodies = plant.bodies();
  EXPECT_NE(std::ranges::find(bodies, "LF_SHANK"), bodies.end());
  EXPECT_NE(std::ranges::find(bodies, "base"), bodies.end());
}

}  // namespace
}  // namespace surefoot::simulation
