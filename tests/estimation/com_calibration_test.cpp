#include "surefoot/estimation/com_calibration.hpp"

#include "surefoot/planning/calibration_motion.hpp"
#include "tests/support/laden_robot.hpp"

#include <gtest/gtest.h>

namespace surefoot {
namespace {

using test::kPeriod;
using test::LadenRobot;

/// A calibration and the robot that it is about; every tick the model has the load in use.
struct Weighing {
  explicit Weighing(const BaseLoad& truth) : robot(truth) {}

  void run(double duration, CalibrationStage stage) {
    for (double t = 0.0; t < duration; t += kPeriod) tick(stage);
  }

  void tick(CalibrationStage stage) {
    robot.model.set_base_load(calibration.load());
    robot.update();
    PerLeg<Vec3> forces = robot.forces();
    for (std::size_t k = 0; k < kNumLegs; ++k) forces[k] = forces[k] * felt + misread[k];
    calibration.update(robot.believed(), forces, stage);
  }

  void turn() {
    const CalibrationOptions options{.duration = 6.0};
    const CalibrationMotion motion(options);
    for (double t = 0.0; t < options.settle + options.duration; t += kPeriod) {
      robot.turn(motion, t);
      tick(motion.stage(t));
    }
    robot.stand();
  }

  void weigh() {
    run(1.5, CalibrationStage::weighing);
    run(1.0, CalibrationStage::settling);
  }

  /// What the forces become of which the model takes links to be lighter than they are.
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
           (robot.believed().com.p - robot.actual().com.p);
  }

  LadenRobot robot;
  ComCalibration calibration{kPeriod};
  double felt = 1.0;
  PerLeg<Vec3> misread{Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
};

constexpr double kMass = 30.4754;  // of the model [kg]

/// That moves the COM by an offset in B [m].
BaseLoad shifted_by(const Vec3& offset) { return {.mass = 0.0, .moment = kMass * offset}; }

BaseLoad payload(double mass, const Vec3& at) { return {.mass = mass, .moment = mass * at}; }

TEST(ComCalibration, FindsWhereTheRobotStands) {
  Weighing weighing(shifted_by({0.02, -0.013, 0.0}));
  weighing.run(1.5, CalibrationStage::weighing);
  EXPECT_EQ(weighing.calibration.load().moment, Vec3::Zero()) << "in use only when it has ended";
  weighing.run(0.25, CalibrationStage::settling);
  EXPECT_GT(weighing.error().norm(), 0.2 * 0.0239) << "little by little";
  EXPECT_LT(weighing.error().norm(), 0.8 * 0.0239);
  weighing.run(0.5, CalibrationStage::settling);
  EXPECT_LT(weighing.error().norm(), 1e-9);
}

TEST(ComCalibration, FindsWhatAPayloadWeighsAndHowHighItLies) {
  Weighing weighing(payload(6.9, {0.06, -0.04, 0.2}));
  const double higher = weighing.error().norm();
  EXPECT_GT(higher, 0.03);
  weighing.turn();
  EXPECT_EQ(weighing.calibration.load().mass, 0.0) << "in use only when it is weighed";
  weighing.weigh();
  EXPECT_NEAR(weighing.calibration.load().mass, 6.9, 1e-6);
  EXPECT_LT(weighing.error().head<2>().norm(), 1e-5);
  EXPECT_LT(std::abs(weighing.error().z()), 0.006) << "of 40 mm; it has an inertia of its own";
}

TEST(ComCalibration, KnowsWhereTheComIsWhenLegsMoveUnderAPayload) {
  Weighing weighing(payload(6.9, {0.0, 0.0, 0.05}));
  weighing.weigh();
  weighing.robot.move_legs(0.5);
  EXPECT_GT((weighing.robot.believed().com.p - weighing.robot.believed().base.p).norm(), 0.0);
  EXPECT_LT(weighing.error().head<2>().norm(), 1e-6);
  weighing.robot.model.set_base_load(shifted_by({0.0, 0.0, 0.0}));
  weighing.robot.update();
  const Vec2 unladen = (weighing.robot.believed().com.p - weighing.robot.actual().com.p).head<2>();
  EXPECT_GT(unladen.norm(), 0.003) << "the same posture, by the model alone";
}

TEST(ComCalibration, FindsNothingOnARobotThatIsAsModelled) {
  Weighing weighing(BaseLoad{});
  weighing.turn();
  weighing.weigh();
  EXPECT_LT(std::abs(weighing.calibration.load().mass), 1e-9);
  EXPECT_LT(weighing.error().norm(), 0.002);
}

TEST(ComCalibration, ListensForASecondAtLeastAndOnlyToFeetThatCarry) {
  Weighing weighing(shifted_by({0.02, 0.0, 0.0}));
  weighing.run(0.5, CalibrationStage::weighing);
  weighing.run(1.0, CalibrationStage::settling);
  EXPECT_EQ(weighing.calibration.load().moment, Vec3::Zero());
  weighing.felt = 0.3;
  weighing.turn();
  weighing.weigh();
  EXPECT_EQ(weighing.calibration.load().moment, Vec3::Zero());
}

TEST(ComCalibration, BelievesNoOffsetBeyondTenCentimetresNoMonsterAndNoNumberThatIsNone) {
  Weighing weighing(shifted_by({0.3, 0.0, 0.0}));
  weighing.run(1.5, CalibrationStage::weighing);
  weighing.misread[2].x() = kNaN;
  weighing.run(0.5, CalibrationStage::weighing);
  weighing.turn();
  weighing.misread[2].x() = 0.0;
  weighing.run(1.0, CalibrationStage::settling);
  EXPECT_NEAR(weighing.error().norm(), 0.2, 1e-6);
  Weighing monster(payload(40.0, {0.0, 0.0, 0.0}));
  monster.weigh();
  EXPECT_NEAR(monster.calibration.load().mass, 0.6 * kMass, 1e-3);
}

TEST(ComCalibration, MovesByWhatTheLinksAreFoundToWeigh) {
  LinkMassEstimator::Shares heavier;
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

// The model has the load in use; a second weighing finds nothing more, and it stays, as do the
// links, for which it has begun already.
TEST(ComCalibration, WeighsAgainWithLinksThatAreKnown) {
  const LinkMassEstimator::Shares heavier = LinkMassEstimator::Shares::Constant(0.1);
  Weighing weighing(payload(5.0, {0.08, -0.05, 0.1}));
  weighing.misread_by(heavier);
  weighing.weigh();
  weighing.calibration.correct(heavier);
  weighing.run(8.0, CalibrationStage::none);
  const Vec3 known = weighing.error();
  weighing.run(1.5, CalibrationStage::weighing);
  EXPECT_LT((weighing.error() - known).norm(), 1e-12) << "while it lasts";
  weighing.tick(CalibrationStage::settling);
  EXPECT_LT((weighing.error() - known).norm(), 1e-4) << "no jump";
  weighing.run(8.0, CalibrationStage::none);
  EXPECT_LT((weighing.error() - known).norm(), 1e-3);
}

}  // namespace
}  // namespace surefoot
