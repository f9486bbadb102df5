#pragma once

#include "surefoot/model/robot_model.hpp"
#include "surefoot/tasks/catalog.hpp"
#include "tests/support/anymal_b.hpp"
#include "tests/support/random_motion.hpp"

#include <functional>

namespace surefoot::test {

/// A robot, a plan and the input that the tasks see, kept together.
class Scene {
 public:
  Scene() : model(anymal_b()) {}

  /// Everything that a tick computes before the tasks.
  tasks::TaskInput update(const RobotState& state) {
    const model::Dynamics& dynamics = model.update(state, plan.R_WC.col(2));
    support.update(dynamics, plan);
    return {dynamics, plan, support, model.description()};
  }

  model::RobotModel model;
  MotionPlan plan = plan_with_contacts({true, true, true, true});
  model::SupportDynamics support;
};

/// A copy of the rows that a task writes.
struct WrittenRows {
  MatX A;
  VecX lower;
  VecX upper;
  std::vector<int> ids;

  [[nodiscard]] Eigen::Index count() const { return A.rows(); }
};

/// The level is filled with wrong values first, so that nothing is right by accident.
WrittenRows written(const tasks::Task& task, const tasks::TaskInput& input);
/// The rows of several tasks below each other.
WrittenRows stacked(const std::vector<const tasks::Task*>& tasks, const tasks::TaskInput& input);

/// State and acceleration u̇ of a motion with constant u̇.
struct Motion {
  RobotState state;
  GeneralizedVector acceleration;

  /// Where the motion is after a time, to second order.
  [[nodiscard]] RobotState at(double time) const;
};

[[nodiscard]] Motion random_motion(Random& random, const JointVector& posture);

/// Value, rate and second derivative of a coordinate r(state) along a motion, by differences.
struct Rates {
  double r = 0.0;
  double rdot = 0.0;
  double rddot = 0.0;
};
[[nodiscard]] Rates rates(Scene& scene, const Motion& motion,
                          const std::function<double(const model::Dynamics&)>& coordinate);

/// A plan with random references everywhere, and a control frame that is turned and tilted.
void randomise_references(Random& random, const model::Dynamics& around, MotionPlan& plan);

}  // namespace surefoot::test
