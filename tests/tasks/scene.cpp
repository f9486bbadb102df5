#include "tests/tasks/scene.hpp"

#include "surefoot/math/rotation.hpp"
#include "tests/support/sizes.hpp"

namespace surefoot::test {

namespace {

/// u̇ and τ.
Eigen::Index num_unknowns(const tasks::TaskInput& input) {
  return input.dynamics.num_velocities() + input.dynamics.num_joints();
}

}  // namespace

WrittenRows written(const tasks::Task& task, const tasks::TaskInput& input) {
  solver::Level level("test", task.max_rows(), num_unknowns(input));
  solver::Rows stale = level.add(task.max_rows(), -1);
  stale.A.setConstant(12345.0);
  stale.lower.setConstant(12345.0);
  stale.upper.setConstant(12345.0);
  level.clear();
  task.write(input, level);
  WrittenRows rows{level.A(), level.lower(), level.upper(), {}};
  for (Eigen::Index i = 0; i < level.num_rows(); ++i) rows.ids.push_back(level.id(i));
  return rows;
}

WrittenRows stacked(const std::vector<const tasks::Task*>& tasks, const tasks::TaskInput& input) {
  WrittenRows all{MatX(0, num_unknowns(input)), VecX(0), VecX(0), {}};
  for (const tasks::Task* task : tasks) {
    const WrittenRows rows = written(*task, input);
    const Eigen::Index old = all.count();
    all.A.conservativeResize(old + rows.count(), num_unknowns(input));
    all.lower.conservativeResize(old + rows.count());
    all.upper.conservativeResize(old + rows.count());
    all.A.bottomRows(rows.count()) = rows.A;
    all.lower.tail(rows.count()) = rows.lower;
    all.upper.tail(rows.count()) = rows.upper;
    all.ids.insert(all.ids.end(), rows.ids.begin(), rows.ids.end());
  }
  return all;
}

RobotState Motion::at(double time) const {
  const GeneralizedVector step = state.u() + 0.5 * time * acceleration;
  RobotState result = moved(state, step, time);
  const GeneralizedVector u = state.u() + time * acceleration;
  result.v_WB = u.head<3>();
  result.w_WB_B = u.segment<3>(3);
  result.qd = u.tail<kNumLegJoints>();
  return result;
}

Motion random_motion(Random& random, const JointVector& posture) {
  Motion motion{random.standing_state(posture), GeneralizedVector(kNumVelocities)};
  for (double& value : motion.acceleration) value = random.uniform(-5.0, 5.0);
  return motion;
}

Rates rates(Scene& scene, const Motion& motion,
            const std::function<double(const model::Dynamics&)>& coordinate) {
  constexpr double kStep = 1e-4;
  const Vec3 normal = scene.plan.R_WC.col(2);
  const double before = coordinate(scene.model.update(motion.at(-kStep), normal));
  const double after = coordinate(scene.model.update(motion.at(kStep), normal));
  const double now = coordinate(scene.model.update(motion.state, normal));
  return {now, (after - before) / (2.0 * kStep), (after - 2.0 * now + before) / (kStep * kStep)};
}

void randomise_references(Random& random, const model::Dynamics& around, MotionPlan& plan) {
  plan.R_WC = random.small_rotation(0.3).toRotationMatrix();
  plan.com.p = around.com.p.head<2>() + random.vector(0.01).head<2>();
  plan.com.v = random.vector(0.3).head<2>();
  plan.com.a = random.vector(1.0).head<2>();
  plan.torso.q_WB = random.small_rotation(0.02) * Quat(around.base_rotation.R);
  plan.torso.w_WB = random.vector(0.5);
  plan.torso.wdot_WB = random.vector(1.0);
  plan.torso.height = around.base.p.z() + random.uniform(-0.01, 0.01);
  plan.torso.height_rate = random.uniform(-0.2, 0.2);
  plan.torso.height_acceleration = random.uniform(-1.0, 1.0);
  for (const Leg leg : kLegs) {
    FootPlan& foot = plan.feet[index(leg)];
    foot.p_WF = around.foot[index(leg)].p + random.vector(0.01);
    foot.v_WF = random.vector(0.5);
    foot.a_WF = random.vector(3.0);
  }
}

}  // namespace surefoot::test
