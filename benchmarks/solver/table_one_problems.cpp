// Table I as the controller writes it, at random states of ANYmal B.

#include "benchmarks/solver/problems.hpp"
#include "surefoot/config/stack_file.hpp"
#include "surefoot/control/task_stack.hpp"
#include "tests/tasks/scene.hpp"

#include <algorithm>

namespace surefoot::benchmarks {
namespace {

using test::Random;

/// What a family draws; all bounds of uniform draws.
struct Draws {
  double posture;                 // joints around the stance [rad]
  double acceleration, turning;   // of the references [m/s²], [rad/s²]
  double torque_min, torque_max;  // limit of the motors [N·m]
  double friction_min, friction_max;
  double force_min;   // largest lower bound of a stance foot's force [N]
  double force_max;   // smallest upper bound [N]
  double limb_slack;  // room of the limb limits around where the limbs are [m]
};

Draws draws_of(Difficulty difficulty) {
  switch (difficulty) {
    case Difficulty::aggressive:
      return {0.3, 8.0, 20.0, 25.0, 45.0, 0.3, 0.6, 20.0, 250.0, 0.01};
    case Difficulty::infeasible:
      return {0.3, 8.0, 20.0, 5.0, 18.0, 0.3, 0.6, 80.0, 60.0, 0.005};
    case Difficulty::degenerate:
      return {0.0, 1.0, 2.0, 40.0, 40.0, 0.5, 0.7, 10.0, 250.0, 0.05};
    case Difficulty::nominal:
      break;
  }
  return {0.15, 0.5, 1.0, 40.0, 40.0, 0.6, 0.8, 10.0, 250.0, 0.05};
}

/// 2, 3 or 4 feet in 20, 45 and 35 of 100 cases.
PerLeg<bool> draw_contacts(Random& random) {
  const double draw = random.uniform(0.0, 1.0);
  PerLeg<bool> contacts{true, true, true, true};
  const auto first = static_cast<unsigned>(random.uniform(0.0, 3.999));
  if (draw < 0.65) contacts[first] = false;
  if (draw < 0.2) contacts[3 - first] = false;  // the diagonal one, as in a trot
  return contacts;
}

RobotState draw_state(Random& random, const model::RobotDescription& robot, const Draws& draws,
                      bool straight) {
  RobotState state =
      straight ? test::straight_legged_state() : random.standing_state(robot.q_nominal);
  if (straight) {
    for (double& angle : state.q) angle += random.uniform(-1e-6, 1e-6);
    return state;
  }
  for (int j = 0; j < kNumLegJoints; ++j) {
    state.q[j] = robot.q_nominal[j] + random.uniform(-draws.posture, draws.posture);
  }
  return state;
}

void draw_references(Random& random, const model::Dynamics& dynamics, const Draws& draws,
                     MotionPlan& plan) {
  plan.com.p = dynamics.com.p.head<2>() + random.vector(0.005).head<2>();
  plan.com.v = dynamics.com.v.head<2>();
  plan.com.a = random.vector(draws.acceleration).head<2>();
  plan.torso.q_WB = random.small_rotation(0.01) * Quat(dynamics.base_rotation.R);
  plan.torso.wdot_WB = random.vector(draws.turning);
  plan.torso.height = dynamics.base.p.z() + random.uniform(-0.005, 0.005);
  plan.torso.height_acceleration = random.uniform(-draws.acceleration, draws.acceleration);
  const double friction = random.uniform(draws.friction_min, draws.friction_max);
  for (FootPlan& foot : plan.feet) {
    foot.friction = friction;
    foot.force_min = random.uniform(0.0, draws.force_min);
    foot.force_max = std::max(random.uniform(draws.force_max, 250.0), foot.force_min);
  }
  for (const Leg leg : kLegs) {
    FootPlan& foot = plan.feet[index(leg)];
    foot.p_WF = dynamics.foot[index(leg)].p + random.vector(0.005);
    foot.v_WF = dynamics.foot[index(leg)].v;
    foot.a_WF = random.vector(3.0 * draws.acceleration);
  }
}

/// Limb limits close around where the limbs are, so that they matter.
control::StackOptions stack_for(const model::Dynamics& dynamics, const Draws& draws) {
  control::StackOptions stack = config::load_stack("terrain_adaptation");
  double shortest = 1.0, longest = 0.0;
  for (const Leg leg : kLegs) {
    const double length = (dynamics.foot[index(leg)].p - dynamics.hip[index(leg)].p).norm();
    shortest = std::min(shortest, length);
    longest = std::max(longest, length);
  }
  for (control::LevelSpec& level : stack.levels) {
    for (control::TaskSpec& task : level.tasks) {
      if (task.task != "limb_extension_limits") continue;
      task.numbers["min"] = shortest - draws.limb_slack;
      task.numbers["max"] = longest + draws.limb_slack;
    }
  }
  return stack;
}

void append_copies(const solver::Level& from, double sign, int first_id, solver::Level& to) {
  solver::Rows rows = to.add(from.num_rows(), first_id);
  rows.A = from.A();
  rows.lower = sign > 0.0 ? from.lower() : Eigen::VectorXd(-from.upper());
  rows.upper = sign > 0.0 ? from.upper() : Eigen::VectorXd(-from.lower());
}

/// Contacts and force limits twice, the balance level once more with the opposite wish, and rows of
/// zeros, one of which asks for `impossible`.
solver::Hierarchy degenerated(const solver::Hierarchy& source, double impossible) {
  constexpr int kCopies = 1000;  // first id of the rows added
  solver::Hierarchy result(source.unknowns());
  for (std::size_t k = 0; k < source.num_levels(); ++k) {
    const solver::Level& from = source.level(k);
    const std::size_t added = result.add_level(from.name(), 2 * from.num_rows() + 2);
    append_copies(from, 1.0, 0, result.level(added));
    if (k == 1 || k == 3) append_copies(from, 1.0, kCopies, result.level(added));
    if (k == 5) {
      solver::Rows zeros = result.level(added).add(2, kCopies);
      zeros.set_equal(0, 0.0);
      zeros.set_equal(1, impossible);
    }
    if (k == 4) {
      const std::size_t opposite = result.add_level("opposite of " + from.name(), from.num_rows());
      append_copies(from, -1.0, 0, result.level(opposite));
    }
  }
  return result;
}

}  // namespace

solver::Hierarchy table_one_problem(unsigned seed, Difficulty difficulty) {
  Random random(seed);
  const Draws draws = draws_of(difficulty);
  test::Scene scene;
  scene.plan = test::plan_with_contacts(draw_contacts(random));
  model::RobotDescription robot = scene.model.description();
  robot.torque_limit.setConstant(random.uniform(draws.torque_min, draws.torque_max + 1e-9));
  const RobotState state = draw_state(random, robot, draws, difficulty == Difficulty::degenerate);
  const model::Dynamics& dynamics = scene.model.update(state, scene.plan.R_WC.col(2));
  draw_references(random, dynamics, draws, scene.plan);
  control::TaskStack stack(stack_for(dynamics, draws), robot);
  const solver::Hierarchy hierarchy = normalised(stack.update(dynamics, scene.plan));
  return difficulty == Difficulty::degenerate ? degenerated(hierarchy, seed % 2) : hierarchy;
}

}  // namespace surefoot::benchmarks
