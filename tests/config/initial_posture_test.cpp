#include "surefoot/config/initial_posture.hpp"

#include "tests/support/anymal_b.hpp"
#include "tests/support/messages.hpp"

namespace surefoot::config {
namespace {

/// Every knee configuration.
class InitialPosture : public testing::TestWithParam<gaits::KneeConfiguration> {
 protected:
  model::RobotModel model_{test::anymal_b()};
  gaits::StanceOptions stance_{
      .half_length = 0.35, .half_width = 0.21, .height = 0.44, .knees = GetParam()};
};

TEST_P(InitialPosture, puts_the_feet_where_the_stance_wants_them) {
  const JointVector q = stance_posture(model_, stance_);
  for (const Leg leg : kLegs) {
    const Vec3 p_BF = model_.foot_in_base(leg, q.segment<3>(first_joint(leg)));
    const Vec3 expected(is_front(leg) ? 0.35 : -0.35, is_left(leg) ? 0.21 : -0.21, -0.44);
    EXPECT_TRUE(p_BF.isApprox(expected, 1e-6)) << p_BF.transpose();
  }
}

TEST_P(InitialPosture, bends_the_knees_to_their_side) {
  const JointVector q = stance_posture(model_, stance_);
  for (const Leg leg : kLegs) {
    const double hfe = q[first_joint(leg) + 1], kfe = q[first_joint(leg) + 2];
    const double backward = GetParam() == gaits::KneeConfiguration::backward ||
                                    (GetParam() == gaits::KneeConfiguration::x && is_front(leg))
                                ? 1.0
                                : -1.0;
    EXPECT_GT(backward * hfe, 0.0) << kLegNames[index(leg)];
    EXPECT_LT(backward * kfe, 0.0) << kLegNames[index(leg)];
  }
}

TEST_P(InitialPosture, follows_the_knees_of_the_robots_nominal_posture) {
  model::RobotDescription turned = test::anymal_b();
  turned.q_nominal = -turned.q_nominal;
  const JointVector q = stance_posture(model_, stance_);
  const JointVector other = stance_posture(model::RobotModel(turned), stance_);
  for (const Leg leg : kLegs) {
    for (const int joint : {first_joint(leg) + 1, first_joint(leg) + 2}) {
      EXPECT_LT(q[joint] * other[joint], 0.0) << kLegNames[index(leg)];
    }
  }
}

TEST_P(InitialPosture, out_of_reach_names_the_foot) {
  stance_.height = 0.7;
  EXPECT_TRUE(
      test::holds(test::message_of([&] { (void)stance_posture(model_, stance_); }), "foot LF"));
}

TEST_P(InitialPosture, outside_the_limits_names_the_joint_and_the_knees_that_would_fit) {
  model::RobotDescription robot = test::anymal_b();
  const bool backward =
      GetParam() != gaits::KneeConfiguration::backward;  // all that the limits leave
  for (const Leg leg : kLegs) {
    const Eigen::Index knee = first_joint(leg) + 2;
    (backward ? robot.q_max : robot.q_min)[knee] = backward ? -0.1 : 0.1;
  }
  const model::RobotModel model(robot);
  const std::string message = test::message_of([&] { (void)stance_posture(model, stance_); });
  EXPECT_TRUE(test::holds(message, "planner.stance: it puts joint KFE of "));
  EXPECT_TRUE(test::holds(message, backward ? " -2.9 to -0.1 rad" : " 0.1 to 2.9 rad"));
  EXPECT_TRUE(
      test::holds(message, backward ? "knees: backward would fit" : "knees: forward would fit"));
}

INSTANTIATE_TEST_SUITE_P(EveryKneeConfiguration, InitialPosture,
                         testing::Values(gaits::KneeConfiguration::x,
                                         gaits::KneeConfiguration::forward,
                                         gaits::KneeConfiguration::backward));

}  // namespace
}  // namespace surefoot::config
