// A robot with six legs.
#include "tests/support/hexapod.hpp"

#include "surefoot/config/stack_file.hpp"
#include "surefoot/control/standing_torque.hpp"
#include "surefoot/control/task_stack.hpp"

#include <gtest/gtest.h>

#include <algorithm>

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

}  // namespace
}  // namespace surefoot::control
