#include "surefoot/gaits/parts/frame_reference.hpp"

#include "surefoot/math/rotation.hpp"
#include "surefoot/model/robot_model.hpp"
#include "tests/support/anymal_b.hpp"
#include "tests/support/malloc_counter.hpp"
#include "tests/support/random_motion.hpp"

#include <gtest/gtest.h>

namespace surefoot::gaits {
namespace {

constexpr double kPeriod = 0.0025;

/// ANYmal B whose left front shank is followed.
struct Bench {
  explicit Bench(bool in_world = false) : frame{number, in_world, frames[number]} {
    state.p_WB = Vec3(1.0, 2.0, 0.5);
    state.q_WB = from_roll_pitch_yaw({0.1, 0.2, 0.3});
    references.follow({frame}, false);
  }
  FramePlan after(double time, const ReachCommand& command = {}) {
    for (double t = 0.0; t < time; t += kPeriod) {
      plan = {};
      references.complete(plan, command, model.update(state, Vec3::UnitZ()));
    }
    return *plan.frames.find(number);
  }

  model::Frames frames{test::anymal_b()};
  model::RobotModel model{test::anymal_b()};
  int number = frames.number("LF_SHANK");
  model::FollowedFrame frame;
  RobotState state = test::Random(1).standing_state(test::anymal_b().q_nominal);
  FrameReferences references{kPeriod, {}};
  MotionPlan plan;
};

TEST(FrameReferences, HoldAFrameWhereItIsAtFirst) {
  for (const bool in_world : {false, true}) {
    Bench bench(in_world);
    const FramePlan first = bench.after(kPeriod);
    EXPECT_EQ(first.in_world, in_world);
    const model::Dynamics& now = bench.model.dynamics();
    model::FrameKinematics shank = frame_kinematics(bench.frame.at, now);
    if (!in_world) shank = relative_to_base(shank, now);
    EXPECT_LT((first.p_XF - shank.point.p).norm(), 1e-12);
    EXPECT_LT(first.q_XF.angularDistance(Quat(shank.rotation.R)), 1e-7);
    bench.state.p_WB.x() += 0.3;
    bench.state.q[2] += 0.2;
    const FramePlan later = bench.after(1.0);
    EXPECT_LT((later.p_XF - first.p_XF).norm(), 1e-12);
    EXPECT_TRUE(later.v_XF.isZero(0.0));
  }
}

TEST(FrameReferences, GoWhereTheUserWantsThemAndStayThere) {
  Bench bench;
  const FramePlan first = bench.after(kPeriod);
  const Vec3 wanted = first.p_XF + Vec3(0.008, -0.015, 0.004);
  const Vec3 turned = roll_pitch_yaw(first.q_XF.toRotationMatrix()) + Vec3(0.05, 0.04, -0.1);
  const ReachCommand command{.position = wanted, .orientation = turned, .frame = bench.number};
  EXPECT_LT((bench.after(kPeriod, command).p_XF - first.p_XF).norm(), 1e-4) << "no jump";
  const FramePlan there = bench.after(8.0, command);
  EXPECT_LT((there.p_XF - wanted).norm(), 1e-3);
  EXPECT_LT(there.q_XF.angularDistance(from_roll_pitch_yaw(turned)), 1e-3);
  EXPECT_LT((bench.after(1.0).p_XF - wanted).norm(), 1e-3) << "without a command";
  const ReachCommand elsewhere{.in_world = true, .position = Vec3::Zero(), .frame = bench.number};
  const FramePlan in_world = bench.after(kPeriod, elsewhere);
  EXPECT_TRUE(in_world.in_world);
  const Vec3 now = frame_kinematics(bench.frame.at, bench.model.dynamics()).point.p;
  EXPECT_LT((in_world.p_XF - now).norm(), 1e-3) << "begins where the frame is";
}

TEST(FrameReferences, LeaveWhatThePlannerGives) {
  Bench bench;
  MotionPlan plan;
  plan.frames.add({.frame = bench.number, .p_XF = Vec3(1.0, 2.0, 3.0)});
  plan.joints = JointVector::Constant(12, 0.5);
  bench.references.follow({bench.frame}, true);
  bench.references.complete(plan, {}, bench.model.update(bench.state, Vec3::UnitZ()));
  EXPECT_EQ(plan.frames.count, 1u);
  EXPECT_EQ(plan.frames.find(bench.number)->p_XF, Vec3(1.0, 2.0, 3.0));
  EXPECT_EQ(plan.joints[3], 0.5);
}

TEST(FrameReferences, HoldTheJointsWhereTheyWere) {
  Bench bench;
  bench.references.follow({}, true);
  const JointVector first = bench.state.q;
  for (int tick = 0; tick < 3; ++tick) {
    bench.plan = {};
    bench.references.complete(bench.plan, {}, bench.model.update(bench.state, Vec3::UnitZ()));
    EXPECT_EQ(bench.plan.joints, first);
    bench.state.q[1] += 0.1;
  }
}

TEST(FrameReferences, GoOnWhereAnotherStackFollowsTheFrame) {
  Bench bench;
  const FramePlan first = bench.after(kPeriod);
  bench.state.q[2] += 0.2;
  const int other = bench.frames.number("RH_SHANK");
  bench.references.follow({{other, false, bench.frames[other]}, bench.frame}, false);
  EXPECT_LT((bench.after(kPeriod).p_XF - first.p_XF).norm(), 1e-12);
  EXPECT_NE(bench.plan.frames.find(other), nullptr);
  const test::MallocCounter mallocs;
  (void)bench.after(0.1);
  EXPECT_EQ(mallocs.count(), 0u);
}

}  // namespace
}  // namespace surefoot::gaits
