#include "surefoot/control/footing.hpp"

#include "surefoot/config/initial_posture.hpp"
#include "surefoot/control/standing_torque.hpp"
#include "surefoot/math/rotation.hpp"
#include "tests/support/anymal_b.hpp"
#include "tests/support/malloc_counter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace surefoot::control {
namespace {

using test::anymal_b;

constexpr double kPeriod = 0.0025;  // [s]
constexpr double kWeight = 300.0;   // [N]
const gaits::StanceOptions kStance{.half_length = 0.33, .half_width = 0.22, .height = 0.46};

JointVector stance(gaits::KneeConfiguration knees = gaits::KneeConfiguration::x) {
  gaits::StanceOptions options = kStance;
  options.knees = knees;
  return config::stance_posture(model::RobotModel(anymal_b()), options);
}

/// On its belly, knees where the nominal posture has them or on the other side.
JointVector lying(double side = 1.0) {
  JointVector q(kNumLegJoints);
  for (const Leg leg : kLegs) {
    const double s = is_front(leg) ? side : -side;
    q.segment<3>(first_joint(leg)) << 0.0, 1.45 * s, -2.8 * s;
  }
  return q;
}

/// A robot whose joints go where they are sent, or not.
struct Robot {
  explicit Robot(const JointVector& posture) : q(posture) { footing.look_at_start(model, q); }

  void bear(double share) {
    for (Vec3& force : forces) force = Vec3(0.0, 0.0, share * kWeight / kNumLegs);
  }
  /// Until the time has gone by, or it stands.
  void run(double duration, bool until_it_stands = true) {
    for (double t = 0.0; t < duration && !(until_it_stands && footing.stands()); t += kPeriod) {
      lift.update(kWeight, forces, Vec3(0.0, 0.0, kGravity));
      const PlanEvent event = footing.update(model, state(), lift);
      if (event != PlanEvent::none) events.push_back(event);
      const JointVector next = footing.posture(lift).q;
      largest_step = std::max(largest_step, (next - q).cwiseAbs().maxCoeff());
      if (follows && !footing.stands()) q = next;
    }
  }

  [[nodiscard]] RobotState state() const {
    RobotState result;
    result.q = q;
    result.qd.setZero();
    result.q_WB = from_roll_pitch_yaw({roll, 0.0, 0.0});
    return result;
  }

