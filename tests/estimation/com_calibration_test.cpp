#include "surefoot/estimation/com_calibration.hpp"

#include "surefoot/model/robot_model.hpp"
#include "tests/support/anymal_b.hpp"

#include <gtest/gtest.h>

namespace surefoot {
namespace {

constexpr double kPeriod = 0.0025;

/// A standing robot whose feet feel that it stands over another point than its model says.
struct Standing {
  Standing() : model(test::anymal_b()) {
    RobotState state;
    state.time = 0.0;
    state.p_WB = Vec3(0.3, -0.2, 0.5);
    state.q_WB = Quat(Eigen::AngleAxisd(0.7, Vec3::UnitZ()));
    state.v_WB.setZero();
    state.w_WB_B.setZero();
    state.q = model.description().q_nominal;
    state.qd.setZero();
    dynamics = model.update(state, Vec3::UnitZ());
  }

  /// Vertical forces whose centre of pressure lies `offset` in B from the model's COM.
  [[nodiscard]] PerLeg<Vec3> forces(const Vec2& offset) const {
    const Vec2 centre =
        dynamics.com.p.head<2>() + dynamics.base_rotation.R.topLeftCorner<2, 2>() * offset;
    Eigen::Matrix<double, 3, kNumLegs> A;
    for (int k = 0; k < kNumLegs; ++k) {
      A.col(k) << 1.0, dynamics.contact[static_cast<std::size_t>(k)].p.head<2>();
    }
    const Vec3 b = dynamics.mass * kGravity * Vec3(1.0, centre.x(), centre.y());
    const Eigen::Vector4d f = A.transpose() * (A * A.transpose()).ldlt().solve(b);
    PerLeg<Vec3> result;
    for (int k = 0; k < kNumLegs; ++k) result[static_cast<std::size_t>(k)] = f[k] * Vec3::UnitZ();
    return result;
  }

  RobotModel model;
  Dynamics dynamics;
};

void run(ComCalibration& calibration, const Standing& robot, const PerLeg<Vec3>& forces,
         double duration, bool listening) {
  for (double t = 0.0; t < duration; t += kPeriod) {
    calibration.update(robot.dynamics, forces, listening);
  }
}

TEST(ComCalibration, FindsWhereTheRobotStands) {
  const Standing robot;
  ComCalibration calibration(kPeriod);
  run(calibration, robot, robot.forces({0.02, -0.013}), 1.5, true);
  EXPECT_EQ(calibration.offset(), Vec3::Zero()) << "in use only when it has ended";
  run(calibration, robot, robot.forces({0.0, 0.0}), 0.25, false);
  EXPECT_GT(calibration.offset().norm(), 0.2 * 0.0239) << "little by little";
  EXPECT_LT(calibration.offset().norm(), 0.8 * 0.0239);
  run(calibration, robot, robot.forces({0.0, 0.0}), 0.5, false);
  EXPECT_LT((calibration.offset() - Vec3(0.02, -0.013, 0.0)).norm(), 1e-9);
}

TEST(ComCalibration, ListensForASecondAtLeastAndOnlyToFeetThatCarry) {
  const Standing robot;
  ComCalibration calibration(kPeriod);
  run(calibration, robot, robot.forces({0.02, 0.0}), 0.5, true);
  run(calibration, robot, robot.forces({0.0, 0.0}), 1.0, false);
  EXPECT_EQ(calibration.offset(), Vec3::Zero());
  PerLeg<Vec3> light = robot.forces({0.02, 0.0});
  for (Vec3& force : light) force *= 0.3;
  run(calibration, robot, light, 2.0, true);
  run(calibration, robot, light, 1.0, false);
  EXPECT_EQ(calibration.offset(), Vec3::Zero());
}

TEST(ComCalibration, BelievesNoOffsetBeyondTenCentimetresAndNoNumberThatIsNone) {
  const Standing robot;
  ComCalibration calibration(kPeriod);
  run(calibration, robot, robot.forces({0.3, 0.0}), 1.5, true);
  PerLeg<Vec3> broken = robot.forces({0.3, 0.0});
  broken[2].x() = kNaN;
  run(calibration, robot, broken, 0.5, true);
  run(calibration, robot, broken, 1.0, false);
  EXPECT_NEAR(calibration.offset().norm(), 0.1, 1e-9);
}

/// What the forces become of which the model takes links to be lighter than they are by `heavier`.
PerLeg<Vec3> misread(const Standing& robot, PerLeg<Vec3> forces,
                     const LinkMassEstimator::Shares& heavier) {
  for (const Leg leg : kLegs) {
    const std::size_t k = index(leg);
    const Vec3 weight =
        -robot.dynamics.links[k].free_rate * heavier.segment<kJointsPerLeg>(first_joint(leg));
    const Mat3 J = robot.dynamics.contact[k].J.middleCols<3>(6 + first_joint(leg));
    forces[k] -= J.transpose().inverse() * weight;
  }
  return forces;
}

TEST(ComCalibration, MovesByWhatTheLinksAreFoundToWeigh) {
  const Standing robot;
  LinkMassEstimator::Shares heavier;
  heavier << 0.1, -0.15, 0.12, 0.0, 0.1, -0.1, 0.15, 0.15, 0.15, -0.1, 0.1, -0.05;
  const Vec3 truth(0.011, -0.007, 0.0);
  const PerLeg<Vec3> felt = misread(robot, robot.forces(truth.head<2>()), heavier);
  ComCalibration calibration(kPeriod);
  run(calibration, robot, felt, 1.5, true);
  run(calibration, robot, felt, 2.0, false);
  const Vec3 wrong = calibration.offset();
  EXPECT_GT((wrong - truth).norm(), 1e-3);
  calibration.correct(heavier);
  EXPECT_EQ(calibration.offset(), wrong) << "not at once";
  run(calibration, robot, felt, 0.01, false);
  EXPECT_LT((calibration.offset() - wrong).norm(), 0.1 * (truth - wrong).norm()) << "not at once";
  run(calibration, robot, felt, 8.0, false);
  EXPECT_LT((calibration.offset() - truth).norm(), 0.05 * (wrong - truth).norm());
}

// The model has the offset in use; a second weighing finds nothing more, and it stays, as do the
// links, for which it has begun already.
TEST(ComCalibration, WeighsAgainWithLinksThatAreKnown) {
  const Standing robot;
  const LinkMassEstimator::Shares heavier = LinkMassEstimator::Shares::Constant(0.1);
  const Vec3 truth(0.011, -0.007, 0.0);
  const PerLeg<Vec3> felt = misread(robot, robot.forces(truth.head<2>()), heavier);
  ComCalibration calibration(kPeriod);
  run(calibration, robot, felt, 1.5, true);
  calibration.correct(heavier);
  run(calibration, robot, felt, 8.0, false);
  const Vec3 known = calibration.offset();
  Standing moved;  // the same robot; its model has the offset
  moved.dynamics.com.p += moved.dynamics.base_rotation.R * known;
  run(calibration, moved, felt, 1.5, true);
  EXPECT_LT((calibration.offset() - known).norm(), 1e-12) << "while it lasts";
  run(calibration, moved, felt, kPeriod, false);
  EXPECT_LT((calibration.offset() - known).norm(), 1e-4) << "no jump";
  run(calibration, moved, felt, 8.0, false);
  EXPECT_LT((calibration.offset() - truth).norm(), 1e-4);
}

}  // namespace
}  // namespace surefoot
