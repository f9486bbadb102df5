#include "surefoot/math/rotation.hpp"
#include "surefoot/tasks/frame_orientation.hpp"
#include "surefoot/tasks/frame_position.hpp"
#include "surefoot/tasks/joint_damping.hpp"
#include "surefoot/tasks/joint_position_limits.hpp"
#include "surefoot/tasks/posture.hpp"
#include "tests/support/messages.hpp"
#include "tests/tasks/scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

namespace surefoot::tasks {
namespace {

using test::written;
using test::WrittenRows;

constexpr int kArmJoints = 6;

/// ANYmal B with an arm, in motion.
struct Bench {
  Bench() {
    for (JointVector* values : {&state.q, &state.qd}) {
      values->conservativeResize(kNumLegJoints + kArmJoints);
      for (double& value : values->tail(kArmJoints)) value = random.uniform(-1.0, 1.0);
    }
  }
  WrittenRows rows(Task&& task) {
    const model::Dynamics& dynamics = model.update(state, Vec3::UnitZ());
    support.update(dynamics, plan);
    task.prepare(model.description());
    return written(task, {dynamics, plan, support, model.description()});
  }
  [[nodiscard]] const model::FrameKinematics& tip() const { return model.dynamics().arm_tips[0]; }

  test::Random random{7};
  model::RobotModel model{test::anymal_b_with_arm()};
  RobotState state = random.state();
  MotionPlan plan = test::plan_with_contacts({true, true, true, true});
  model::SupportDynamics support;
};

/// The only acceleration of the tip that the rows allow.
Vec3 asked(const WrittenRows& rows, const Vec3& drift) { return rows.lower + drift; }

TEST(FramePosition, PullsTheTipToThePlan) {
  Bench bench;
  ArmPlan& plan = bench.plan.arm;
  const FramePosition::Options options{.kp = 80.0, .kd = 12.0, .max_error = 0.05};
  EXPECT_EQ(bench.rows(FramePosition(options)).count(), 0) << "nobody asks for anything";
  plan.arm = 0;
  plan.p_WT = bench.tip().point.p + Vec3(0.01, -0.02, 0.03);
  plan.v_WT = Vec3(0.1, 0.2, 0.3);
  plan.a_WT = Vec3(1.0, 2.0, 3.0);
  WrittenRows rows = bench.rows(FramePosition(options));
  const model::PointKinematics& tip = bench.tip().point;
  ASSERT_EQ(rows.A.cols(), 6 + 2 * (kNumLegJoints + kArmJoints));
  EXPECT_TRUE(rows.A.leftCols(tip.J.cols()) == tip.J);
  EXPECT_TRUE(rows.A.rightCols(kNumLegJoints + kArmJoints).isZero(0.0)) << "torques";
  EXPECT_TRUE(rows.upper == rows.lower);
  const Vec3 wanted = plan.a_WT + 12.0 * (plan.v_WT - tip.v) + 80.0 * (plan.p_WT - tip.p);
  EXPECT_LT((asked(rows, tip.Jdot_u) - wanted).norm(), 1e-9);
  plan.p_WT = tip.p + Vec3(5.0, 0.0, 0.0);  // far: its error counts as 5 cm
  rows = bench.rows(FramePosition(options));
  const Vec3 limited = plan.a_WT + 12.0 * (plan.v_WT - tip.v) + 80.0 * Vec3(0.05, 0.0, 0.0);
  EXPECT_LT((asked(rows, tip.Jdot_u) - limited).norm(), 1e-9);
}

TEST(FrameOrientation, TurnsTheTipToThePlan) {
  Bench bench;
  ArmPlan& plan = bench.plan.arm;
  const FrameOrientation::Options options{.kp = 80.0, .kd = 12.0, .max_error = 0.5};
  EXPECT_EQ(bench.rows(FrameOrientation(options)).count(), 0);
  plan.arm = 0;
  const Vec3 turn(0.1, -0.2, 0.05);
  plan.q_WT = exp_rotation(turn) * Quat(bench.tip().rotation.R);
  plan.w_WT = Vec3(0.1, 0.2, 0.3);
  const WrittenRows rows = bench.rows(FrameOrientation(options));
  const model::RotationKinematics& tip = bench.tip().rotation;
  EXPECT_TRUE(rows.A.leftCols(tip.J.cols()) == tip.J);
  const Vec3 wanted = 12.0 * (plan.w_WT - tip.w) + 80.0 * turn;
  EXPECT_LT((asked(rows, tip.Jdot_u) - wanted).norm(), 1e-9);
}

TEST(Posture, PullsTheJointsItIsForToTheNominalPosture) {
  Bench bench;
  const int all = kNumLegJoints + kArmJoints;
  for (const auto& [joints, first, count] : {std::tuple{"arms", 12, 6},
                                             {"legs", 0, 12},
                                             {"all", 0, all},
                                             {"RF_HAA RF_HFE RF_KFE", 3, 3}}) {
    const WrittenRows rows =
        bench.rows(Posture({.joints = joints, .kp = 9.0, .kd = 4.0, .max_error = 0.3}));
    ASSERT_EQ(rows.count(), count);
    for (int i = 0; i < count; ++i) {
      const int j = first + i;
      const double error = bench.model.description().q_nominal[j] - bench.state.q[j];
      EXPECT_EQ(rows.A(i, 6 + j), 1.0);
      EXPECT_EQ(rows.A.row(i).cwiseAbs().sum(), 1.0);
      EXPECT_NEAR(rows.lower[i], 9.0 * std::clamp(error, -0.3, 0.3) - 4.0 * bench.state.qd[j],
                  1e-12);
      EXPECT_EQ(rows.ids[static_cast<std::size_t>(i)], j);
    }
  }
}

TEST(JointPositionLimits, BoundTheJointsTheyAreFor) {
  Bench bench;
  const auto of_arm = [&] { return bench.rows(JointPositionLimits({.joints = "reaching_arm"})); };
  EXPECT_EQ(of_arm().count(), 0) << "no arm reaches";
  bench.plan.arm.arm = 0;
  EXPECT_EQ(of_arm().ids, (std::vector<int>{12, 13, 14, 15, 16, 17}));
  EXPECT_EQ(bench.rows(JointPositionLimits({.joints = "RH_KFE"})).ids, std::vector<int>{11});
}

TEST(JointDamping, SlowsTheJointsItIsForWhereverTheyAre) {
  Bench bench;
  bench.plan.arm.arm = 0;
  const WrittenRows rows = bench.rows(JointDamping({.joints = "reaching_arm", .kd = 4.0}));
  ASSERT_EQ(rows.ids, (std::vector<int>{12, 13, 14, 15, 16, 17}));
  for (int i = 0; i < rows.count(); ++i) {
    EXPECT_EQ(rows.A(i, 18 + i), 1.0);
    EXPECT_NEAR(rows.lower[i], -4.0 * bench.state.qd[12 + i], 1e-12);
    EXPECT_EQ(rows.lower[i], rows.upper[i]);
  }
}

TEST(Posture, FollowsThePlansJoints) {
  Bench bench;
  const Posture::Options options{
      .joints = "RH_KFE LF_HAA", .target = Posture::Target::plan, .kp = 9.0, .kd = 4.0};
  EXPECT_TRUE(Posture(options).follows_joints());
  WrittenRows rows = bench.rows(Posture(options));
  ASSERT_EQ(rows.ids, (std::vector<int>{11, 0}));
  EXPECT_NEAR(rows.lower[1], -4.0 * bench.state.qd[0], 1e-12) << "no plan: it stays";
  bench.plan.joints = bench.state.q;
  bench.plan.joints[11] += 0.1;
  rows = bench.rows(Posture(options));
  EXPECT_NEAR(rows.lower[0], 0.9 - 4.0 * bench.state.qd[11], 1e-12);
}

TEST(Posture, RefusesJointsThatTheRobotHasNotOrTwice) {
  Bench bench;
  const auto error_of = [&](const char* joints) {
    return test::message_of([&] { (void)bench.rows(Posture({.joints = joints})); });
  };
  EXPECT_TRUE(test::holds(error_of("LF_KEF"), "no joint \"LF_KEF\"; did you mean \"LF_KFE\"?"));
  EXPECT_TRUE(test::holds(error_of("LF_KFE LF_KFE"), "\"LF_KFE\" is named twice"));
  EXPECT_TRUE(test::holds(error_of(" "), "joints is empty"));
}

/// Any frame, in both worlds, with and without a reference.
class FollowedFrameTest : public testing::TestWithParam<std::tuple<const char*, HeldIn>> {};

TEST_P(FollowedFrameTest, IsPulledToThePlanInItsWorld) {
  const auto& [name, held_in] = GetParam();
  Bench bench;
  const model::Frames frames(bench.model.description());
  const int number = frames.number(name);
  const bool in_world = held_in == HeldIn::world;
  const FramePosition::Options options{
      .frame = name, .held_in = held_in, .kp = 80.0, .kd = 12.0, .max_error = 0.05};
  const FrameOrientation::Options turning{
      .frame = name, .held_in = held_in, .kp = 80.0, .kd = 12.0, .max_error = 0.5};
  const WrittenRows held = bench.rows(FramePosition(options));
  model::FrameKinematics frame = frame_kinematics(frames[number], bench.model.dynamics());
  if (!in_world) frame = relative_to_base(frame, bench.model.dynamics());
  ASSERT_EQ(held.count(), 3);
  EXPECT_LT((asked(held, frame.point.Jdot_u) + 12.0 * frame.point.v).norm(), 1e-9)
      << "without a reference it comes to rest";
  const Vec3 turn(0.1, -0.2, 0.05);
  const FramePlan plan{.frame = number,
                       .in_world = in_world,
                       .p_XF = frame.point.p + Vec3(0.01, -0.02, 0.03),
                       .v_XF = Vec3(0.1, 0.2, 0.3),
                       .a_XF = Vec3(1.0, 2.0, 3.0),
                       .q_XF = exp_rotation(turn) * Quat(frame.rotation.R),
                       .w_XF = Vec3(0.3, 0.2, 0.1)};
  bench.plan.frames.add(plan);
  const WrittenRows position = bench.rows(FramePosition(options));
  EXPECT_TRUE(position.A.leftCols(frame.point.J.cols()).isApprox(frame.point.J, 1e-12));
  EXPECT_TRUE(position.A.rightCols(kNumLegJoints + kArmJoints).isZero(0.0)) << "torques";
  const Vec3 wanted =
      plan.a_XF + 12.0 * (plan.v_XF - frame.point.v) + 80.0 * Vec3(0.01, -0.02, 0.03);
  EXPECT_LT((asked(position, frame.point.Jdot_u) - wanted).norm(), 1e-9);
  const WrittenRows orientation = bench.rows(FrameOrientation(turning));
  const Vec3 wanted_turn = 12.0 * (plan.w_XF - frame.rotation.w) + 80.0 * turn;
  EXPECT_LT((asked(orientation, frame.rotation.Jdot_u) - wanted_turn).norm(), 1e-9);
}

INSTANTIATE_TEST_SUITE_P(EveryPart, FollowedFrameTest,
                         testing::Combine(testing::Values("base", "LF_SHANK", "RH_HFE",
                                                          "j2s6s200_link_4", "LH_FOOT"),
                                          testing::Values(HeldIn::base, HeldIn::world)));

TEST(FramePosition, RefusesAFrameThatTheRobotHasNot) {
  Bench bench;
  const std::string text =
      test::message_of([&] { (void)bench.rows(FramePosition({.frame = "LF_SHINK"})); });
  EXPECT_TRUE(test::holds(text, "has no frame \"LF_SHINK\"; did you mean \"LF_SHANK\"?"));
}

}  // namespace
}  // namespace surefoot::tasks