  model::RobotModel model{anymal_b()};
  Footing footing{kStance, kPeriod};
  estimation::LiftDetector lift{kPeriod};
  JointVector q;
  PerLeg<Vec3> forces{};
  bool follows = true;
  double roll = 0.0;          // [rad]
  double largest_step = 0.0;  // [rad]
  std::vector<PlanEvent> events;
};

TEST(Footing, ARobotThatStandsIsLeftAlone) {
  Robot robot(stance());
  robot.bear(1.0);
  robot.run(3.0, false);
  EXPECT_TRUE(robot.footing.stands());
  EXPECT_TRUE(robot.events.empty());
}

TEST(Footing, OneThatLiesFoldsItsLegsAndStretchesThem) {
  Robot robot(lying());
  EXPECT_FALSE(robot.footing.stands());
  robot.bear(0.2);
  robot.run(1.0);
  robot.bear(1.0);
  const test::MallocCounter counter;
  robot.run(8.0);
  EXPECT_LE(counter.count(), 1U);  // of this test's list of events
  EXPECT_TRUE(robot.footing.stands());
  EXPECT_TRUE(robot.footing.restarts());
  EXPECT_LT((robot.q - stance()).cwiseAbs().maxCoeff(), 0.01);
  EXPECT_LT(robot.largest_step, 0.01);  // 4 rad/s
  EXPECT_EQ(robot.events, std::vector{PlanEvent::stands_up});
}

TEST(Footing, KneesStayOnTheirSide) {
  Robot robot(lying(-1.0));
  robot.bear(1.0);
  robot.run(10.0);
  EXPECT_TRUE(robot.footing.stands());
  for (const Leg leg : kLegs) {
    const double knee = robot.q[first_joint(leg) + 2];
    EXPECT_EQ(knee > 0.0, is_front(leg));
  }
}

TEST(Footing, OneThatIsLiftedRelaxesAndStandsUpWhenItIsPutDown) {
  Robot robot(stance());
  robot.bear(1.0);
  robot.run(1.0, false);
  robot.bear(0.0);
  robot.run(2.0, false);
  ASSERT_TRUE(robot.footing.hangs());
  EXPECT_EQ(robot.footing.posture(robot.lift).bears, 0.0);
  EXPECT_LT((robot.footing.posture(robot.lift).q - stance()).cwiseAbs().maxCoeff(), 0.01);
  robot.bear(0.4);  // somebody holds it with its feet on the ground
  robot.run(2.0, false);
  EXPECT_TRUE(robot.footing.hangs());
  robot.bear(1.0);
  robot.run(0.5);
  EXPECT_EQ(robot.footing.posture(robot.lift).bears, 1.0);  // at once: the feet do already
  robot.run(4.0);
  EXPECT_TRUE(robot.footing.stands());
  EXPECT_EQ(robot.events, (std::vector{PlanEvent::lifted, PlanEvent::stands_up}));
}

TEST(Footing, OneThatIsLiftedAsItRisesRelaxesAgain) {
  Robot robot(stance());
  robot.bear(0.0);
  robot.run(2.0, false);
  robot.bear(1.0);
  robot.run(0.6);
  ASSERT_FALSE(robot.footing.hangs());
  robot.bear(0.0);
  robot.run(0.5, false);
  EXPECT_TRUE(robot.footing.hangs());
}

TEST(Footing, OneThatRisesTiltedIsTurnedUpright) {
  Robot robot(stance());
  robot.roll = 0.1;
  const auto moment = [&](double rate) {
    RobotState state = robot.state();
    state.w_WB_B = Vec3(rate, 0.0, 0.0);
    return robot.footing.righting(robot.model.update(robot.state(), Vec3::UnitZ()), state).moment;
  };
  robot.bear(0.0);
  robot.run(2.0, false);
  EXPECT_EQ(moment(0.0), Vec3::Zero()) << "hands hold it";
  robot.bear(1.0);
  robot.run(0.6);
  const double inertia =
      limp_inertia(robot.model.update(robot.state(), Vec3::UnitZ()))(0, 0);  // [kg·m²]
  EXPECT_NEAR(moment(0.0).x(), -25.0 * inertia * std::sin(robot.roll), 0.01);
  EXPECT_NEAR(moment(0.5).x() - moment(0.0).x(), -8.0 * inertia * 0.5, 0.01);
  EXPECT_NEAR(moment(0.0).z(), 0.0, 1e-12);
  robot.run(4.0);
  EXPECT_EQ(moment(0.0), Vec3::Zero()) << "it stands";
}

// Its feet bear little, and yet it feels its weight: hands would hold it so, or the ground does.
TEST(Footing, OneThatLiesOnItsTorsoHasFallen) {
  for (const bool askew : {false, true}) {
    Robot robot(stance());
    robot.bear(1.0);
    robot.run(1.0, false);
    if (askew) robot.roll = 0.6;
    if (!askew) robot.q = lying();
    robot.bear(0.0);
    robot.run(0.2, false);
    EXPECT_TRUE(robot.footing.has_fallen());
    EXPECT_TRUE(robot.events.empty());
  }
}

// In the air its legs come to the stance, and nobody bears it.
TEST(Footing, OneThatIsHeldWithFoldedLegsHangs) {
  Robot robot(lying());
  robot.run(10.0, false);
  EXPECT_TRUE(robot.footing.hangs());
  EXPECT_FALSE(robot.footing.has_failed());
}

TEST(Footing, OneThatTipsOnTheWayCanNotStand) {
  Robot robot(lying());
  robot.bear(1.0);
  robot.run(4.0);
  EXPECT_FALSE(robot.footing.has_failed());
  robot.roll = 0.6;
  robot.run(0.01);
  EXPECT_TRUE(robot.footing.has_failed());
}

TEST(Footing, OneWhoseLegIsHeldFastCanNotStand) {
  Robot robot(lying());
  robot.follows = false;
  robot.bear(1.0);
  robot.run(12.0);
  EXPECT_TRUE(robot.footing.has_failed());
  EXPECT_FALSE(robot.footing.stands());
}

}  // namespace
}  // namespace surefoot::control
