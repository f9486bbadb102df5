// A robot with six legs.
#include "tests/support/hexapod.hpp"

#include "surefoot/config/stack_file.hpp"
#include "surefoot/control/controller.hpp"
#include "surefoot/control/standing_torque.hpp"
#include "surefoot/control/task_stack.hpp"
#include "surefoot/estimation/leg_inertial_estimator.hpp"
#include "tests/support/malloc_counter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

namespace surefoot::control {
namespace {

using test::hexapod;

TEST(Hexapod, ItsSixFeetBearItsWeight) {
  const model::RobotDescription robot = hexapod();
  model::RobotModel model(robot);
  const JointVector torque = standing_torque(model, robot.q_nominal);
  ASSERT_EQ(torque.size(), 18);
  const Vec3 weight = model.mass() * kGravity * Vec3::UnitZ();
  EXPECT_LT((borne_force(model, robot.q_nominal, torque) - weight).norm(), 0.05 * weight.norm());
}

TEST(Hexapod, EveryLegHasRowsOfItsName) {
  const TaskStack stack(config::load_stack("walk"), hexapod());
  EXPECT_EQ(stack.hierarchy().unknowns(), 6 + 2 * 18);
  std::vector<std::string> names;
  for (const auto& of_level : stack.row_names())
    names.insert(names.end(), of_level.begin(), of_level.end());
  for (const char* name : {"LM x", "RH z", "RM normal force", "LM_KFE", "RH_HAA"})
    EXPECT_NE(std::ranges::find(names, name), names.end()) << name;
}

TEST(Hexapod, TheControllerCarriesItOnItsFeet) {
  const model::RobotDescription robot = hexapod();
  model::RobotModel model(robot);
  ControllerOptions options;
  options.stack = config::load_stack("walk");
  options.planner.gait.order = gaits::usual_order(robot.num_legs());
  options.planner.stance.height = -model.foot_in_base(Leg{0}, robot.q_nominal.head<3>()).z();
  Controller controller(robot, options,
                        std::make_unique<estimation::LegInertialEstimator>(
                            robot, estimation::LegInertialOptions{}, options.period));
  SensorReading reading;
  reading.q = robot.q_nominal;
  reading.torque = standing_torque(model, robot.q_nominal);
  reading.gyro.setZero();
  reading.accelerometer = Vec3(0.0, 0.0, kGravity);
  for (int tick = 0; tick < 40; ++tick) {
    reading.time = tick * options.period;
    reading.encoder_time = reading.torque_time = reading.imu_time = reading.time;
    const test::MallocCounter counter;
    reading.torque = controller.step(reading, {}).torque;
    ASSERT_EQ(counter.count(), 0U) << tick;
  }
  const TickRecord& record = controller.record();
  EXPECT_EQ(record.command.mode, CommandMode::optimal);
  EXPECT_EQ(record.command.torque.size(), 18);
  EXPECT_EQ(record.plan.num_contacts(), 6);
  ASSERT_EQ(record.model.force.size(), 6U);
  double borne = 0.0;
  for (const Vec3& force : record.model.force) {
    EXPECT_GT(force.z(), 10.0);
    borne += force.z();
  }
  EXPECT_NEAR(borne, model.mass() * kGravity, 0.1 * borne);
}

}  // namespace
}  // namespace surefoot::control
