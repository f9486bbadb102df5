#include "app/closed_loop.hpp"
#include "tests/scenarios/loop.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace surefoot {
namespace {

using test::Loop;
using test::scenario;

TEST(Slip, OnVerySlipperyGroundItIsNoticedBelievedAndWalkedOver) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    Loop loop(scenario("slippery", {"terrain.friction=0.2"}, seed));
    double least = 1.0;
    const Vec3 start = loop.truth().p_WB;
    loop.run_until(20.0, [&] {
      for (const FootPlan& foot : loop.record().plan.feet) least = std::min(least, foot.friction);
      return false;
    });
    EXPECT_GT(loop.count(PlanEvent::slip), 0);
    EXPECT_EQ(loop.count(PlanEvent::slowed), 0) << "nobody commands more than before";
    EXPECT_LT(least, 0.25) << "it is 0.2, and 0.5 was believed";
    const double way = (loop.truth().p_WB - start).head<2>().norm();
    EXPECT_GT(way, 1.0);
    EXPECT_GT(loop.truth().p_WB.z(), 0.4);
  }
}

TEST(Slip, OnGoodGroundNoneIsSeenAndTheBeliefStays) {
  Loop loop(scenario("walk_flat", {}, 1));
  loop.run_until(14.0);
  EXPECT_EQ(loop.count(PlanEvent::slip), 0);
  for (const FootPlan& foot : loop.record().plan.feet) EXPECT_EQ(foot.friction, 0.5);
}

}  // namespace
}  // namespace surefoot
