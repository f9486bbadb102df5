#include "surefoot/control/task_stack.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/config/stack_file.hpp"
#include "surefoot/model/robot_model.hpp"
#include "surefoot/signals/hierarchy_report.hpp"
#include "surefoot/tasks/catalog.hpp"
#include "tests/support/anymal_b.hpp"
#include "tests/support/malloc_counter.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/random_motion.hpp"
#include "tests/support/sizes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>
#include <tuple>
#include <utility>

namespace surefoot::control {
namespace {

using test::anymal_b;
using test::holds;
using test::Random;

LevelSpec level(const std::string& task) { return {task, {{task, {}, {}}}}; }

StackOptions stack_of(const std::vector<LevelSpec>& levels) { return {"test", levels}; }

std::string error_of(const StackOptions& options) {
  return test::message_of([&] { const TaskStack stack(options, anymal_b()); });
}

void expect_mentions(const std::string& text, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) {
    EXPECT_TRUE(holds(text, part));
  }
}

const std::vector<std::string> kStacks{"walk",    "terrain_adaptation",     "manipulability",
                                       "regular", "terrain_without_limits", "torso_in_bounds"};

TEST(TaskStack, HasOneLevelForEachOfTheFileInItsOrder) {
  for (const std::string& name : kStacks) {
    const StackOptions options = config::load_stack(name);
    const TaskStack stack(options, anymal_b());
    ASSERT_EQ(stack.hierarchy().num_levels(), options.levels.size()) << name;
    EXPECT_EQ(stack.hierarchy().unknowns(), kNumUnknowns);
    for (std::size_t i = 0; i < options.levels.size(); ++i) {
      EXPECT_EQ(stack.hierarchy().level(i).name(), options.levels[i].name);
    }
  }
}

TEST(TaskStack, TheFirstFreeLevelComesAfterAllThatKeepThePhysics) {
  for (const std::string& name : kStacks) {
    EXPECT_EQ(TaskStack(config::load_stack(name), anymal_b()).first_free_level(), 4) << name;
  }
  const auto first_free = [](const std::vector<LevelSpec>& levels) {
    return TaskStack(stack_of(levels), anymal_b()).first_free_level();
  };
  EXPECT_EQ(first_free({level("com_xy")}), 0);
  EXPECT_EQ(first_free({level("equations_of_motion"), level("com_xy")}), 1);
  EXPECT_EQ(first_free({level("equations_of_motion"), level("com_xy"), level("torque_limits"),
                        level("torso_yaw")}),
            3);
}

TEST(TaskStack, TellsWhatASolutionLacksOfTheTorsosTilt) {
  const auto shortfall =
      [](const StackOptions& options, double residual,
         std::pair<solver::SolveStatus, int> ended = {solver::SolveStatus::optimal, -1}) {
        solver::Solution solution;
        std::tie(solution.status, solution.failed_level) = ended;
        solution.levels.resize(options.levels.size());
        solution.levels.back().residual = residual;
        return TaskStack(options, anymal_b()).tilt_shortfall(solution);
      };
  const StackOptions stack = stack_of({level("com_xy"), level("torso_roll_pitch")});
  EXPECT_EQ(shortfall(stack, 2.5), 2.5);
  EXPECT_EQ(shortfall(stack, 2.5, {solver::SolveStatus::iteration_cap, 2}), 2.5)
      << "all are optimal";
  for (const auto& ended : {std::pair(solver::SolveStatus::iteration_cap, 0),
                            std::pair(solver::SolveStatus::iteration_cap, 1),
                            std::pair(solver::SolveStatus::invalid_input, -1)})
    EXPECT_TRUE(std::isnan(shortfall(stack, 2.5, ended))) << ended.second;
  const LevelSpec both{"both", {{"torso_roll_pitch", {}, {}}, {"torso_height", {}, {}}}};
  EXPECT_EQ(shortfall(stack_of({level("com_xy"), both}), 2.5), 0.0) << "of both together";
  EXPECT_EQ(shortfall(stack_of({level("com_xy")}), 2.5), 0.0);
}

TEST(TaskStack, TellsTheNormalsOfItsFrictionPyramids) {
  MotionPlan plan = test::plan_with_contacts({true, true, true, true});
  plan.R_WC = Eigen::AngleAxisd(0.1, Vec3::UnitX()).toRotationMatrix();
  const auto normal = [&](const std::vector<LevelSpec>& levels) -> Vec3 {
    return TaskStack(stack_of(levels), anymal_b()).pyramid_normals(plan)[index(Leg::RH)];
  };
  const auto cone = [](const std::string& axes) {
    return LevelSpec{"cone", {{"friction_cone", {}, {{"axes", axes}}}}};
  };
  EXPECT_LT((normal({level("com_xy"), cone("gravity")}) - Vec3::UnitZ()).norm(), 1e-12);
  EXPECT_LT((normal({cone("control"), level("com_xy")}) - plan.R_WC.col(2)).norm(), 1e-12);
  EXPECT_TRUE(normal({level("com_xy")}).array().isNaN().all());
}

TEST(TaskStack, WritesTheRowsOfAllTasksWithinItsCapacityEachWithItsOwnIdAndAName) {
  model::RobotModel model(anymal_b());
  Random random(1);
  for (const std::string& name : kStacks) {
    TaskStack stack(config::load_stack(name), anymal_b());
    for (const PerLeg<bool>& contacts : test::all_contact_sets()) {
      const RobotState state = random.standing_state(model.description().q_nominal);
      const MotionPlan plan = test::plan_with_contacts(contacts);
      const model::Dynamics& dynamics = model.update(state, Vec3::UnitZ());
      const test::MallocCounter counter;
      const solver::Hierarchy& hierarchy = stack.update(dynamics, plan);
      EXPECT_EQ(counter.count(), 0u) << name;
      for (std::size_t i = 0; i < hierarchy.num_levels(); ++i) {
        const solver::Level& rows = hierarchy.level(i);
        ASSERT_LE(rows.num_rows(), rows.max_rows());
        ASSERT_TRUE(rows.A().allFinite()) << rows.name();
        ASSERT_TRUE((rows.lower().array() <= rows.upper().array()).all()) << rows.name();
        std::set<int> ids;
        for (Eigen::Index row = 0; row < rows.num_rows(); ++row) {
          const std::string of_row = stack.row_name(static_cast<int>(i), rows.id(row));
          EXPECT_TRUE(ids.insert(rows.id(row)).second) << rows.name() << " has twice " << of_row;
          EXPECT_TRUE(of_row != "?" && !of_row.empty()) << rows.name();
        }
      }
      EXPECT_EQ(hierarchy.level(0).num_rows(),
                kNumVelocities - stack.support().rank());  // equations of motion without λ
      EXPECT_EQ(stack.support().num_contacts(), plan.num_contacts());
    }
  }
}

TEST(TaskStack, EveryUpdateBeginsAnew) {
  model::RobotModel model(anymal_b());
  Random random(2);
  const RobotState state = random.standing_state(model.description().q_nominal);
  const model::Dynamics& dynamics = model.update(state, Vec3::UnitZ());
  const MotionPlan four = test::plan_with_contacts({true, true, true, true});
  const MotionPlan three = test::plan_with_contacts({true, false, true, true});
  TaskStack used(config::load_stack("terrain_adaptation"), anymal_b());
  TaskStack fresh(config::load_stack("terrain_adaptation"), anymal_b());
  (void)used.update(dynamics, four);
  const solver::Hierarchy& again = used.update(dynamics, three);
  const solver::Hierarchy& once = fresh.update(dynamics, three);
  for (std::size_t i = 0; i < once.num_levels(); ++i) {
    ASSERT_EQ(again.level(i).num_rows(), once.level(i).num_rows());
    EXPECT_EQ(again.level(i).A(), once.level(i).A());
    EXPECT_EQ(again.level(i).lower(), once.level(i).lower());
    EXPECT_EQ(again.level(i).upper(), once.level(i).upper());
  }
}

TEST(TaskStack, TasksThatShareALevelKeepTheirRowsApart) {
  const LevelSpec shared{"both", {{"torque_limits", {}, {}}, {"torque_minimisation", {}, {}}}};
  TaskStack stack(stack_of({shared}), anymal_b());
  model::RobotModel model(anymal_b());
  Random random(4);
  const RobotState state = random.standing_state(model.description().q_nominal);
  const solver::Hierarchy& hierarchy = stack.update(
      model.update(state, Vec3::UnitZ()), test::plan_with_contacts({true, true, true, true}));
  const solver::Level& both = hierarchy.level(0);
  ASSERT_EQ(both.num_rows(), 2 * kNumLegJoints);
  EXPECT_LT(both.lower()[0], both.upper()[0]);
  EXPECT_EQ(both.lower()[kNumLegJoints], both.upper()[kNumLegJoints]);
  EXPECT_NE(both.id(0), both.id(kNumLegJoints));
  const auto limits = tasks::make_task("torque_limits");
  const auto minimisation = tasks::make_task("torque_minimisation");
  EXPECT_EQ(stack.row_name(0, both.id(0)), limits->row_name(0));
  EXPECT_EQ(stack.row_name(0, both.id(kNumLegJoints)), minimisation->row_name(0));
}

TEST(TaskStack, ARowThatThereIsNotHasNoName) {
  const TaskStack stack(config::load_stack("walk"), anymal_b());
  EXPECT_EQ(stack.row_name(-1, 0), "?");
  EXPECT_EQ(stack.row_name(99, 0), "?");
  EXPECT_EQ(stack.row_name(0, -1), "?");
  EXPECT_EQ(stack.row_name(0, 100000), "?");
}

TEST(TaskStack, ParametersReachTheTask) {
  const auto com_rows = [](double kp) {
    const LevelSpec com{"com", {{"com_xy", {{"kp", kp}, {"kd", 0.0}}, {}}}};
    TaskStack stack(stack_of({com}), anymal_b());
    model::RobotModel model(anymal_b());
    RobotState state = test::straight_legged_state();
    MotionPlan plan = test::plan_with_contacts({true, true, true, true});
    const model::Dynamics& dynamics = model.update(state, Vec3::UnitZ());
    plan.com.p = dynamics.com.p.head<2>() + Vec2(0.01, 0.0);
    return Vec2(stack.update(dynamics, plan).level(0).lower().head<2>());
  };
  EXPECT_NEAR(com_rows(300.0).x() - com_rows(100.0).x(), 2.0, 1e-9);
}

TEST(TaskStack, AnUnknownTaskIsAnErrorThatListsWhatThereIs) {
  expect_mentions(error_of(stack_of({level("com_xz")})), {"com_xz", "com_xy", "swing_foot"});
}

TEST(TaskStack, AnUnknownOrImpossibleParameterIsAnErrorThatSaysWhatIsValid) {
  const LevelSpec misspelt{"com", {{"com_xy", {{"kq", 3.0}}, {}}}};
  expect_mentions(error_of(stack_of({misspelt})), {"com_xy", "kq", "kp", "kd"});
  const LevelSpec negative{"com", {{"com_xy", {{"kp", -3.0}}, {}}}};
  expect_mentions(error_of(stack_of({negative})), {"com_xy", "kp", "-3"});
  const LevelSpec not_a_number{"com", {{"com_xy", {{"kp", kNaN}}, {}}}};
  expect_mentions(error_of(stack_of({not_a_number})), {"com_xy", "kp", "nan"});
  const LevelSpec wrong_word{"friction", {{"friction_cone", {}, {{"pyramid", "round"}}}}};
  expect_mentions(error_of(stack_of({wrong_word})), {"round", "inner", "outer"});
}

TEST(TaskStack, AWeightOrADampingThatIsNoneIsAnErrorBeforeItCountsInATick) {
  for (const double number : {-1.0, kNaN, HUGE_VAL}) {
    const LevelSpec weighted{"com", {{"com_xy", {}, {}, number}}};
    expect_mentions(error_of(stack_of({weighted})), {"com_xy", "expected a finite number > 0"});
    LevelSpec damped = level("com_xy");
    damped.damping = number;
    expect_mentions(error_of(stack_of({damped})), {"com_xy", "expected a finite number > 0"});
  }
}

TEST(TaskStack, AStackWithoutLevelsOrWithTooManyIsAnError) {
  expect_mentions(error_of(stack_of({})), {"test", "0 levels", "1 to 16"});
  expect_mentions(error_of(stack_of(std::vector<LevelSpec>(kMaxLevels + 1, level("com_xy")))),
                  {"test", "17 levels", "1 to 16"});
  EXPECT_NO_THROW(
      TaskStack(stack_of(std::vector<LevelSpec>(kMaxLevels, level("com_xy"))), anymal_b()));
}

TEST(TaskStack, WeightsAreOnTheRowsOfTheirTaskAndDampingFollowsThem) {
  model::RobotModel model(anymal_b());
  Random random(2);
  const RobotState state = random.standing_state(model.description().q_nominal);
  const MotionPlan plan = test::plan_with_contacts({true, true, true, true});
  const model::Dynamics& dynamics = model.update(state, Vec3::UnitZ());
  StackOptions options = stack_of({{"both", {{"com_xy", {}, {}}, {"torso_yaw", {}, {}}}}});
  TaskStack plain(options, anymal_b());
  options.levels[0].tasks[1].weight = 3.0;
  options.levels[0].damping = 0.1;
  TaskStack weighted(options, anymal_b());
  const solver::Level& before = plain.update(dynamics, plan).level(0);
  const solver::Level& after = weighted.update(dynamics, plan).level(0);
  ASSERT_EQ(before.num_rows(), 3);
  ASSERT_EQ(after.num_rows(), 6);
  EXPECT_EQ(after.A().topRows(2), before.A().topRows(2));
  EXPECT_EQ(after.A().row(2), 3.0 * before.A().row(2));
  EXPECT_EQ(after.upper()[2], 3.0 * before.upper()[2]);
  EXPECT_NEAR(after.A().row(5).norm(), 0.1, 1e-12);
  EXPECT_EQ(weighted.row_name(0, after.id(5)), "damping");
  EXPECT_EQ(weighted.row_name(0, after.id(2)), plain.row_name(0, before.id(2)));
}

TEST(TaskStack, ALevelHasTheUnitsOfItsRowsUnlessTheyHaveWeights) {
  const TaskSpec com{"com_xy", {}, {}}, height{"torso_height", {}, {}}, yaw{"torso_yaw", {}, {}};
  TaskSpec heavy = height;
  heavy.weight = 2.0;
  StackOptions options = stack_of(
      {{"one", {yaw}}, {"same", {com, height}}, {"two", {com, yaw}}, {"weighted", {heavy}}});
  options.levels.push_back({.name = "damped", .tasks = {yaw}, .damping = 0.1});
  EXPECT_EQ(TaskStack(options, anymal_b()).units(),
            (std::vector<std::string>{"rad/s²", "m/s²", "m/s² and rad/s²", "", ""}));
}

TEST(TaskStack, AWeightedStackHasTheSameRowsInFewerLevels) {
  model::RobotModel model(anymal_b());
  Random random(3);
  const RobotState state = random.standing_state(model.description().q_nominal);
  const MotionPlan plan = test::plan_with_contacts({true, false, true, true});
  const model::Dynamics& dynamics = model.update(state, Vec3::UnitZ());
  TaskStack strict(config::load_stack("terrain_adaptation"), anymal_b());
  TaskStack weighted(weighted_from(config::load_stack("terrain_adaptation"), 4), anymal_b());
  const solver::Hierarchy& levels = strict.update(dynamics, plan);
  const solver::Level& last = weighted.update(dynamics, plan).level(4);
  EXPECT_EQ(weighted.first_free_level(), 4);
  Eigen::Index row = 0;
  for (std::size_t k = 4; k < levels.num_levels(); ++k) {
    const Eigen::Index rows = levels.level(k).num_rows();
    EXPECT_EQ(last.A().middleRows(row, rows), levels.level(k).A());
    row += rows;
  }
  EXPECT_EQ(last.num_rows(), row);
}

}  // namespace
}  // namespace surefoot::control
