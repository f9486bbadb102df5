// Every tick's answer is proven to be the optimum, by what shares no code with the solver.
#include "surefoot/solver/certificate.hpp"

#include "surefoot/solver/lexicographic_solver.hpp"
#include "tests/scenarios/loop.hpp"

#include <gtest/gtest.h>

namespace surefoot {
namespace {

class CertifiedWalk : public testing::TestWithParam<const char*> {};

TEST_P(CertifiedWalk, HasAProvenOptimumAtEveryTick) {
  test::Loop loop(test::scenario(GetParam(), {"planner.calibration.duration=0"}, 4));
  loop.tick();
  solver::LexicographicSolver solver(loop.hierarchy());
  int num_active = 0;
  for (int tick = 1; tick < 2400; ++tick) {
    loop.tick();
    const solver::Solution& solution = solver.solve(loop.hierarchy());
    ASSERT_EQ(solution.status, solver::SolveStatus::optimal) << "tick " << tick;
    ASSERT_EQ(solver::verdict(solver::certify(loop.hierarchy(), solution.x)),
              solver::Verdict::proven)
        << "tick " << tick;
    for (const solver::LevelResult& level : solution.levels) num_active += level.num_active();
  }
  EXPECT_GE(loop.steps_taken(), 3);
  EXPECT_GT(num_active, 100) << "limits took part";
}

INSTANTIATE_TEST_SUITE_P(Scenarios, CertifiedWalk, testing::Values("walk_flat", "step_down"));

}  // namespace
}  // namespace surefoot
