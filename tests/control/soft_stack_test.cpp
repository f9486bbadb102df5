#include "surefoot/config/stack_file.hpp"
#include "surefoot/control/task_stack.hpp"
#include "surefoot/math/smoothstep.hpp"
#include "surefoot/model/robot_model.hpp"
#include "surefoot/solver/lexicographic_solver.hpp"
#include "surefoot/solver/soft_levels.hpp"
#include "tests/support/anymal_b.hpp"
#include "tests/support/random_motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>

namespace surefoot {
namespace {

using test::anymal_b;
using test::Random;

/// A robot that stands at rest, a little off its reference, and its torques while levels of its
/// stack come within so many ticks.
class StandingRobot {
 public:
  explicit StandingRobot(unsigned seed)
      : model_(anymal_b()),
        stack_(load_stack("terrain_adaptation"), anymal_b()),
        soft_(stack_.hierarchy()),
        solver_(stack_.hierarchy()) {
    Random random(seed);
    RobotState state = random.standing_state(model_.description().q_nominal);
    state.q = model_.description().q_nominal;
    state.q_WB = random.small_rotation(0.03);
    state.v_WB.setZero();
    state.w_WB_B.setZero();
    state.qd.setZero();
    (void)stack_.update(model_.update(state, Vec3::UnitZ()),
                        test::plan_with_contacts({true, true, true, true}));
  }

  /// Largest change of a torque from one tick to the next [N·m].
  double largest_step(std::span<const std::size_t> levels, int ticks) {
    double largest = 0.0;
    Eigen::VectorXd before = torques(levels, 0.0);
    for (int tick = 1; tick <= ticks; ++tick) {
      const Eigen::VectorXd now = torques(levels, smooth_ramp(tick, ticks));
      largest = std::max(largest, (now - before).cwiseAbs().maxCoeff());
      before = now;
    }
    return largest;
  }

 private:
  Eigen::VectorXd torques(std::span<const std::size_t> levels, double share) {
    return solver_.solve(soft_.update(stack_.hierarchy(), levels, share)).x.tail(kNumJoints);
  }

  RobotModel model_;
  TaskStack stack_;
  SoftLevels soft_;
  LexicographicSolver solver_;
};

TEST(SoftStack, TorquesOfAStandingRobotDoNotJumpWhenATorsoLevelComes) {
  constexpr std::array<std::array<std::size_t, 2>, 2> kPairs{{{7, 8}, {8, 9}}};
  constexpr int kTicks = 400;  // 1 s
  double largest_at_once = 0.0;
  for (unsigned seed = 0; seed < 8; ++seed) {
    StandingRobot robot(seed);
    for (const auto& levels : kPairs) {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", level " + std::to_string(levels[0]));
      const double at_once = robot.largest_step(levels, 1);
      largest_at_once = std::max(largest_at_once, at_once);
      EXPECT_LE(robot.largest_step(levels, kTicks), 0.1 * at_once + 1e-6);
    }
  }
  EXPECT_GT(largest_at_once, 0.5) << "nothing to smooth";
}

}  // namespace
}  // namespace surefoot
