#include "surefoot/gaits/rhythm/cycle_motion.hpp"

#include "surefoot/base/scale.hpp"
#include "surefoot/math/numbers.hpp"
#include "tests/gaits/some_gaits.hpp"

#include <gtest/gtest.h>

namespace surefoot::gaits {
namespace {

constexpr int kSteps = 400;

/// Calls `use` with the motion at places all around the cycle.
template <typename Use>
void around(const PlannerOptions& options, const Use& use) {
  const CycleMotion cycle(options, Scale{});
  for (int i = 0; i < kSteps; ++i) use(cycle.at(i / double{kSteps}));
}

TEST(CycleMotion, keeps_the_com_where_it_is_in_a_trot) {
  around(test::kTrot, [](const Motion<Vec3>& motion) {
    EXPECT_EQ(motion.p.norm() + motion.v.norm() + motion.a.norm(), 0.0);
  });
}

TEST(CycleMotion, falls_freely_in_a_flight_and_comes_back) {
  for (const PlannerOptions& options : {test::kPronk, test::kFlight}) {
    double lowest = 0.0;
    Vec3 mean = Vec3::Zero();
    around(options, [&](const Motion<Vec3>& motion) {
      lowest = std::min(lowest, motion.a.z());
      mean += Vec3(motion.p.z(), motion.v.z(), motion.a.z()) / kSteps;
    });
    EXPECT_NEAR(lowest, -kGravity, 1e-6);
    EXPECT_NEAR(mean.norm(), 0.0, 0.02);
  }
}

TEST(CycleMotion, goes_as_its_velocity_says_and_without_a_jump) {
  for (const PlannerOptions& options : {test::kPace, test::kPronk, test::slow_crawl()}) {
    const CycleMotion cycle(options, Scale{});
    const double dt = options.rhythm.period / kSteps;
    for (int i = 0; i < kSteps; ++i) {
      const Motion<Vec3> now = cycle.at(i / double{kSteps}),
                         next = cycle.at((i + 1) / double{kSteps});
      EXPECT_LT((next.p - now.p - dt * now.v).norm(), 2e-4) << i;
      EXPECT_LT((next.v - now.v - dt * now.a).norm(), 0.06) << i;
    }
  }
}

TEST(CycleMotion, pitches_the_torso_by_the_share_of_the_moment_that_the_com_does_not_take) {
  PlannerOptions bound = test::kBound;
  const CycleMotion sways(bound, Scale{});
  bound.rhythm.pitch = 0.6;
  const CycleMotion pitches(bound, Scale{});
  EXPECT_EQ(sways.pitch_at(0.3).p, 0.0);
  EXPECT_LT(sways.at(0.25).p.x(), -0.005) << "front legs swing";
  EXPECT_NEAR(pitches.at(0.25).p.x(), 0.4 * sways.at(0.25).p.x(), 1e-9);
  EXPECT_GT(pitches.pitch_at(0.25).a, 10.0) << "hind legs push the nose down";
  EXPECT_LT(pitches.pitch_at(0.25).p, -0.05) << "before it is highest";
  EXPECT_NEAR(pitches.pitch_at(0.75).p, -pitches.pitch_at(0.25).p, 1e-6);
  const double dt = bound.rhythm.period / kSteps;
  for (int i = 0; i < kSteps; ++i) {
    const Motion<double> now = pitches.pitch_at(i / double{kSteps}),
                         next = pitches.pitch_at((i + 1) / double{kSteps});
    EXPECT_NEAR(next.p - now.p, dt * now.v, 5e-4) << i;
  }
}

TEST(CycleMotion, leans_to_the_legs_that_stand_in_a_pace_and_a_crawl) {
  const CycleMotion pace(test::kPace, Scale{});
  EXPECT_LT(pace.at(0.25).p.y(), -0.005) << "left legs swing";
  EXPECT_GT(pace.at(0.75).p.y(), 0.005);
  const CycleMotion crawl(test::slow_crawl(), Scale{});
  EXPECT_LT(crawl.at(0.1).p.y(), -0.02) << "the left hind leg swings";
  EXPECT_GT(crawl.at(0.6).p.y(), 0.02) << "the right hind leg swings";
}

}  // namespace
}  // namespace surefoot::gaits
