// Legs of more than three joints: the hexapod, with a joint ahead of each HAA and one behind each
// KFE.
#include "surefoot/base/error.hpp"
#include "surefoot/config/robot_file.hpp"
#include "surefoot/config/stack_file.hpp"
#include "surefoot/model/body_tree.hpp"
#include "surefoot/model/robot_model.hpp"
#include "surefoot/simulation/model_agreement.hpp"
#include "tests/logging/temporary_folder.hpp"
#include "tests/support/hexapod.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/random_motion.hpp"
#include "tests/support/source_file.hpp"

#include <gtest/gtest.h>

#include <string>

namespace surefoot::config {
namespace {

using test::Random;

const Vec3 kUp = Vec3::UnitZ();
void replace(std::string& text, const std::string& old, const std::string& with) {
  const std::size_t place = text.find(old);
  ASSERT_NE(place, std::string::npos) << old;
  text.replace(place, old.size(), with);
}

class FurtherJoints : public testing::Test {
 protected:
  FurtherJoints() {
    test::write_file(folder_ / "robot.urdf", test::hexapod_urdf_with_further_joints());
    replace(file_, "hexapod.urdf", "robot.urdf");
    replace(file_, "radius: 0.03", "radius: 0.03\n  center: [0, 0, -0.05]");
    replace(file_, "{foot: LF_foot}", "{foot: LF_foot, further: {posture: [0.1, -0.2]}}");
  }

  [[nodiscard]] model::RobotDescription robot() const {
    test::write_file(folder_ / "robot.yaml", file_);
    return load_robot(folder_ / "robot.yaml");
  }

  test::TemporaryFolder folder_;
  std::string file_ = test::contents(test::source_file("robots/hexapod.yaml"));
};

TEST_F(FurtherJoints, are_found_beside_those_that_place_the_foot) {
  const model::RobotDescription robot = this->robot();
  const model::LegDescription& leg = robot.legs[0];
  EXPECT_EQ(leg.joints, (std::vector<std::string>{"LF_HAA", "LF_HFE", "LF_KFE"}));
  EXPECT_EQ(leg.further, (std::vector<std::string>{"LF_YAW", "LF_ANKLE"}));
  EXPECT_EQ(leg.shank_link, "LF_foot");
  ASSERT_EQ(robot.num_joints(), 30);
  EXPECT_EQ(robot.joint_name(18), "LF_YAW");
  EXPECT_EQ(robot.q_nominal[18], 0.1);
  EXPECT_EQ(robot.q_nominal[19], -0.2);
  EXPECT_EQ(robot.q_nominal[20], 0.0);
  EXPECT_EQ(robot.torque_limit[29], 60.0);
}

TEST_F(FurtherJoints, may_be_chosen_by_naming_the_others) {
  replace(file_, "{foot: RF_foot}", "{foot: RF_foot, joints: [RF_YAW, RF_HFE, RF_KFE]}");
  EXPECT_EQ(robot().legs[1].further, (std::vector<std::string>{"RF_HAA", "RF_ANKLE"}));
}

TEST_F(FurtherJoints, have_a_number_each_in_a_list) {
  replace(file_, "[0.1, -0.2]", "[0.1]");
  EXPECT_TRUE(
      test::holds(test::message_of([&] { (void)robot(); }),
                  "legs.LF.further.posture: has 1 numbers, but the leg has 2 further joints"));
}

TEST_F(FurtherJoints, are_in_the_model_what_they_are_in_the_physics) {
  EXPECT_EQ(simulation::disagreements(robot(), 20), std::vector<std::string>());
}

TEST_F(FurtherJoints, move_feet_and_mass_as_the_jacobians_say) {
  constexpr double kStep = 1e-6;
  const model::RobotDescription robot = this->robot();
  model::RobotModel model(robot);
  Random random(1);
  KinematicErrors longer = no_errors(kMaxLegs);
  for (double& length : longer.thigh) length = random.uniform(-0.01, 0.01);
  for (double& length : longer.shank) length = random.uniform(-0.01, 0.01);
  model.set_leg_lengths(longer);
  const RobotState state = random.state_around(robot.q_nominal);
  const GeneralizedVector u = state.u();
  const model::Dynamics now = model.update(state, kUp);
  const model::Dynamics after = model.update(test::moved(state, u, kStep), kUp);
  const model::Dynamics before = model.update(test::moved(state, u, -kStep), kUp);
  const auto expect_moves = [&](const model::PointKinematics& point, const auto& place) {
    EXPECT_LT((point.J * u - point.v).norm(), 1e-9);
    EXPECT_LT(((place(after).p - place(before).p) / (2.0 * kStep) - point.v).norm(), 1e-6);
    EXPECT_LT(((place(after).v - place(before).v) / (2.0 * kStep) - point.Jdot_u).norm(), 1e-4);
  };
  expect_moves(now.com, [](const auto& dynamics) { return dynamics.com; });
  for (const Leg leg : now.foot.legs()) {
    const std::size_t k = index(leg);
    expect_moves(now.foot[k], [k](const auto& dynamics) { return dynamics.foot[k]; });
    expect_moves(now.hip[k], [k](const auto& dynamics) { return dynamics.hip[k]; });
    EXPECT_LT((now.contact[k].J * u - now.contact[k].v).norm(), 1e-9);
    EXPECT_LT((now.shank[k].J * u - now.shank[k].w).norm(), 1e-9);
  }
}

TEST_F(FurtherJoints, are_in_a_leg_s_chain_where_they_stand) {
  const model::RobotDescription robot = this->robot();
  const model::BodyTree tree = model::make_body_tree(robot, model::read_urdf(robot));
  model::RobotModel model(robot);
  Random random(2);
  const RobotState state = random.state_around(robot.q_nominal);
  const model::Dynamics& dynamics = model.update(state, kUp);
  for (const Leg leg : robot.legs.legs()) {
    const Vec3 q = state.q.segment<3>(first_joint(leg));
    const model::LegChain chain = model::leg_chain(tree, leg, state.q);
    const Vec3 foot = state.p_WB + state.R_WB() * chain.foot_in_base(q);
    const Vec3 hip = state.p_WB + state.R_WB() * chain.hip_in_base(q);
    EXPECT_LT((foot - dynamics.foot[index(leg)].p).norm(), 1e-12);
    EXPECT_LT((hip - dynamics.hip[index(leg)].p).norm(), 1e-12);
  }
}

TEST_F(FurtherJoints, are_held_below_the_physics_unless_the_stack_moves_them) {
  model::RobotDescription robot = this->robot();
  robot.scale.length = 0.25;
  const control::StackOptions stack = load_stack("terrain_adaptation");
  const control::StackOptions held = with_scaled_arms(stack, robot);
  ASSERT_EQ(held.levels.size(), stack.levels.size() + 1);
  std::size_t i = 0;
  while (control::keeps_physics(held.levels[i])) ++i;
  EXPECT_EQ(held.levels[i].name, "leg_posture");
  EXPECT_EQ(held.levels[i].tasks[0].numbers.at("kp"), 3200.0);
  EXPECT_EQ(held.levels[i].tasks[0].numbers.at("kd"), 112.0);
  EXPECT_EQ(with_scaled_arms(held, robot).levels.size(), held.levels.size());
}

}  // namespace
}  // namespace surefoot::config
