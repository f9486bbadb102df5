// What is a fall, and what is none.
#include "tests/evaluation/hand_made_run.hpp"
#include "tests/support/messages.hpp"

namespace surefoot::evaluation {
namespace {

using test::HandMadeRun;
using test::holds;

TEST(Evaluator, BodyContactsAreCountedWhenTheyBegin) {
  HandMadeRun run;
  for (const int mask : {0, 0b0010, 0b0010, 0b0110, 0b0100, 0b0000, 0b0001}) {
    run.truth.shank_contacts = mask;
    run.step();
  }
  EXPECT_EQ(run.metrics().shank_contacts, 3);
  EXPECT_EQ(run.metrics().torso_contacts, 0);
  EXPECT_FALSE(run.metrics().fell) << "a scraping shin is no fall";
}

TEST(Evaluator, TheTorsoOnTheGroundIsAFall) {
  HandMadeRun run;
  run.steps(400);
  run.truth.torso_contact = true;
  run.step();
  run.truth.torso_contact = false;
  run.steps(10);
  EXPECT_TRUE(run.evaluator.fell());
  EXPECT_TRUE(run.metrics().fell);
  EXPECT_EQ(run.metrics().torso_contacts, 1);
  EXPECT_EQ(run.metrics().reason, "fell at 1.0000 s: the torso touched the ground");
}

TEST(Evaluator, ALiftedRobotHasNotFallenNorOneThatGetsUp) {
  HandMadeRun run;
  run.step();
  run.tick.command.mode = CommandMode::lifted;
  run.truth.q_SB = Quat(Eigen::AngleAxisd(1.2, Vec3::UnitX()));
  run.truth.torque[3] = -7.0;
  run.steps(400);
  run.truth.q_SB.setIdentity();
  run.tick.command.mode = CommandMode::rise;
  run.truth.torso_contact = true;
  run.truth.p_SB.z() = 0.1;
  run.truth.torque[3] = 22.0;
  run.steps(200);
  const Metrics metrics = run.metrics();
  EXPECT_FALSE(metrics.fell) << run.evaluator.fall();
  EXPECT_NEAR(metrics.lifted_s, 1.0, 1e-9);
  EXPECT_NEAR(metrics.standing_up_s, 0.5, 1e-9);
  EXPECT_EQ(metrics.torque_lifted_max_nm, 7.0);
  EXPECT_EQ(metrics.torque_standing_up_max_nm, 22.0);
  run.tick.command.mode = CommandMode::optimal;
  run.step();
  EXPECT_TRUE(run.evaluator.fell());
}

TEST(Evaluator, WhoseTorsoIsOnTheGroundHasFallenThoughItSeemsLifted) {
  HandMadeRun run;
  run.step();
  run.tick.command.mode = CommandMode::lifted;
  run.step();
  EXPECT_FALSE(run.evaluator.fell());
  run.truth.torso_contact = true;
  run.step();
  EXPECT_TRUE(run.evaluator.fell());
}

TEST(Evaluator, ALowBaseIsAFallAndACrouchIsNot) {
  HandMadeRun run;
  for (Vec3& p_SF : run.truth.p_SF) p_SF.z() = -0.14 + 0.031;
  run.truth.p_SF[index(Leg::LF)].z() = 0.36;  // swings high: those that stand count
  run.contact(Leg::LF).touching = false;
  run.truth.p_SB.z() = -0.14 + 0.031 + 0.125;
  run.step();
  EXPECT_FALSE(run.evaluator.fell());
  run.truth.p_SB.z() -= 0.01;
  run.step();
  EXPECT_TRUE(run.evaluator.fell());
}

TEST(Evaluator, AFallIsToldByTheHipsWhereverTheBasesOriginIs) {
  for (const double hips : {-0.08, 0.05}) {
    EvaluatorOptions options;
    options.scale.hip_height = hips;
    HandMadeRun run(options);
    run.truth.p_SB.z() = run.truth.p_SF[0].z() + 0.125 - hips;
    run.step();
    EXPECT_FALSE(run.evaluator.fell()) << hips;
    run.truth.p_SB.z() -= 0.01;
    run.step();
    EXPECT_TRUE(run.evaluator.fell()) << hips;
  }
}

TEST(Evaluator, ATiltBeyondSixtyDegreesIsAFallAndYawIsNoTilt) {
  HandMadeRun run;
  const auto turn = [&](double angle, const Vec3& axis) {
    run.truth.q_SB = Quat(Eigen::AngleAxisd(angle, axis));
    run.step();
    return run.evaluator.fell();
  };
  EXPECT_FALSE(turn(3.0, Vec3::UnitZ()));
  EXPECT_NEAR(run.metrics().max_tilt_rad, 0.0, 1e-7);
  EXPECT_FALSE(turn(59.0 * kPi / 180.0, Vec3(0.6, 0.8, 0.0)));
  EXPECT_TRUE(turn(61.0 * kPi / 180.0, Vec3(0.6, 0.8, 0.0)));
  EXPECT_TRUE(holds(run.evaluator.fall(), "60°"));
}

}  // namespace
}  // namespace surefoot::evaluation
