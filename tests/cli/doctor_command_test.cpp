// What `surefoot doctor` tells its caller.
#include "cli/doctor_command.hpp"

#include "cli/exit_code.hpp"
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

TEST_F(DoctorCommand, tells_how_to_check_a_robot_file) {
  const std::string file = folder_ / "robot.yaml";
  test::write_file(file, "name: r\n");
  arguments_.urdf = file;
  EXPECT_TRUE(test::holds(test::message_of([&] { (void)doctor_command(arguments_); }),
                          file + " is a robot file, not a URDF or an MJCF"));
}

}  // namespace
}  // namespace surefoot::cli
