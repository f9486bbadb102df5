#include "tests/simulation/plant_support.hpp"
#include "tests/support/malloc_counter.hpp"
#include "tests/support/messages.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace surefoot::simulation {
namespace {

using test::holds;

PlantOptions noisy_options() {
  PlantOptions options;
  options.initial.q = test::anymal_b().q_nominal;
  options.actuators.model = ActuatorModel::sea;
  options.sensors.foot_force.present = true;
  return options;
}

/// Some lively command that depends on the readings.
JointCommand lively_command(const SensorReading& reading, const JointVector& q_nominal) {
  JointCommand command;
  for (Eigen::Index i = 0; i < kNumLegJoints; ++i) {
    const double target =
        q_nominal[i] + 0.1 * std::sin(9.0 * reading.time + static_cast<double>(i));
    command.torque[i] = 120.0 * (target - reading.q[i]) - 0.3 * reading.torque[i];
  }
  return command;
}

void expect_same_bits(const GroundTruth& a, const GroundTruth& b) {
  EXPECT_EQ(a.qpos, b.qpos);
  EXPECT_EQ(a.qvel, b.qvel);
  EXPECT_EQ(a.ctrl, b.ctrl);
  for (std::size_t leg = 0; leg < kNumLegs; ++leg) EXPECT_EQ(a.feet[leg].force, b.feet[leg].force);
}

void expect_same_bits(const SensorReading& a, const SensorReading& b) {
  EXPECT_EQ(a.time, b.time);
  EXPECT_EQ(a.q, b.q);
  EXPECT_EQ(a.torque, b.torque);
  EXPECT_EQ(a.gyro, b.gyro);
  EXPECT_EQ(a.accelerometer, b.accelerometer);
  EXPECT_EQ(a.foot_force, b.foot_force);
}

TEST(Plant, RunsOfTheSameSeedAreTheSameBits) {
  Plant first(test::anymal_b(), noisy_options());
  Plant second(test::anymal_b(), noisy_options());
  EXPECT_EQ(first.model_xml(), second.model_xml());
  for (int tick = 0; tick < 400; ++tick) {
    expect_same_bits(first.read(), second.read());
    expect_same_bits(first.truth(), second.truth());
    const JointCommand command = lively_command(first.read(), test::anymal_b().q_nominal);
    first.write(command);
    second.write(command);
  }
}

TEST(Plant, ASeedChangesTheReadingsButNotThePhysics) {
  PlantOptions options = noisy_options();
  Plant first(test::anymal_b(), options);
  options.seed = 2;
  Plant second(test::anymal_b(), options);
  for (int tick = 0; tick < 20; ++tick) {
    EXPECT_NE(first.read().gyro, second.read().gyro);
    EXPECT_NE(first.read().torque, second.read().torque);
    const JointCommand command = lively_command(first.read(), test::anymal_b().q_nominal);
    first.write(command);
    second.write(command);
    expect_same_bits(first.truth(), second.truth());
  }
}

TEST(Plant, ReadingTwiceGivesTheSame) {
  Plant plant(test::anymal_b(), noisy_options());
  plant.write({});
  const SensorReading first = plant.read();
  expect_same_bits(first, plant.read());
}

TEST(Plant, AWriteAdvancesTimeByOneControlPeriod) {
  PlantOptions options = test::standing_options();
  options.control_period = 0.004;
  Plant plant(test::anymal_b(), options);
  EXPECT_EQ(plant.time(), 0.0);
  EXPECT_EQ(plant.read().time, 0.0);
  for (int tick = 1; tick <= 100; ++tick) plant.write({});
  EXPECT_NEAR(plant.time(), 0.4, 1e-12);
  EXPECT_EQ(plant.read().time, plant.time());
  EXPECT_EQ(plant.truth().time, plant.time());
}

TEST(Plant, AllocatesNothingAfterItsConstruction) {
  PlantOptions options = noisy_options();
  options.disturbances.pushes = {{"", 0.2, 0.1, Vec3(0.0, 60.0, 0.0)}};
  Plant plant(test::anymal_b(), options);
  const test::MallocCounter counter;
  for (int tick = 0; tick < 400; ++tick) plant.write({});  // falls: contacts come and go
  EXPECT_EQ(counter.count(), 0U);
  EXPECT_TRUE(plant.truth().torso_contact);
}

TEST(Plant, AppliesSeaTorquesWithDelayAndLag) {
  PlantOptions options = test::falling_options();
  options.actuators.model = ActuatorModel::sea;
  options.actuators.quantisation = 0.0;
  options.actuators.no_load_speed.setConstant(1e6);
  Plant plant(test::anymal_b(), options);
  JointCommand command;
  command.torque.setConstant(1.0);
  plant.write(command);
  EXPECT_EQ(plant.truth().torque.norm(), 0.0);
  for (int tick = 1; tick <= 3; ++tick) {
    plant.write(command);
    const double lag = std::exp(-2.0 * kPi * 70.0 * tick * options.control_period);
    EXPECT_NEAR(plant.truth().torque[8], 1.0 - lag, 1e-4) << tick;
  }
  EXPECT_EQ(plant.read().torque, plant.truth().torque);
}

TEST(Plant, AFreeFallFollowsGravity) {
  Plant plant(test::anymal_b(), test::falling_options());
  const Vec3 start = plant.truth().p_SCom;
  for (int tick = 0; tick < 200; ++tick) plant.write({});
  const double time = plant.time();
  EXPECT_NEAR(plant.truth().v_SCom.z(), -kGravity * time, 1e-6);
  EXPECT_NEAR(plant.truth().p_SCom.z() - start.z(), -0.5 * kGravity * time * time, 2e-3);
}

TEST(Plant, TakesNoTorqueForOneThatIsNotANumberAndSaysSo) {
  Plant plant(test::anymal_b(), test::falling_options());
  JointCommand command;
  command.torque.setConstant(1.0);
  command.torque[3] = kNaN;
  command.torque[5] = std::numeric_limits<double>::infinity();
  const std::size_t notes = plant.notes().size();
  plant.write(command);
  EXPECT_EQ(plant.truth().torque[3], 0.0);
  EXPECT_EQ(plant.truth().torque[5], 0.0);
  EXPECT_EQ(plant.truth().torque[4], 1.0);
  EXPECT_EQ(plant.notes().size(), notes + 2);
  EXPECT_TRUE(plant.truth().p_SB.allFinite());
}

TEST(Plant, SaysThatItDivergedInsteadOfGoingOn) {
  PlantOptions options = test::standing_options();
  options.disturbances.pushes = {{"LF_SHANK", 0.0, 1.0, Vec3(0.0, 0.0, 1e13)}};
  Plant plant(test::anymal_b(), options);
  const auto run = [&plant] {
    for (int tick = 0; tick < 400; ++tick) plant.write({});
  };
  EXPECT_THROW(run(), Error);
}

TEST(Plant, PrintsNothing) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  {
    Plant plant(test::anymal_b(), noisy_options());
    for (int tick = 0; tick < 800; ++tick) plant.write({});
  }
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

/// Ground forces on the feet as stock MuJoCo computes them from the logged model and state.
PerLeg<Vec3> recomputed_forces(const test::StockMujoco& mujoco) {
  PerLeg<Vec3> forces{Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  for (const Leg leg : kLegs) {
    const int foot = mujoco.body(std::string(kLegNames[index(leg)]) + "_FOOT");
    for (int i = 0; i < mujoco.data->ncon; ++i) {
      const mjContact& contact = mujoco.data->contact[i];
      for (const int side : {0, 1}) {
        if (mujoco.model->geom_bodyid[contact.geom[side]] != foot) continue;
        std::array<double, 6> force{};
        mj_contactForce(mujoco.model.get(), mujoco.data.get(), i, force.data());
        const Eigen::Map<const Mat3> axes(contact.frame);
        forces[index(leg)] +=
            (side == 1 ? 1.0 : -1.0) * axes * Eigen::Map<const Vec3>(force.data());
      }
    }
  }
  return forces;
}

TerrainRandomBoxes some_boxes() {
  TerrainRandomBoxes boxes;
  boxes.max_height = 0.03;
  return boxes;
}

TerrainHeightField some_field() {
  TerrainHeightField field;
  field.size_x = field.size_y = 3.0;
  field.amplitude = 0.02;
  return field;
}

class LoggedModel : public testing::TestWithParam<TerrainElement> {};

TEST_P(LoggedModel, GivesStockMujocoTheSameMassesCenterOfMassAndContactForces) {
  PlantOptions options = test::standing_options();
  options.terrain.elements = {GetParam()};
  options.disturbances.payload.mass = 2.0;
  options.disturbances.pushes = {{"", 0.0, 5.0, Vec3(10.0, 20.0, 0.0)}};
  test::HeldRobot robot(options);
  double largest = 0.0;
  for (int tick = 0; tick < 200; ++tick) {
    robot.tick();
    if (tick % 20 != 0) continue;
    const test::StockMujoco mujoco(robot.plant.model_xml(), robot.truth());
    EXPECT_NEAR(mj_getTotalmass(mujoco.model.get()), test::kMass + 2.0, 1e-9);
    const int base = mujoco.body("base");
    const Vec3 com = Eigen::Map<const Vec3>(mujoco.data->subtree_com + 3 * base);
    EXPECT_LT((com - robot.truth().p_SCom).norm(), 1e-9);
    const PerLeg<Vec3> forces = recomputed_forces(mujoco);
    for (std::size_t leg = 0; leg < kNumLegs; ++leg) {
      EXPECT_LT((forces[leg] - robot.truth().feet[leg].force).norm(), 0.05);
      largest = std::max(largest, forces[leg].norm());
    }
  }
  EXPECT_GT(largest, 50.0);
}

INSTANTIATE_TEST_SUITE_P(OnTerrain, LoggedModel,
                         testing::Values(TerrainElement(TerrainLevel{}),
                                         TerrainElement(some_boxes()),
                                         TerrainElement(some_field())));

TEST(LoggedModel, NeedsNoFileBesideIt) {
  PlantOptions options = test::standing_options();
  options.terrain.elements = {some_field()};
  const std::string xml = Plant(test::anymal_b(), options).model_xml();
  EXPECT_FALSE(holds(xml, "file="));
  EXPECT_FALSE(holds(xml, "meshdir"));
}

}  // namespace
}  // namespace surefoot::simulation
