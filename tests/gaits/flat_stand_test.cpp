#include "surefoot/gaits/planner.hpp"
#include "surefoot/model/robot_model.hpp"
#include "tests/support/biped.hpp"

#include <gtest/gtest.h>

namespace surefoot::gaits {
namespace {

TEST(FlatStand, UsesTheFrictionThatIsSetOnTheWay) {
  model::RobotModel model(test::biped());
  PlannerOptions options;
  set_num_legs(options, 2);
  Planner planner(options, 0.0025, model.description().scale);
  RobotState state;
  state.size_legs(2);
  state.time = 0.0;
  state.p_WB = state.v_WB = state.w_WB_B = Vec3::Zero();
  state.q_WB = Quat::Identity();
  state.q = model.description().q_nominal;
  state.qd = JointVector::Zero(state.q.size());
  const auto friction = [&] {
    state.time += 0.0025;
    const model::Dynamics& dynamics = model.update(state, Vec3::UnitZ());
    return planner.update({}, state, dynamics).feet[1].friction;
  };
  EXPECT_EQ(friction(), options.force.friction);
  planner.set_friction(0.31);
  EXPECT_EQ(friction(), 0.31);
}

}  // namespace
}  // namespace surefoot::gaits
