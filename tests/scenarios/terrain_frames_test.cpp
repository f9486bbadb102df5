// The plane through the footholds jumps at a touchdown; what is made from it does not.
#include "surefoot/math/rotation.hpp"
#include "tests/scenarios/loop.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace surefoot {
namespace {

struct Walk {
  const char* scenario;
  double until;  ///< feet stand on both sides of the edge, and have searched [s]
};

class TerrainFrames : public testing::TestWithParam<Walk> {};

TEST_P(TerrainFrames, DoNotJumpAtATouchdown) {
  const Walk& walk = GetParam();
  test::Loop loop(test::scenario(walk.scenario, {"planner.calibration.duration=0"}));
  loop.tick();
  MotionPlan before = loop.record().plan;
  while (loop.record().state.time < walk.until) {
    loop.tick();
    const MotionPlan& now = loop.record().plan;
    const double time = loop.record().state.time;
    ASSERT_LE(Quat(now.R_WC).angularDistance(Quat(before.R_WC)), 0.0015) << time;
    ASSERT_LE(now.torso.q_WB.angularDistance(before.torso.q_WB), 0.003) << time;
    ASSERT_LE((now.torso.w_WB - before.torso.w_WB).norm(), 0.03) << time;
    ASSERT_LE((now.torso.wdot_WB - before.torso.wdot_WB).norm(), 0.5) << time;
    ASSERT_LE(std::abs(now.torso.height - before.torso.height), 0.001) << time;
    ASSERT_LE(std::abs(now.torso.height_rate - before.torso.height_rate), 0.01) << time;
    before = now;
  }
  EXPECT_GE(loop.count(PlanEvent::touchdown), 5);
}

INSTANTIATE_TEST_SUITE_P(Scenarios, TerrainFrames,
                         testing::Values(Walk{"walk_flat", 10.0}, Walk{"slope_up", 25.0},
                                         Walk{"step_down", 36.0}),
                         [](const auto& walk) { return std::string(walk.param.scenario); });

}  // namespace
}  // namespace surefoot
