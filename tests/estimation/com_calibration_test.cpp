#include "surefoot/estimation/com_calibration.hpp"

#include "tests/support/laden_robot.hpp"

#include <gtest/gtest.h>

namespace surefoot::estimation {
namespace {

using test::kModelMass;
using test::kPeriod;
using test::LadenRobot;
using test::Lump;
using test::shifted_by;

/// A payload's own inertia looks like height: a seventh of 42 mm for 6.9 kg at 0.2 m.
constexpr double kTooHigh = 0.2 * 0.042;

/// A calibration and its robot; at every tick the model has the load in use.
struct Weighing {
  explicit Weighing(const std::vector<Lump>& truth) : robot(truth) {}

  void run(double duration, CalibrationStage stage) {
    for (double t = 0.0; t < duration; t += kPeriod) tick(stage);
  }

  void tick(CalibrationStage stage) {
    robot.model.set_base_load(calibration.load());
    robot.update();
    PerLeg<Vec3> forces = robot.forces();
    for (std::size_t k = 0; k < kNumLegs; ++k) forces[k] = forces[k] * felt + misread[k];
    calibration.update(robot.believed(), forces, stage, is_quiet);
  }

  /// `disturbed`: begin and end of a disturbance [s].
  void turn(double disturbed_from = 0.0, double disturbed_to = 0.0) {
    const gaits::CalibrationOptions options{.duration = 6.0};
    const gaits::CalibrationMotion motion(options);
    for (double t = 0.0; t < options.settle + options.duration; t += kPeriod) {
      robot.turn(motion, t);
      const double since = t - options.settle;
      is_quiet = !(since >= disturbed_from && since < disturbed_to);
      tick(motion.stage(t));
    }
    is_quiet = true;
    robot.stand();
  }

  void weigh() {
    run(1.5, CalibrationStage::weighing);
    run(1.0, CalibrationStage::settling);
  }

  /// The forces when the model has too light links.
  void misread_by(const LinkMassEstimator::Shares& heavier) {
    for (const Leg leg : kLegs) {
      const std::size_t k = index(leg);
      const Vec3 weight =
          -robot.believed().links[k].free_rate * heavier.segment<kJointsPerLeg>(first_joint(leg));
      const Mat3 J = robot.believed().contact[k].J.middleCols<3>(6 + first_joint(leg));
      misread[k] = -J.transpose().inverse() * weight;
    }
  }

  /// How far the model's COM is off the true one, in B [m].
  Vec3 error() {
    robot.model.set_base_load(calibration.load());
    robot.update();
    return robot.believed().base_rotation.R.transpose() *
           (robot.believed().com.p - robot.actual().com);
  }

  double mass() const { return calibration.load().mass; }

