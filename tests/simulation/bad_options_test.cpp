#include "tests/simulation/plant_support.hpp"
#include "tests/support/changed_urdf.hpp"
#include "tests/support/messages.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

namespace surefoot::simulation {
namespace {

using test::ChangedUrdf;
using test::holds;

constexpr double kInf = std::numeric_limits<double>::infinity();

struct BadOption {
  std::string test_name;
  std::function<void(PlantOptions&)> spoil;
  std::string message;  ///< has to be in the error: the option, what was given, what would be valid
};

class Options : public testing::TestWithParam<BadOption> {};

TEST_P(Options, ThatMakeNoSenseAreNamedInTheError) {
  PlantOptions options = test::standing_options();
  GetParam().spoil(options);
  EXPECT_TRUE(holds(test::error_of(test::anymal_b(), options), GetParam().message))
      << "the message is: " << test::error_of(test::anymal_b(), options);
}

template <typename Element>
void set_element(PlantOptions& options, const Element& element) {
  options.terrain.elements = {TerrainLevel{}, element};
}

TerrainHeightField height_field(int columns, int rows, const std::vector<double>& heights) {
  TerrainHeightField field;
  field.columns = columns;
  field.rows = rows;
  field.heights = heights;
  return field;
}

INSTANTIATE_TEST_SUITE_P(
    Wrong, Options,
    testing::Values(
        BadOption{"timestep", [](auto& o) { o.timestep = -0.001; },
                  "timestep is -0.001; it must be a finite number above 0"},
        BadOption{"timestep_nan", [](auto& o) { o.timestep = kNaN; }, "timestep is nan"},
        BadOption{
            "period_multiple", [](auto& o) { o.control_period = 0.0023; },
            "control_period is 0.0023; it must be a whole multiple of the timestep, 0.0005 s"},
        BadOption{"box_size",
                  [](auto& o) { set_element(o, TerrainBox{Vec3::Zero(), Vec3(1.0, -2.0, 1.0)}); },
                  "terrain.elements[1].size[1] is -2"},
        BadOption{"box_position", [](auto& o) { set_element(o, TerrainBox{Vec3(0.0, 0.0, kNaN)}); },
                  "terrain.elements[1].position[2] is nan; it must be a finite number"},
        BadOption{"field_heights", [](auto& o) { set_element(o, height_field(3, 2, {1.0, 2.0})); },
                  "terrain.elements[1].heights has 2 numbers; rows × columns is 2 × 3 = 6"},
        BadOption{"field_points", [](auto& o) { set_element(o, height_field(1, 5, {})); },
                  "terrain.elements[1].columns is 1; it must be at least 2"},
        BadOption{"field_nan",
                  [](auto& o) { set_element(o, height_field(2, 2, {0.0, 0.0, kNaN, 0.0})); },
                  "terrain.elements[1].heights[2] is nan"},
        BadOption{"boxes_cell", [](auto& o) { set_element(o, TerrainRandomBoxes{.cell = 0.001}); },
                  "terrain.elements[1].cell is 0.001; it must be large enough"},
        BadOption{"solref", [](auto& o) { o.contact.solref_time = 0.0005; },
                  "contact.solref_time is 0.0005; it must be at least two timesteps, 0.001 s"},
        BadOption{"delay", [](auto& o) { o.actuators.delay_ticks = -1; },
                  "actuators.delay_ticks is -1; it must be between 0 and 1000"},
        BadOption{"level", [](auto& o) { o.actuators.level = 3; },
                  "actuators.level is 3; it must be 1 or 2"},
        BadOption{"joint_gain", [](auto& o) { o.actuators.joint_torque_gain[4] = 0.0; },
                  "actuators.joint_torque_gain[4] is 0"},
        BadOption{"imu_delay", [](auto& o) { o.sensors.imu.delay_ticks = 1001; },
                  "sensors.imu.delay_ticks is 1001; it must be between 0 and 1000"},
        BadOption{"fault_late",
                  [](auto& o) { o.sensors.faults = {{.kind = FaultKind::late, .size = 2.5}}; },
                  "sensors.faults[0].size is 2.5; it must be a whole number of ticks"},
        BadOption{"fault_joint", [](auto& o) { o.sensors.faults = {{}, {.joint = 12}}; },
                  "sensors.faults[1].joint is 12"},
        BadOption{"shank_length", [](auto& o) { o.disturbances.shank_length_offset[3] = 0.2; },
                  "disturbances.shank_length_offset[3] is 0.2; it must be between -0.1 and 0.1 m"},
        BadOption{"encoder_noise", [](auto& o) { o.sensors.encoders.noise = -0.1; },
                  "sensors.encoders.noise is -0.1; it must be 0 or a finite number above"},
        BadOption{"encoder_rate", [](auto& o) { o.sensors.encoders.rate_hz = 0.0; },
                  "sensors.encoders.rate_hz is 0; it must be a finite number above 0"},
        BadOption{"foot_fault", [](auto& o) { o.sensors.faults = {{.leg = 4}}; },
                  "sensors.faults[0].leg is 4; it must be between 0 and 3, or -1 for all"},
        BadOption{"fault_of_no_joint", [](auto& o) { o.sensors.faults = {{.joint = 4}}; },
                  "sensors.faults[0].joint is 4; it must be -1"},
        BadOption{"fault_of_no_leg", [](auto& o) { o.sensors.faults = {{.leg = 2}}; },
                  "sensors.faults[0].leg is 2; it must be -1"},
        BadOption{"fault_of_no_sensor",
                  [](auto& o) { o.sensors.faults = {{.sensor = FaultySensor::foot_force}}; },
                  "sensors.faults[0].sensor is foot_force; the robot has none"},
        BadOption{"push_body",
                  [](auto& o) { o.disturbances.pushes = {{}, {"LF_SHNK", 0.0, 0.1, {}}}; },
                  "disturbances.pushes[1].body is \"LF_SHNK\"; the robot has: base base_inertia "
                  "LF_HIP LF_THIGH LF_SHANK"},
        BadOption{"push_world", [](auto& o) { o.disturbances.pushes = {{"world", 0.0, 0.1, {}}}; },
                  "disturbances.pushes[0].body is \"world\""},
        BadOption{"push_duration", [](auto& o) { o.disturbances.pushes = {{"", 0.0, -0.1, {}}}; },
                  "disturbances.pushes[0].duration is -0.1; it must be a finite number above 0"},
        BadOption{"push_force",
                  [](auto& o) { o.disturbances.pushes = {{"", 0.0, 0.1, Vec3(0.0, kNaN, 0.0)}}; },
                  "disturbances.pushes[0].force[1] is nan"},
        BadOption{"lift_hold", [](auto& o) { o.disturbances.lifts = {{}, {.hold = -1.0}}; },
                  "disturbances.lifts[1].hold is -1; it must be 0 or a finite number above"},
        BadOption{"payload", [](auto& o) { o.disturbances.payload.mass = -2.0; },
                  "disturbances.payload.mass is -2; it must be between 0 and 200 kg"},
        BadOption{"feather", [](auto& o) { o.disturbances.base_mass_scale = 0.01; },
                  "disturbances.base_mass_scale is 0.01; it must be between 0.1 and 10"},
        BadOption{"no_ground",
                  [](auto& o) { o.terrain.elements = {TerrainBox{Vec3(9.0, 0.0, 0.0)}}; },
                  "no foot is above terrain"}),
    [](const auto& given) { return given.param.test_name; });

TEST(Options, OfTheDefaultAreValid) { EXPECT_EQ(test::error_of(test::anymal_b(), {}), ""); }

TEST(RobotDescription, WithAMissingUrdfIsAnErrorThatNamesTheFile) {
  model::RobotDescription robot = test::anymal_b();
  robot.urdf_path = "/nowhere/robot.urdf";
  EXPECT_EQ(test::error_of(robot, {}),
            "/nowhere/robot.urdf: the URDF can't be read; does the file exist?");
}

TEST(RobotDescription, WithAnUnknownNameIsAnErrorThatListsWhatThereIs) {
  model::RobotDescription robot = test::anymal_b();
  robot.legs[2].foot_frame = "LH_FOT";
  EXPECT_TRUE(
      holds(test::error_of(robot, {}), "unknown foot frame \"LH_FOT\"; the robot has: base"));
  robot = test::anymal_b();
  robot.legs[0].joints[1] = "LF_HEF";
  EXPECT_TRUE(holds(test::error_of(robot, {}), "unknown joint \"LF_HEF\"; the robot has: LF_HAA"));
  robot = test::anymal_b();
  robot.base_link = "torso";
  EXPECT_TRUE(holds(test::error_of(robot, {}), "unknown base link \"torso\""));
}

TEST(RobotDescription, ThatContradictsTheFootSphereOfTheUrdfIsAnError) {
  model::RobotDescription robot = test::anymal_b();
  robot.legs[0].foot_radius = 0.025;
  EXPECT_TRUE(holds(test::error_of(robot, {}), "the foot sphere of LF has radius 0.031 m"));
}

TEST(Urdf, WithAHeavyBaseThatHasNoProperInertiaLosesNoMass) {
  const ChangedUrdf urdf("<mass value=\"1e-6\"/>", "<mass value=\"5\"/>");
  const Plant plant(urdf.robot(), test::falling_options());
  const test::StockMujoco stock(plant.model_xml(), plant.truth());
  EXPECT_NEAR(mj_getTotalmass(stock.model.get()), test::kMass + 5.0, 1e-6);
  ASSERT_EQ(plant.notes().size(), 1U);
  EXPECT_TRUE(holds(plant.notes()[0], "no body can have the inertia of: base"));
}

TEST(Urdf, ThatIsSomethingElseIsAnErrorThatSaysSo) {
  ChangedUrdf urdf("<robot", "<rabbit");
  urdf.change("</robot", "</rabbit");
  EXPECT_TRUE(holds(test::error_of(urdf.robot(), {}), "the file has no <robot>"));
}

}  // namespace
}  // namespace surefoot::simulation
