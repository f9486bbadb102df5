#include "surefoot/estimation/com_height.hpp"

#include "tests/support/laden_robot.hpp"

#include <gtest/gtest.h>

namespace surefoot::estimation {
namespace {

using test::kPeriod;
using test::LadenRobot;

const gaits::CalibrationOptions kOptions{.duration = 6.0};

/// A turn from `begin` to `end`; one foot feels `too_much` upward, another as much too little.
std::optional<double> turned(LadenRobot& robot, double begin, double end, double too_much = 0.0) {
  ComHeight height(kPeriod);
  const gaits::CalibrationMotion motion(kOptions);
  for (double t = kOptions.settle + begin; t < kOptions.settle + end; t += kPeriod) {
    robot.turn(motion, t);
    PerLeg<Vec3> forces = robot.forces();
    forces[0].z() += too_much;
    forces[3].z() -= too_much;
    height.add(robot.believed(), ground_reaction(robot.believed(), forces));
  }
  robot.stand();
  return height.found();
}

TEST(GroundReaction, ActsAlongALineThatTheMomentVanishesOn) {
  const LadenRobot robot({});
  PerLeg<Vec3> forces{Vec3(1, 2, 80), Vec3(-4, 3, 60), Vec3(0, 5, 90), Vec3(7, 0, 70)};
  const GroundReaction reaction = ground_reaction(robot.believed(), forces);
  for (const double z : {-0.3, 0.0, 0.5}) {
    Vec3 point;
    point << reaction.line_of_action(z), z;
    Vec3 moment = Vec3::Zero();
    for (std::size_t k = 0; k < kNumLegs; ++k) {
      moment += (robot.believed().contact[k].p - point).cross(forces[k]);
    }
    EXPECT_LT(moment.head<2>().norm(), 1e-9);
  }
}

TEST(ComHeight, FindsHowHighTheComLies) {
  for (const double z : {-0.05, 0.0, 0.02, 0.045}) {
    LadenRobot robot(test::shifted_by({0.02, -0.01, z}));
    EXPECT_NEAR(turned(robot, 0.0, 6.0).value_or(kNaN), z, 0.05 * std::abs(z) + 5e-4) << z;
  }
}

TEST(ComHeight, OfAPayloadUpToTheInertiaThatItHas) {
  LadenRobot robot({{6.9, {0.03, 0.02, 0.2}}});
  const Vec3 off =
      robot.believed().base_rotation.R.transpose() * (robot.actual().com - robot.believed().com.p);
  EXPECT_NEAR(turned(robot, 0.0, 6.0).value_or(kNaN), off.z(), 0.2 * off.z());
}

TEST(ComHeight, OnASlopeTooAndDoesNotTakeAConstantErrorForAHeight) {
  LadenRobot robot(test::shifted_by({0.02, 0.01, 0.03}));
  EXPECT_NEAR(turned(robot, 0.0, 6.0, 8.0).value_or(kNaN), 0.03, 3e-3);
  for (const double pitch : {-0.26, 0.26}) {
    robot.lean(0.1, pitch);
    EXPECT_NEAR(turned(robot, 0.0, 6.0).value_or(kNaN), 0.03, 3e-3) << pitch;
  }
}

TEST(ComHeight, KnowsNoneWhereTheTorsoHardlyTilted) {
  LadenRobot robot(test::shifted_by({0.0, 0.0, 0.03}));
  EXPECT_FALSE(ComHeight(kPeriod).found());
  EXPECT_FALSE(turned(robot, 0.0, 1.5));
  ComHeight height(kPeriod);
  const model::Dynamics& dynamics = robot.believed();
  for (int i = 0; i < 4000; ++i) height.add(dynamics, ground_reaction(dynamics, robot.forces()));
  EXPECT_FALSE(height.found()) << "a robot that stands";
}

TEST(ComHeight, PassesOverWhatIsNoNumber) {
  LadenRobot robot(test::shifted_by({0.0, 0.0, 0.03}));
  const double known = turned(robot, 0.0, 6.0).value_or(kNaN);
  ComHeight height(kPeriod);
  const gaits::CalibrationMotion motion(kOptions);
  PerLeg<Vec3> none = robot.forces();
  none[1].y() = kNaN;
  for (double t = kOptions.settle; t < kOptions.settle + 6.0; t += kPeriod) {
    robot.turn(motion, t);
    height.add(robot.believed(), ground_reaction(robot.believed(), robot.forces()));
    height.add(robot.believed(), ground_reaction(robot.believed(), none));
  }
  EXPECT_NEAR(height.found().value_or(kNaN), known, 1e-9);
  height.forget();
  EXPECT_FALSE(height.found());
}

}  // namespace
}  // namespace surefoot::estimation