  LadenRobot robot;
  ComCalibration calibration{kPeriod, robot.model.base_mass()};
  double felt = 1.0;
  bool is_quiet = true;
  PerLeg<Vec3> misread{Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
};

TEST(ComCalibration, FindsWhereTheRobotStands) {
  Weighing weighing(shifted_by({0.02, -0.013, 0.0}));
  weighing.run(1.5, CalibrationStage::weighing);
  EXPECT_EQ(weighing.calibration.load().first_moment, Vec3::Zero()) << "when it has ended";
  weighing.run(0.25, CalibrationStage::settling);
  EXPECT_GT(weighing.error().norm(), 0.2 * 0.0239) << "little by little";
  EXPECT_LT(weighing.error().norm(), 0.8 * 0.0239);
  weighing.run(0.5, CalibrationStage::settling);
  EXPECT_LT(weighing.error().norm(), 1e-9);
}

TEST(ComCalibration, FindsWhatAPayloadWeighsAndHowHighItLies) {
  Weighing weighing({{6.9, {0.06, -0.04, 0.2}}});
  EXPECT_GT(weighing.error().z(), -0.05);
  EXPECT_LT(weighing.error().z(), -0.03);
  weighing.turn();
  EXPECT_EQ(weighing.mass(), 0.0) << "in use only when it is weighed";
  weighing.weigh();
  EXPECT_NEAR(weighing.mass(), 6.9, 1e-6);
  EXPECT_LT(weighing.error().head<2>().norm(), 1e-5);
  EXPECT_LT(std::abs(weighing.error().z()), kTooHigh);
}

TEST(ComCalibration, FindsThatARobotIsLighterOrAsModelled) {
  Weighing lighter({{-3.0, {0.1, 0.02, 0.05}}}), modelled({});
  for (Weighing* weighing : {&lighter, &modelled}) {
    weighing->turn();
    weighing->weigh();
    EXPECT_LT(weighing->error().head<2>().norm(), 1e-5);
  }
  EXPECT_NEAR(lighter.mass(), -3.0, 1e-6);
  EXPECT_LT(std::abs(modelled.mass()), 1e-9);
  EXPECT_LT(modelled.error().norm(), 2e-4);
}

TEST(ComCalibration, KnowsWhereTheComIsWhenLegsMoveUnderAPayload) {
  Weighing weighing({{6.9, {0.0, 0.0, 0.2}}});
  weighing.turn();
  weighing.weigh();
  weighing.robot.move_legs(0.5);
  EXPECT_LT(weighing.error().head<2>().norm(), 1e-5);
  weighing.robot.model.set_base_load({});
  weighing.robot.update();
  const Vec2 unladen = (weighing.robot.believed().com.p - weighing.robot.actual().com).head<2>();
  EXPECT_GT(unladen.norm(), 0.003) << "the same posture, by the model alone";
}

TEST(ComCalibration, KnowsWhereTheComIsOnASlope) {
  Weighing weighing({{6.9, {0.05, 0.0, 0.2}}});
  weighing.robot.lean(0.0, 0.25);
  weighing.turn();
  weighing.weigh();
  weighing.robot.lean(0.0, 0.0);
  EXPECT_LT(weighing.error().norm(), kTooHigh) << "level again";
}

TEST(ComCalibration, TakesNoMassWhoseHeightItDoesNotKnow) {
  Weighing weighing({{6.9, {0.06, -0.04, 0.2}}});
  weighing.turn(0.0, 5.0);
  weighing.weigh();
  EXPECT_EQ(weighing.mass(), 0.0);
  EXPECT_FALSE(weighing.calibration.knows_load());
  EXPECT_LT(weighing.error().head<2>().norm(), 1e-5) << "it stands over its COM all the same";
  Weighing shortly({{6.9, {0.06, -0.04, 0.2}}});
  shortly.turn(0.5, 0.6);
  EXPECT_FALSE(shortly.calibration.knows_load()) << "not yet";
  shortly.weigh();
  EXPECT_TRUE(shortly.calibration.knows_load());
  EXPECT_NEAR(shortly.mass(), 6.9, 1e-6);
  EXPECT_LT(std::abs(shortly.error().z()), 1.5 * kTooHigh) << "of what came afterwards";
}

TEST(ComCalibration, ListensForHalfASecondAtLeastToAQuietRobotAndOnlyToFeetThatCarry) {
  Weighing weighing(shifted_by({0.02, 0.0, 0.0}));
  weighing.run(0.4, CalibrationStage::weighing);
  weighing.run(1.0, CalibrationStage::settling);
  EXPECT_EQ(weighing.calibration.load().first_moment, Vec3::Zero());
  weighing.is_quiet = false;
  weighing.weigh();
  EXPECT_EQ(weighing.calibration.load().first_moment, Vec3::Zero());
  weighing.is_quiet = true;
  weighing.felt = 0.3;
  weighing.weigh();
  EXPECT_EQ(weighing.calibration.load().first_moment, Vec3::Zero());
  weighing.turn();
  weighing.felt = 1.0;
  weighing.weigh();
  EXPECT_EQ(weighing.mass(), 0.0) << "in the turn its feet did not carry";
  EXPECT_LT(weighing.error().norm(), 1e-6);
}

TEST(ComCalibration, BelievesNoOffsetBeyondTenCentimetresNoMonsterAndNoNumberThatIsNone) {
  Weighing weighing(shifted_by({0.3, 0.0, 0.0}));
  weighing.run(1.5, CalibrationStage::weighing);
  weighing.misread[2].x() = kNaN;
  weighing.run(0.5, CalibrationStage::weighing);
  weighing.run(1.0, CalibrationStage::settling);
  EXPECT_NEAR(weighing.error().norm(), 0.2, 1e-6);
  Weighing high(shifted_by({0.03, 0.02, 0.15}));
  high.turn();
  high.weigh();
  EXPECT_LT(high.error().head<2>().norm(), 1e-5) << "which does not cost what it knows";
  EXPECT_NEAR(high.error().z(), -0.05, 1e-6);
  const double base = weighing.robot.model.base_mass();
  Weighing monster({{40.0, {0.0, 0.0, 0.1}}});
  monster.turn();
  monster.weigh();
  EXPECT_NEAR(monster.mass(), base, 1e-6);
  Weighing feather({{-12.0, {0.0, 0.0, 0.0}}});
  feather.turn();
  feather.weigh();
  EXPECT_NEAR(feather.mass(), -0.5 * base, 1e-6);
}

// Forces have an error of half a percent.
TEST(ComCalibration, OfARobotThatIsHardlyHeavierMovesTheCenterOfMassAlongTheGroundAlone) {
  Weighing slightly(shifted_by({0.011, -0.007, 0.005}));
  slightly.felt = 0.995;
  slightly.turn();
  slightly.weigh();
  EXPECT_EQ(slightly.calibration.load().mass, 0.0);
  EXPECT_NEAR(slightly.calibration.load().first_moment.z(), 0.0, 1e-12);
  EXPECT_LT(slightly.error().head<2>().norm(), 1e-4);
  EXPECT_TRUE(slightly.calibration.knows_load());
  Weighing heavier({{0.02 * kModelMass, {0.0, 0.0, 0.1}}});
  heavier.turn();
  heavier.weigh();
  EXPECT_NEAR(heavier.mass(), 0.02 * kModelMass, 1e-6) << "but of one that is";
}

TEST(ComCalibration, MovesByWhatTheLinksAreFoundToWeigh) {
  LinkMassEstimator::Shares heavier(kNumLegJoints);
  heavier << 0.1, -0.15, 0.12, 0.0, 0.1, -0.1, 0.15, 0.15, 0.15, -0.1, 0.1, -0.05;
  Weighing weighing(shifted_by({0.011, -0.007, 0.0}));
  weighing.misread_by(heavier);
  weighing.weigh();
  const double wrong = weighing.error().norm();
  EXPECT_GT(wrong, 1e-3);
  weighing.calibration.correct(heavier);
  EXPECT_NEAR(weighing.error().norm(), wrong, 1e-12) << "not at once";
  weighing.run(0.01, CalibrationStage::none);
  EXPECT_GT(weighing.error().norm(), 0.9 * wrong) << "not at once";
  weighing.run(8.0, CalibrationStage::none);
  EXPECT_LT(weighing.error().norm(), 0.05 * wrong);
}

// The model has the load in use; a second weighing in another posture finds nothing more, and it
// stays, as do the links, for which it has begun already.
TEST(ComCalibration, WeighsAgainWithWhatItKnows) {
  const LinkMassEstimator::Shares heavier = LinkMassEstimator::Shares::Constant(kNumLegJoints, 0.1);
  Weighing weighing({{5.0, {0.08, -0.05, 0.1}}});
  weighing.misread_by(heavier);
  weighing.turn();
  weighing.weigh();
  weighing.calibration.correct(heavier);
  weighing.run(8.0, CalibrationStage::none);
  const BaseLoad known = weighing.calibration.load();
  weighing.turn();
  weighing.run(1.5, CalibrationStage::weighing);
  EXPECT_LT((weighing.calibration.load().first_moment - known.first_moment).norm(), 1e-9)
      << "while it lasts";
  weighing.tick(CalibrationStage::settling);
  EXPECT_LT((weighing.calibration.load().first_moment - known.first_moment).norm(), 1e-3)
      << "no jump";
  weighing.run(8.0, CalibrationStage::none);
  EXPECT_NEAR(weighing.mass(), known.mass, 1e-6);
  EXPECT_LT((weighing.calibration.load().first_moment - known.first_moment).norm(),
            kTooHigh * (kModelMass + known.mass));
}

TEST(ComCalibration, ForgetsAPayloadThatIsTakenOff) {
  Weighing weighing({{6.9, {0.06, -0.04, 0.2}}});
  weighing.turn();
  weighing.weigh();
  weighing.robot.carry({});
  weighing.robot.move_legs(0.2);
  weighing.turn();
  weighing.weigh();
  EXPECT_NEAR(weighing.mass(), 0.0, 1e-6);
  EXPECT_LT(weighing.error().head<2>().norm(), 1e-5);
  EXPECT_LT(std::abs(weighing.error().z()), kTooHigh);
}

}  // namespace
}  // namespace surefoot::estimation
