#include "tests/support/random_motion.hpp"

#include "surefoot/math/rotation.hpp"

#include <cmath>

namespace surefoot::test {

double Random::uniform(double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(engine_);
}

Vec3 Random::vector(double bound) {
  const double x = uniform(-bound, bound);
  const double y = uniform(-bound, bound);
  return {x, y, uniform(-bound, bound)};
}

Quat Random::rotation() {
  std::normal_distribution<double> normal;
  const double w = normal(engine_);
  const double x = normal(engine_);
  const double y = normal(engine_);
  return Quat(w, x, y, normal(engine_)).normalized();
}

Quat Random::small_rotation(double bound) { return exp_rotation(vector(bound)); }

RobotState Random::state() {
  RobotState state;
  state.time = 0.0;
  state.p_WB = vector(2.0);
  state.q_WB = rotation();
  state.v_WB = vector(1.0);
  state.w_WB_B = vector(2.0);
  for (int j = 0; j < kNumLegJoints; ++j) {
    state.q[j] = uniform(-2.0, 2.0);
    state.qd[j] = uniform(-3.0, 3.0);
  }
  return state;
}

RobotState Random::state_around(const JointVector& posture) {
  RobotState state = this->state();
  state.q = posture;
  for (double& angle : state.q) angle += uniform(-0.3, 0.3);
  state.qd.resize(state.q.size());
  for (double& rate : state.qd) rate = uniform(-2.0, 2.0);
  return state;
}

RobotState Random::standing_state(const JointVector& posture) {
  RobotState state = this->state();
  state.p_WB = Vec3(0.0, 0.0, 0.48) + vector(0.03);
  state.q_WB = small_rotation(0.15);
  state.v_WB *= 0.2;
  state.w_WB_B *= 0.2;
  for (int j = 0; j < kNumLegJoints; ++j) state.q[j] = posture[j] + uniform(-0.2, 0.2);
  state.qd *= 0.2;
  return state;
}

RobotState moved(const RobotState& state, const GeneralizedVector& u, double time) {
  RobotState result = state;
  result.p_WB += time * u.head<3>();
  result.q_WB = state.q_WB * exp_rotation(time * u.segment<3>(3));
  result.q += time * u.tail(state.q.size());
  return result;
}

RobotState straight_legged_state() {
  const double knee = std::atan2(0.1, 0.298);  // puts the foot's centre in line with the thigh
  const double length = 0.25 + std::hypot(0.1, 0.298);
  const double abduction = std::atan2(0.13, length);
  RobotState state;
  state.time = 0.0;
  state.p_WB = Vec3(0.0, 0.0, length);
  state.q_WB = Quat::Identity();
  state.v_WB.setZero();
  state.w_WB_B.setZero();
  state.qd.setZero();
  for (const Leg leg : kLegs) {
    state.q.segment<3>(first_joint(leg)) << (is_left(leg) ? -abduction : abduction), 0.0,
        (is_front(leg) ? knee : -knee);
  }
  return state;
}

MotionPlan plan_with_contacts(const PerLeg<bool>& contacts) {
  MotionPlan plan;
  for (const Leg leg : kLegs) {
    FootPlan& foot = plan.feet[index(leg)];
    foot.phase = contacts[index(leg)] ? LegPhase::stance : LegPhase::swing;
    foot.force_min = 10.0;
    foot.force_max = 250.0;
  }
  return plan;
}

std::array<PerLeg<bool>, 16> all_contact_sets() {
  std::array<PerLeg<bool>, 16> sets{};
  for (unsigned bits = 0; bits < 16; ++bits) {
    for (unsigned leg = 0; leg < kNumLegs; ++leg) sets[bits][leg] = ((bits >> leg) & 1u) != 0u;
  }
  return sets;
}

}  // namespace surefoot::test
