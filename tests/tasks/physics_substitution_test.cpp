#include "surefoot/tasks/physics_substitution.hpp"

#include "surefoot/config/stack_file.hpp"
#include "surefoot/control/task_stack.hpp"
#include "surefoot/solver/cascade_solver.hpp"
#include "surefoot/tasks/equations_of_motion.hpp"
#include "surefoot/tasks/no_contact_motion.hpp"
#include "tests/support/linear_algebra.hpp"
#include "tests/support/sizes.hpp"
#include "tests/tasks/scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace surefoot::tasks {
namespace {

using test::all_contact_sets;
using test::condition;
using test::plan_with_contacts;
using test::Random;
using test::Scene;
using test::stacked;
using test::straight_legged_state;
using test::written;
using test::WrittenRows;

constexpr int kNumFree = 12;
const EquationsOfMotion kEquationsOfMotion;
const NoContactMotion kNoContactMotion({.kd = 10.0});

/// A stale result of the last tick must not show through.
class Example {
 public:
  const solver::Substitution* update(const RobotState& state) {
    const TaskInput input = scene.update(state);
    rows = stacked({&kEquationsOfMotion, &kNoContactMotion}, input);
    const VecX contact = written(kNoContactMotion, input).lower;
    return substitution.update(input.dynamics, input.support, contact);
  }

