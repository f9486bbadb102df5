#include "surefoot/simulation/make_estimator.hpp"

#include "tests/simulation/plant_support.hpp"

#include <gtest/gtest.h>

#include <set>

namespace surefoot::simulation {
namespace {

TEST(MakeEstimator, MakesOneOfEveryKindThatFollowsThePlant) {
  for (const estimation::Estimation estimation : estimation::kEstimations) {
    Plant plant(test::anymal_b(), test::falling_options());
    const auto estimator = make_estimator(estimation, {test::anymal_b(), 0.0025, plant});
    ASSERT_NE(estimator, nullptr) << estimation::name(estimation);
    TickContext falling;
    for (FootContact& contact : falling.contacts) contact.carries = false;
    for (int tick = 0; tick < 10; ++tick) {
      (void)estimator->update(plant.read(), falling);
      plant.write({});
    }
    const RobotState& state = estimator->update(plant.read(), falling);
    EXPECT_EQ(state.time, plant.time()) << estimation::name(estimation);
    EXPECT_LT((state.q - plant.truth().q).norm(), 0.01) << estimation::name(estimation);
    EXPECT_LT((state.v_WB - plant.truth().v_SB).norm(), 0.01) << estimation::name(estimation);
  }
}

TEST(MakeEstimator, ForAKindThatThereIsNotIsAnError) {
  const Plant plant(test::anymal_b(), test::falling_options());
  EXPECT_THROW((void)make_estimator(static_cast<estimation::Estimation>(99),
                                    {test::anymal_b(), 0.0025, plant}),
               Error);
}

TEST(Estimation, EveryKindHasItsOwnName) {
  std::set<std::string_view> names{"unknown"};
  for (const estimation::Estimation estimation : estimation::kEstimations) {
    EXPECT_TRUE(names.insert(estimation::name(estimation)).second) << estimation::name(estimation);
  }
}

}  // namespace
}  // namespace surefoot::simulation
