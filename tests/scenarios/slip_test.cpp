#include "surefoot/closed_loop/closed_loop.hpp"
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
    int cautious = 0;  // forces that a foot is asked for which has slid
    const Vec3 start = loop.truth().p_SB;
    loop.run_until(20.0, [&] {
      const TickRecord& record = loop.record();
      for (std::size_t k = 0; k < kNumLegs; ++k) {
        const FootPlan& foot = record.plan.feet[k];
        least = std::min(least, foot.friction);
        if (foot.friction > 0.3 || !in_contact(foot.phase)) continue;
        const Vec3& force = record.model.force[k];
        const double most = std::sqrt(2.0) * foot.friction * force.z();  // at a pyramid's corner
        EXPECT_LE(force.head<2>().norm(), most + 0.5) << "N, at " << record.reading.time;
        ++cautious;
      }
      return false;
    });
    EXPECT_GT(cautious, 100);
    EXPECT_GT(loop.count(PlanEvent::slip), 0);
    EXPECT_EQ(loop.count(PlanEvent::slowed), 0) << "nobody commands more than before";
    EXPECT_LT(least, 0.25) << "it is 0.2, and 0.5 was believed";
    const double way = (loop.truth().p_SB - start).head<2>().norm();
    EXPECT_GT(way, 1.0);
    EXPECT_GT(loop.truth().p_SB.z(), 0.4);
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
