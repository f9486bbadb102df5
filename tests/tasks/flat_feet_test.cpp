// Tasks of a robot with flat feet.
#include "surefoot/solver/non_negative_least_squares.hpp"
#include "surefoot/tasks/com_xy.hpp"
#include "surefoot/tasks/friction_cone.hpp"
#include "surefoot/tasks/no_contact_motion.hpp"
#include "tests/support/biped.hpp"
#include "tests/support/random_motion.hpp"
#include "tests/tasks/scene.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace surefoot::tasks {
namespace {

using test::Random;
using Vector6 = Eigen::Matrix<double, 6, 1>;

/// A biped that stands, and what its tasks see.
struct Standing {
  explicit Standing(unsigned seed) : model(test::biped()), random(seed) {
    plan.feet = PerLeg<FootPlan>(2, FootPlan{});
    for (FootPlan& foot : plan.feet) {
      foot.force_max = 1e4;
      foot.friction = 0.6;
    }
  }

  TaskInput update() {
    RobotState state = random.state();
    state.q_WB = random.small_rotation(0.1);
    state.q = model.description().q_nominal;
    for (double& angle : state.q) angle += random.uniform(-0.1, 0.1);
    state.qd.setZero(state.q.size());
    const model::Dynamics& dynamics = model.update(state, Vec3::UnitZ());
    support.update(dynamics, plan);
    return {dynamics, plan, support, model.description()};
  }

  /// A value of x with these forces and moments, L before R.
  [[nodiscard]] VecX x_with(const VecX& wrenches) const {
    const MatX map = support.Lambda();
    return map.completeOrthogonalDecomposition().solve(wrenches - support.lambda_0());
  }

  template <typename Task>
  Task prepared(Task task) const {
    task.prepare(model.description());
    return task;
  }

  model::RobotModel model;
  Random random;
  MotionPlan plan;
  model::SupportDynamics support;
};

/// Columns: force and moment about the sole's centre of the edges of the pyramids at its corners,
/// in W.
MatX corner_edges(const TaskInput& input, Leg leg, double mu, double share) {
  const Mat3& R = input.dynamics.shank[index(leg)].R;
  MatX edges(6, 16);
  Eigen::Index column = 0;
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) {
      const Vec3 corner(share * x * input.dynamics.sole.x(), share * y * input.dynamics.sole.y(),
                        0.0);
      for (const double a : {-1.0, 1.0}) {
        for (const double b : {-1.0, 1.0}) {
          const Vec3 force(a * mu, b * mu, 1.0);
          edges.col(column++) << R * force, R * corner.cross(force);
        }
      }
    }
  }
  return edges;
}

double violation(const test::WrittenRows& rows, const VecX& x) {
  const VecX value = rows.A * x;
  return std::max((rows.lower - value).maxCoeff(), (value - rows.upper).maxCoeff());
}

constexpr double kShare = 0.9;

TEST(FlatFeetCone, holds_all_that_forces_at_the_corners_of_the_soles_can_do) {
  Standing standing(1);
  const auto cone = standing.prepared(FrictionCone({.sole = kShare}));
  for (int trial = 0; trial < 50; ++trial) {
    const TaskInput input = standing.update();
    const double mu = cone.pyramid(input.plan, Leg{0}).mu;
    VecX wrenches(12);
    for (const Leg leg : input.plan.feet.legs()) {
      VecX weights(16);
      for (double& weight : weights) weight = std::max(0.0, standing.random.uniform(-60.0, 60.0));
      wrenches.segment<6>(6 * static_cast<int>(leg)) =
          corner_edges(input, leg, mu, kShare) * weights;
    }
    EXPECT_LT(violation(test::written(cone, input), standing.x_with(wrenches)), 1e-6);
  }
}

TEST(FlatFeetCone, holds_nothing_else) {
  Standing standing(2);
  const auto cone = standing.prepared(FrictionCone({.sole = kShare}));
  int inside = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const TaskInput input = standing.update();
    const double mu = cone.pyramid(input.plan, Leg{0}).mu;
    VecX wrenches(12);
    const MatX edges = corner_edges(input, Leg{0}, mu, kShare);
    // Near the cone's surface: few edges, and a little off.
    for (int leg = 0; leg < 2; ++leg) {
      VecX weights(16);
      for (double& weight : weights) weight = std::max(0.0, standing.random.uniform(-60.0, 30.0));
      wrenches.segment<6>(6 * leg) =
          corner_edges(input, static_cast<Leg>(leg), mu, kShare) * weights;
    }
    for (int i = 0; i < 3; ++i) wrenches[i] += standing.random.uniform(-2.0, 2.0);
    for (int i = 3; i < 6; ++i) wrenches[i] += standing.random.uniform(-0.1, 0.1);
    const VecX target = wrenches.head<6>();
    const VecX weights = solver::non_negative_least_squares<double>(edges, target);
    const double off = (edges * weights - target).norm();
    const double broken = violation(test::written(cone, input), standing.x_with(wrenches));
    inside += off < 1e-6 ? 1 : 0;
    const bool is_outside = off > 1e-3, is_inside = off < 1e-9;  // else too near to tell
    EXPECT_TRUE(!is_outside || broken > 1e-6) << trial << ": broken by " << broken;
    EXPECT_TRUE(!is_inside || broken < 1e-6) << trial << ": broken by " << broken;
  }
  EXPECT_GT(inside, 20);
  EXPECT_LT(inside, 380);
}

TEST(FlatFeetCone, names_its_rows_by_foot) {
  const auto cone = Standing(3).prepared(FrictionCone({}));
  EXPECT_EQ(cone.num_ids(), 34);
  EXPECT_EQ(cone.row_name(4), "L normal force");
  EXPECT_EQ(cone.row_name(5), "L tips left");
  EXPECT_EQ(cone.row_name(17), "R slip forward");
  EXPECT_EQ(cone.row_name(33), "R turns right 4");
}

TEST(FlatFeetContact, neither_moves_nor_turns) {
  Standing standing(4);
  const auto task = standing.prepared(NoContactMotion({}));
  const TaskInput input = standing.update();
  const test::WrittenRows rows = test::written(task, input);
  ASSERT_EQ(rows.count(), 12);
  EXPECT_EQ(task.row_name(9), "R about x");
  for (const Leg leg : input.plan.feet.legs()) {
    const auto first = 6 * static_cast<Eigen::Index>(leg);
    const Eigen::Index n = input.dynamics.num_velocities();
    EXPECT_EQ(rows.A.middleRows(first, 3).leftCols(n), input.dynamics.contact[index(leg)].J);
    EXPECT_EQ(rows.A.middleRows(first + 3, 3).leftCols(n), input.dynamics.shank[index(leg)].J);
    const Vec3 turn =
        -input.dynamics.shank[index(leg)].Jdot_u - 10.0 * input.dynamics.shank[index(leg)].w;
    EXPECT_LT((rows.lower.segment<3>(first + 3) - turn).norm(), 1e-12);
  }
}

TEST(FlatFeetCom, is_moved_in_both_directions) {
  Standing standing(5);
  const auto task = standing.prepared(ComXy({}));
  EXPECT_EQ(test::written(task, standing.update()).count(), 2);
  standing.plan.feet[0].phase = LegPhase::swing;
  EXPECT_EQ(test::written(task, standing.update()).count(), 2);
}

}  // namespace
}  // namespace surefoot::tasks
