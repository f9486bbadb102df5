// The robot file that the doctor writes.
#include "surefoot/doctor/robot_file_text.hpp"

#include "surefoot/config/scenario_file.hpp"
#include "surefoot/doctor/report.hpp"
#include "tests/doctor/changed_robot.hpp"
#include "tests/support/messages.hpp"

#include <nlohmann/json.hpp>

namespace surefoot::doctor {
namespace {

using test::holds;
using test::message_of;

class WrittenFile : public testing::TestWithParam<const char*> {};

TEST_P(WrittenFile, makes_the_robot_that_ships) {
  const test::TemporaryFolder folder;
  const model::RobotDescription ships = config::load_robot(GetParam());
  write_robot_file(examine(ships.urdf_path, GetParam()), folder / "robot.yaml");
  const model::RobotDescription robot = config::load_robot(folder / "robot.yaml");
  EXPECT_EQ(robot.name, GetParam());
  EXPECT_TRUE(std::filesystem::equivalent(robot.urdf_path, ships.urdf_path));
  for (const Leg leg : kLegs) {
    EXPECT_EQ(robot.legs[index(leg)].joints, ships.legs[index(leg)].joints);
    EXPECT_EQ(robot.legs[index(leg)].foot_frame, ships.legs[index(leg)].foot_frame);
  }
  EXPECT_NEAR(robot.legs[0].foot_radius, ships.legs[0].foot_radius, 0.01);
  EXPECT_TRUE(robot.legs[0].foot_center.isApprox(ships.legs[0].foot_center, 1e-9));
}

INSTANTIATE_TEST_SUITE_P(Of, WrittenFile,
                         testing::Values("anymal_b", "anymal_c", "a1", "go1", "go2", "b1",
                                         "laikago", "hyq", "solo12"));

using RobotFileText = test::ChangedRobot;

TEST_F(RobotFileText, has_placeholders_as_comments) {
  const Diagnosis robot = diagnosis();
  const std::string text = robot_file_text(robot, folder_.path(), Guesses::as_comments);
  EXPECT_TRUE(holds(text, "\nurdf: robot.urdf\n"));
  EXPECT_TRUE(holds(text, "\n#limits:"));
  EXPECT_TRUE(holds(text, "\n#  position_min: ["));
  EXPECT_EQ(text.find("torque:"), std::string::npos);
}

TEST_F(RobotFileText, of_an_mjcf_has_its_key_and_what_it_lacks) {
  const Diagnosis robot = examine(config::load_robot("spot").urdf_path);
  const std::string text = robot_file_text(robot, folder_.path(), Guesses::as_comments);
  EXPECT_TRUE(holds(text, "\nmjcf: "));
  EXPECT_TRUE(holds(text, "LF: {foot: FL_foot}"));
  EXPECT_TRUE(holds(text, "radius: 0.036"));
  EXPECT_TRUE(holds(text, "\n#  velocity: "));
  EXPECT_EQ(text.find("torque:"), std::string::npos);
  EXPECT_TRUE(test::has(robot, Severity::warning, "the MJCF has no velocity limit; 1"));
}

TEST_F(RobotFileText, of_a_foot_without_shape_lacks_the_radius) {
  replace_all("<sphere radius=\"0.031\"/>", "");
  const Diagnosis robot = diagnosis();
  EXPECT_TRUE(test::has(robot, Severity::error, "collide with nothing"));
  EXPECT_TRUE(
      holds(robot_file_text(robot, folder_.path(), Guesses::as_comments), "\n  # radius: "));
  write_robot_file(robot, folder_ / "robot.yaml");
  EXPECT_TRUE(
      holds(message_of([&] { (void)config::load_robot(folder_ / "robot.yaml"); }), "foot.radius"));
}

TEST_F(RobotFileText, fills_in_only_the_joints_that_lack_a_limit) {
  change("<joint name=\"LF_HFE\"", "effort=\"80\"", "effort=\"0\"");
  const Diagnosis robot = diagnosis();
  EXPECT_TRUE(holds(robot_file_text(robot, folder_.path(), Guesses::as_comments),
                    "  LF:\n    foot: LF_FOOT\n#    limits:\n#      torque: {HFE: 40}"));
  test::write_file(folder_ / "robot.yaml",
                   robot_file_text(robot, folder_.path(), Guesses::as_numbers));
  const model::RobotDescription read = config::load_robot(folder_ / "robot.yaml");
  EXPECT_EQ(read.torque_limit[0], 80.0);
  EXPECT_EQ(read.torque_limit[1], 40.0);
  EXPECT_EQ(read.torque_limit[4], 80.0);
}

TEST_F(RobotFileText, names_what_is_guessed) {
  change("<joint name=\"LF_HFE\"", "effort=\"80\"", "effort=\"0\"");
  replace_all("<sphere radius=\"0.031\"/>", "<box size=\"0.04 0.04 0.03\"/>");
  const Diagnosis robot = diagnosis();
  const std::string with_numbers = robot_file_text(robot, folder_.path(), Guesses::as_numbers),
                    with_comments = robot_file_text(robot, folder_.path(), Guesses::as_comments);
  EXPECT_TRUE(holds(with_numbers, "guessed: "));
  EXPECT_TRUE(holds(with_numbers, "  - \"limits.torque 41.6 N·m of LF_HFE\"\n"));
  EXPECT_TRUE(
      holds(with_numbers, "  - \"limits.position_max 1.2 rad of each HAA, 2.6 rad of each"));
  EXPECT_TRUE(holds(with_numbers, "  - \"foot.radius 0."));
  EXPECT_EQ(with_comments.find("limits.torque"), std::string::npos);
  EXPECT_TRUE(holds(with_comments, "  - \"foot.radius 0."));
  test::write_file(folder_ / "robot.yaml", with_numbers);
  const config::Scenario scenario =
      config::load_scenario({.name_or_path = "walk_flat",
                             .seed = 0,
                             .assignments = {"robot=" + (folder_ / "robot.yaml")}});
  EXPECT_TRUE(std::ranges::any_of(scenario.notes, [](const std::string& note) {
    return note.starts_with("guessed for robot, not measured: limits.torque 41.6 N·m of LF_HFE; ");
  }));
}

TEST_F(RobotFileText, tells_a_foot_that_differs) {
  change("<link name=\"RH_FOOT\"", "<sphere radius=\"0.031\"/>", "<sphere radius=\"0.035\"/>");
  const Diagnosis robot = diagnosis();
  EXPECT_TRUE(test::has(robot, Severity::note, "the sphere of RH differs from that of LF"));
  EXPECT_FALSE(has_error(robot.findings)) << robot.findings.front().what;
  EXPECT_TRUE(holds(robot_file_text(robot, folder_.path(), Guesses::as_comments),
                    "RH:\n    foot: RH_FOOT\n    foot_radius: 0.035 "));
}

TEST_F(RobotFileText, gives_joints_without_stops_a_range) {
  replace_all("(name=\"(LF|RF|LH|RH)_(HAA|HFE|KFE)\" type=)\"revolute\"", "$1\"continuous\"");
  replace_all("(lower|upper)=\"-?9.42\"", "");
  write_robot_file(diagnosis(), folder_ / "robot.yaml");
  const model::RobotDescription read = config::load_robot(folder_ / "robot.yaml");
  EXPECT_EQ(read.q_min[1], -2.6);
  EXPECT_EQ(read.q_max[2], 2.9);
}

TEST_F(RobotFileText, has_a_valid_name) {
  test::write_file(folder_ / "my robot.urdf", urdf_);
  EXPECT_EQ(examine(folder_ / "my robot.urdf").name, "my_robot");
  for (const char* name : {"", "a/b", "..", "-x", "a b", "a:b"})
    EXPECT_FALSE(is_robot_name(name)) << name;
  for (const char* name : {"rex", "R2-d2", "a_1.5"}) EXPECT_TRUE(is_robot_name(name)) << name;
}

TEST_F(RobotFileText, is_never_written_over_another_file) {
  const Diagnosis robot = diagnosis();
  test::write_file(folder_ / "robot.yaml", "mine");
  EXPECT_TRUE(holds(message_of([&] { write_robot_file(robot, folder_ / "robot.yaml"); }),
                    "exists already"));
  EXPECT_EQ(test::contents(folder_ / "robot.yaml"), "mine");
  EXPECT_TRUE(holds(message_of([&] { write_robot_file(robot, folder_ / "robot.txt"); }), ".yaml"));
}

TEST_F(RobotFileText, comes_with_a_report_for_people_and_one_for_programs) {
  change("<joint name=\"RH_KFE\"", "<axis xyz=\"0 1 0\"", "<axis xyz=\"0 -1 0\"");
  const Diagnosis robot = diagnosis();
  const std::string text = report_text(robot, {{"walk_flat", false, "it fell", "", "walk_flat"}});
  EXPECT_TRUE(holds(text, "error (likely): joint \"RH_KFE\" (robot.urdf:"));
  EXPECT_TRUE(holds(text, "walk_flat: did not succeed: it fell"));
  EXPECT_TRUE(
      holds(report_text(robot, {{"stand", false, "it fell", "", "walk_flat"}}),
            "stand: did not succeed: it fell\n  → surefoot run walk_flat --set robot=FILE"));
  const auto json = nlohmann::json::parse(report_json(robot, {}));
  EXPECT_EQ(json["legs"]["RH"]["joints"][2], "RH_KFE");
  EXPECT_EQ(json["findings"][0]["severity"], "error");
  EXPECT_EQ(json["findings"].size(), robot.findings.size());
}

}  // namespace
}  // namespace surefoot::doctor