  Scene scene;
  WrittenRows rows;
  PhysicsSubstitution substitution{kNumLegJoints};
};

/// Length of every row and of its part on the right, to compare residuals with.
VecX sizes(const WrittenRows& rows, const VecX& x) {
  return (rows.A.rowwise().norm() * x.norm()).array() + rows.lower.array().abs();
}

void expect_solves(const WrittenRows& rows, const solver::Substitution& s) {
  const VecX residual = rows.A * s.offset - rows.lower;
  EXPECT_LT(residual.cwiseQuotient(sizes(rows, s.offset)).cwiseAbs().maxCoeff(), 1e-12);
  for (Eigen::Index i = 0; i < s.basis.cols(); ++i) {
    const VecX direction = s.basis.col(i);
    const VecX change = (rows.A * direction).cwiseQuotient(rows.A.rowwise().norm());
    EXPECT_LT(change.cwiseAbs().maxCoeff(), 1e-12 * direction.norm()) << i;
  }
}

TEST(PhysicsSubstitution, HasAllSolutionsOfBothLevelsAndNoOthers) {
  Example example;
  Random random(50);
  const JointVector posture = example.scene.model.description().q_nominal;
  double worst = 1.0;
  for (const PerLeg<bool>& contacts : all_contact_sets()) {
    example.scene.plan = plan_with_contacts(contacts);
    for (int trial = 0; trial < 100; ++trial) {
      const bool anywhere = trial % 2 == 0;
      const solver::Substitution* s =
          example.update(anywhere ? random.state() : random.standing_state(posture));
      ASSERT_NE(s, nullptr);
      ASSERT_EQ(s->num_levels, 2u);
      ASSERT_EQ(s->basis.cols(), kNumFree);
      ASSERT_EQ(example.rows.count(), kNumUnknowns - kNumFree);
      expect_solves(example.rows, *s);
      worst = std::max(worst, condition(s->basis));
    }
  }
  EXPECT_LT(worst, 200.0) << "columns of like size, far from dependent";
}

/// From bent knees to a leg as straight as the rank's tolerance lets count.
TEST(PhysicsSubstitution, KeepsItsColumnsWhereContactsAreNearlySingular) {
  model::RobotDescription robot = test::anymal_b();
  for (model::LegDescription& leg : robot.legs) leg.foot_radius = 0.0;
  Example example;
  example.scene.model = model::RobotModel(robot);
  int solved = 0, refused = 0;
  for (double angle = 0.3; angle > 1e-9; angle *= 0.5) {
    RobotState state = straight_legged_state();
    for (const Leg leg : kLegs) state.q[first_joint(leg) + 2] += is_front(leg) ? -angle : angle;
    state.qd.setConstant(0.1);
    const solver::Substitution* s = example.update(state);
    const bool is_full = example.scene.support.rank() == 12;
    ASSERT_EQ(s != nullptr, is_full) << angle;
    ++(is_full ? solved : refused);
    if (!is_full) continue;
    expect_solves(example.rows, *s);
    EXPECT_LT(condition(s->basis), 200.0) << angle;
  }
  EXPECT_GT(solved, 10);
  EXPECT_GT(refused, 3);
}

TEST(PhysicsSubstitution, RefusesAccelerationsOfOtherContacts) {
  Example example;
  const TaskInput input =
      example.scene.update(Random(51).standing_state(example.scene.model.description().q_nominal));
  EXPECT_EQ(example.substitution.update(input.dynamics, input.support, VecX::Zero(9)), nullptr);
}

TEST(PhysicsSubstitution, RefusesWhatIsNotANumber) {
  Example example;
  const TaskInput input =
      example.scene.update(Random(52).standing_state(example.scene.model.description().q_nominal));
  model::Dynamics unknown = input.dynamics;
  unknown.h.setConstant(kNaN);
  EXPECT_EQ(example.substitution.update(unknown, input.support, VecX::Zero(12)), nullptr);
}

/// A plan that the robot's limits allow: it goes on as it moves, over the middle of its feet.
void follow(Random& random, const model::Dynamics& now, MotionPlan& plan) {
  test::randomise_references(random, now, plan);
  plan.com.v = now.com.v.head<2>() + random.vector(0.02).head<2>();
  plan.R_WC = random.small_rotation(0.1).toRotationMatrix();
  Vec3 middle = Vec3::Zero();
  for (const Leg leg : kLegs) {
    if (plan.contact(leg)) middle += now.foot[index(leg)].p / plan.num_contacts();
  }
  const Vec3 lever = now.com.p - middle;
  plan.com.a = kGravity / lever.z() * lever.head<2>() + random.vector(0.1).head<2>();
  plan.com.p = now.com.p.head<2>();
  plan.torso.w_WB = now.base_rotation.w + random.vector(0.05);
  plan.torso.height_rate = now.base.v.z() + random.uniform(-0.02, 0.02);
  for (const Leg leg : kLegs) {
    plan.feet[index(leg)].v_WF = now.foot[index(leg)].v + random.vector(0.1);
  }
}

/// The levels that are left, over y.
solver::Hierarchy reduced(const solver::Hierarchy& full, const solver::Substitution& s) {
  solver::Hierarchy result(s.basis.cols());
  for (std::size_t k = s.num_levels; k < full.num_levels(); ++k) {
    const solver::Level& level = full.level(k);
    solver::Level& left = result.level(result.add_level(level.name(), level.num_rows()));
    solver::Rows rows = left.add(level.num_rows(), 0);
    rows.A = level.A() * s.basis;
    rows.lower = level.lower() - level.A() * s.offset;
    rows.upper = level.upper() - level.A() * s.offset;
    for (Eigen::Index i = 0; i < level.num_rows(); ++i) {
      if (level.lower()[i] == level.upper()[i]) rows.set_equal(i, rows.lower[i]);
    }
  }
  return result;
}

VecX solved_through(const solver::Hierarchy& full, const solver::Substitution& s) {
  const solver::Hierarchy hierarchy = reduced(full, s);
  solver::CascadeSolver solver(hierarchy);
  return s.offset + s.basis * solver.solve(hierarchy).x;
}

TEST(PhysicsSubstitution, LeavesTheAnswerOfTheHierarchyAsItIs) {
  Scene scene;
  Random random(54);
  control::TaskStack stack(config::load_stack("terrain_adaptation"), scene.model.description());
  solver::CascadeSolver solver(stack.hierarchy());
  const JointVector posture = scene.model.description().q_nominal;
  int num_active = 0;
  for (const PerLeg<bool>& contacts : all_contact_sets()) {
    scene.plan = plan_with_contacts(contacts);
    if (scene.plan.num_contacts() < 2) continue;
    for (int trial = 0; trial < 60; ++trial) {
      RobotState state = random.standing_state(posture);
      state.qd *= 0.2;
      follow(random, scene.update(state).dynamics, scene.plan);
      const model::Dynamics& dynamics = scene.update(state).dynamics;
      const solver::Hierarchy& hierarchy = stack.update(dynamics, scene.plan);
      const solver::Substitution* s = stack.substitution(dynamics);
      ASSERT_NE(s, nullptr);
      const solver::Solution& solution = solver.solve(hierarchy);
      ASSERT_EQ(solution.status, solver::SolveStatus::optimal);
      const VecX x = solved_through(hierarchy, *s);
      EXPECT_LT((x - solution.x).norm(), 1e-9 * solution.x.norm()) << trial;
      for (const solver::LevelResult& level : solution.levels) num_active += level.num_active();
    }
  }
  EXPECT_GT(num_active, 1000) << "limits took part";
}

TEST(TaskStack, HasNoSubstitutionUnlessItBeginsWithTheTwoTasks) {
  Scene scene;
  const control::StackOptions options = config::load_stack("terrain_adaptation");
  const RobotState state = Random(55).standing_state(scene.model.description().q_nominal);
  const auto has_substitution = [&](const control::StackOptions& changed) {
    control::TaskStack stack(changed, scene.model.description());
    const model::Dynamics& dynamics = scene.update(state).dynamics;
    (void)stack.update(dynamics, scene.plan);
    return stack.substitution(dynamics) != nullptr;
  };
  EXPECT_TRUE(has_substitution(options));
  control::StackOptions exchanged = options;
  std::swap(exchanged.levels[0], exchanged.levels[1]);
  EXPECT_FALSE(has_substitution(exchanged));
  control::StackOptions shared = options;
  shared.levels[1].tasks.push_back(options.levels[2].tasks.front());
  EXPECT_FALSE(has_substitution(shared));
  control::StackOptions other = options;
  other.levels.erase(other.levels.begin());
  EXPECT_FALSE(has_substitution(other));
}

}  // namespace
}  // namespace surefoot::tasks
