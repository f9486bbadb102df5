// The controller's model of every robot that ships, and MuJoCo's of the same file.
#include "surefoot/config/data_file.hpp"
#include "surefoot/config/robot_file.hpp"
#include "surefoot/simulation/model_agreement.hpp"
#include "tests/support/messages.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace surefoot::config {
namespace {

std::vector<std::string> robots() { return list_data("robots"); }

class ShippedRobot : public testing::TestWithParam<std::string> {};

TEST_P(ShippedRobot, is_the_same_in_both_models) {
  for (const std::string& line : simulation::disagreements(load_robot(GetParam()), 100))
    ADD_FAILURE() << line;
}

INSTANTIATE_TEST_SUITE_P(Each, ShippedRobot, testing::ValuesIn(robots()),
                         [](const auto& robot) { return robot.param; });

/// Else the agreement would only be with a URDF of our own writing.
TEST(RobotsInBothModels, are_read_by_MuJoCo_itself) {
  for (const char* name : {"anymal_b", "a1", "go2", "g1", "hexapod", "laikago", "aliengo"})
    EXPECT_TRUE(simulation::is_read_by_mujoco(load_robot(name))) << name;
}

/// What is changed in the model alone, and what is said of it.
struct Change {
  const char *name, *from, *to, *message;
};
class ChangedModel : public testing::TestWithParam<Change> {};

TEST_P(ChangedModel, is_told_from_the_physics_by_the_part_that_differs) {
  model::RobotDescription robot = load_robot("aliengo");
  const std::size_t place = robot.urdf_text.find(GetParam().from);
  ASSERT_NE(place, std::string::npos);
  robot.urdf_text.replace(place, std::string(GetParam().from).size(), GetParam().to);
  const std::vector<std::string> lines = simulation::disagreements(robot, 3);
  ASSERT_FALSE(lines.empty());
  EXPECT_TRUE(test::holds(lines.front(), GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(
    Each, ChangedModel,
    testing::Values(Change{"Mass", "<mass value=\"0.26700000000000002\"/>",
                           "<mass value=\"0.2670000003\"/>",
                           "link \"FL_calf\": its mass is 0.2670000003, but MuJoCo has 0.267"},
                    Change{"Place", "xyz=\"0 0 -0.25\"", "xyz=\"0 0 -0.25000001\"",
                           "joint \"FL_calf_joint\": its place is"},
                    Change{"Axis", "<axis xyz=\"0 1 0\"/>", "<axis xyz=\"0 -1 0\"/>",
                           "joint \"FL_thigh_joint\": its axis is"}),
    [](const auto& change) { return std::string(change.param.name); });

}  // namespace
}  // namespace surefoot::config
