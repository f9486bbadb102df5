// Any frame of a robot moves as its Jacobians say, in W and relative to the base.
#include "surefoot/model/frames.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/math/rotation.hpp"
#include "surefoot/model/robot_model.hpp"
#include "tests/support/anymal_b.hpp"
#include "tests/support/biped.hpp"
#include "tests/support/hexapod.hpp"
#include "tests/support/malloc_counter.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/random_motion.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace surefoot::model {
namespace {

using test::Random;

const Vec3 kUp = Vec3::UnitZ();

std::vector<RobotDescription> robots() {
  return {test::anymal_b_with_arm(), test::hexapod(), test::biped()};
}

enum class In { world, base };

/// A frame at a state, and 1 µs before and after along a motion with u̇ = 0.
struct Moments {
  Moments(const RobotDescription& robot, const RobotState& state)
      : model(robot),
        now(model.update(state, kUp)),
        after(model.update(test::moved(state, state.u(), kStep), kUp)),
        before(model.update(test::moved(state, state.u(), -kStep), kUp)) {}

  void expect_derivatives(const BodyFrame& frame, In in) const {
    const auto at = [&](const Dynamics& dynamics) {
      const FrameKinematics kinematics = frame_kinematics(frame, dynamics);
      return in == In::world ? kinematics : relative_to_base(kinematics, dynamics);
    };
    const FrameKinematics here = at(now), then = at(after), first = at(before);
    constexpr double kSpan = 2.0 * kStep;
    EXPECT_LT((here.point.J * now.u - here.point.v).norm(), 1e-9);
    EXPECT_LT((here.rotation.J * now.u - here.rotation.w).norm(), 1e-9);
    EXPECT_LT(((then.point.p - first.point.p) / kSpan - here.point.v).norm(), 1e-6);
    EXPECT_LT(((then.point.v - first.point.v) / kSpan - here.point.Jdot_u).norm(), 1e-4);
    EXPECT_LT(((then.rotation.w - first.rotation.w) / kSpan - here.rotation.Jdot_u).norm(), 1e-4);
    const Vec3 turn = box_minus(Quat(then.rotation.R), Quat(first.rotation.R));
    EXPECT_LT((turn / kSpan - here.rotation.w).norm(), 1e-6);
  }

  static constexpr double kStep = 1e-6;  // [s]
  RobotModel model;
  Dynamics now, after, before;
};

TEST(Frames, MoveAsTheirJacobiansSayInTheWorldAndInTheBase) {
  Random random(1);
  for (const RobotDescription& robot : robots()) {
    const Frames frames(robot);
    const Moments moments(robot, random.state_around(robot.q_nominal));
    for (int i = 0; i < static_cast<int>(frames.names().size()); ++i) {
      SCOPED_TRACE(robot.name + " " + frames.names()[static_cast<std::size_t>(i)]);
      moments.expect_derivatives(frames[i], In::world);
      moments.expect_derivatives(frames[i], In::base);
    }
  }
}

TEST(Frames, OfTheBaseStandStillInItAndOnlyJointsMoveTheOthers) {
  Random random(2);
  const RobotDescription robot = test::anymal_b_with_arm();
  const Frames frames(robot);
  RobotModel model(robot);
  const Dynamics& now = model.update(random.state_around(robot.q_nominal), kUp);
  const auto in_base = [&](const char* name) {
    return relative_to_base(frame_kinematics(frames[frames.number(name)], now), now);
  };
  EXPECT_TRUE(in_base("base").point.J.isZero(1e-12));
  EXPECT_TRUE(in_base("base").rotation.w.isZero(1e-12));
  const FrameKinematics foot = in_base("LF_FOOT");
  EXPECT_TRUE(foot.point.J.leftCols<6>().isZero(0.0));
  EXPECT_GT(foot.point.J.middleCols<3>(6).norm(), 0.1);
  EXPECT_TRUE(foot.point.J.rightCols(foot.point.J.cols() - 9).isZero(0.0)) << "other limbs";
}

TEST(Frames, AreThoseThatTheModelKnowsByOtherNames) {
  Random random(3);
  const RobotDescription robot = test::anymal_b_with_arm();
  const Frames frames(robot);
  RobotModel model(robot);
  const Dynamics& now = model.update(random.state_around(robot.q_nominal), kUp);
  const auto named = [&](const std::string& name) {
    return frame_kinematics(frames[frames.number(name)], now);
  };
  const ArmDescription& arm = robot.arms.front();
  for (const std::string& name : {arm.tip_frame, arm.name}) {
    const FrameKinematics tip = named(name), &known = now.arm_tips.front();
    EXPECT_LT((tip.point.p - known.point.p).norm(), 1e-12);
    EXPECT_LT((tip.point.J - known.point.J).norm(), 1e-10);
    EXPECT_LT((tip.rotation.J - known.rotation.J).norm(), 1e-10);
  }
  EXPECT_LT((named("LF_SHANK").rotation.R - now.shank[0].R).norm(), 1e-12);
  EXPECT_LT((named("LF_KFE").point.p - named("LF_SHANK").point.p).norm(), 1e-12)
      << "a joint is the frame that it turns";
  EXPECT_EQ(frames.arm_of(frames.number(arm.tip_frame)), 0);
  EXPECT_EQ(frames.arm_of(frames.number("LF_SHANK")), -1);
}

TEST(Frames, ThatAreUnknownAreToldWithTheNearest) {
  const Frames frames(test::anymal_b());
  const std::string text = test::message_of([&] { (void)frames.number("LF_SHNK"); });
  EXPECT_TRUE(test::holds(text,
                          "has no frame \"LF_SHNK\"; did you mean \"LF_SHANK\"? closest: "
                          "LF_SHANK, "));
  EXPECT_LT(text.size(), 200u) << "not all of them";
}

TEST(Frames, CostNoAllocation) {
  const RobotDescription robot = test::biped();
  const Frames frames(robot);
  RobotModel model(robot);
  Random random(4);
  const RobotState state = random.state_around(robot.q_nominal);
  const BodyFrame& hand = frames[frames.number(robot.arms.front().tip_frame)];
  const test::MallocCounter mallocs;
  const Dynamics& now = model.update(state, kUp);
  const FrameKinematics kinematics = relative_to_base(frame_kinematics(hand, now), now);
  EXPECT_EQ(mallocs.count(), 0u);
  EXPECT_TRUE(kinematics.point.p.allFinite());
}

}  // namespace
}  // namespace surefoot::model
