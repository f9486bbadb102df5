// What `surefoot doctor` tells its caller.
#include "cli/doctor_command.hpp"

#include "cli/exit_code.hpp"
#include "surefoot/config/data_file.hpp"
#include "surefoot/doctor/robot_file_text.hpp"
#include "tests/doctor/changed_robot.hpp"
#include "tests/support/messages.hpp"

#include <nlohmann/json.hpp>

namespace surefoot::cli {
namespace {

class DoctorCommand : public test::ChangedRobot {
 protected:
  int run() {
    test::write_file(folder_ / "robot.urdf", urdf_);
    arguments_.urdf = folder_ / "robot.urdf";
    testing::internal::CaptureStdout();
    const int code = doctor_command(arguments_);
    printed_ = testing::internal::GetCapturedStdout();
    return code;
  }

  DoctorArguments arguments_;
  std::string printed_;
};

TEST_F(DoctorCommand, passes_a_sound_robot_and_writes_its_file) {
  arguments_.out = folder_ / "robot.yaml";
  arguments_.name = "rex";
  EXPECT_EQ(run(), kPassed);
  EXPECT_EQ(config::load_robot(arguments_.out).name, "rex");
  EXPECT_TRUE(test::holds(printed_, "rex: "));
}

TEST_F(DoctorCommand, tells_an_error_by_its_exit_code_and_as_data) {
  change("<joint name=\"RH_KFE\"", "<axis xyz=\"0 1 0\"", "<axis xyz=\"0 -1 0\"");
  arguments_.json = true;
  EXPECT_EQ(run(), kWrongInput);
  EXPECT_EQ(nlohmann::json::parse(printed_)["findings"][0]["severity"], "error");
}

TEST_F(DoctorCommand, writes_no_file_of_a_robot_without_legs) {
  change("<joint name=\"RH_HAA\"", "type=\"revolute\"", "type=\"fixed\"");
  arguments_.out = folder_ / "robot.yaml";
  EXPECT_EQ(run(), kWrongInput);
  EXPECT_FALSE(std::filesystem::exists(arguments_.out));
}

TEST_F(DoctorCommand, refuses_what_is_no_urdf) {
  urdf_ = "<sdf/>";
  EXPECT_TRUE(test::holds(test::message_of([&] { (void)run(); }), "not a URDF"));
  (void)testing::internal::GetCapturedStdout();
}

TEST_F(DoctorCommand, takes_the_numbers_of_a_robot_file) {
  test::write_file(folder_ / "robot.urdf", urdf_);
  const std::string file = folder_ / "robot.yaml";
  test::write_file(
      file,
      "name: rex\nurdf: robot.urdf\nlegs:\n  LF: {foot: LF_FOOT}\n  RF: {foot: RF_FOOT}\n"
      "  LH: {foot: LH_FOOT}\n  RH: {foot: RH_FOOT}\nfoot: {radius: 0.031, center: [0, 0, "
      "0.02325]}\nlimits: {torque: 3, position_min: -2.5, position_max: 2.5}\n");
  const doctor::Diagnosis robot = doctor::examine(file);
  EXPECT_EQ(robot.name, "rex");
  EXPECT_FALSE(test::has(robot, doctor::Severity::warning, "position limits look like"));
  EXPECT_TRUE(test::has(robot, doctor::Severity::error, "to stand takes more torque"));
  EXPECT_TRUE(
      test::holds(test::message_of([&] { doctor::write_robot_file(robot, folder_ / "b.yaml"); }),
                  "rex has a robot file, " + file));
}

class DoctorOfShipped : public testing::TestWithParam<std::string> {};

TEST_P(DoctorOfShipped, finds_no_error) {
  const doctor::Diagnosis robot = doctor::examine(GetParam());
  EXPECT_FALSE(has_error(robot.findings)) << robot.findings.front().what;
}

INSTANTIATE_TEST_SUITE_P(Each, DoctorOfShipped, testing::ValuesIn(config::list_data("robots")));

TEST_F(DoctorCommand, tells_a_folder) {
  arguments_.urdf = folder_.path();
  EXPECT_TRUE(test::holds(test::message_of([&] { (void)doctor_command(arguments_); }),
                          ": a folder; give the description in it"));
}

}  // namespace
}  // namespace surefoot::cli
