// Each fault that a URDF may have gives a finding.
#include "surefoot/doctor/checks.hpp"

#include "tests/doctor/changed_robot.hpp"
#include "tests/support/messages.hpp"

namespace surefoot::doctor {
namespace {

using test::finding;
using test::has;
using test::holds;

using Checks = test::ChangedRobot;

TEST_F(Checks, feet_in_millimetres) {
  replace_all("<sphere radius=\"0.031\"/>", "<sphere radius=\"31\"/>");
  const Finding first = diagnosis().findings.front();
  EXPECT_TRUE(holds(first.what, "its foot sphere has a radius of 31 m"));
  EXPECT_TRUE(holds(first.remedy, "is <sphere radius> in mm?"));
}

TEST_F(Checks, foot_of_a_third_of_its_leg) {
  replace_all("<sphere radius=\"0.031\"/>", "<sphere radius=\"0.19\"/>");
  EXPECT_TRUE(has(diagnosis(), Severity::error, "feet have at most a quarter of that"));
}

TEST_F(Checks, collision_shapes_in_millimetres) {
  replace_all("<box size=\"0.08 0.07 0.13\"/>", "<box size=\"80 70 130\"/>");
  const Finding first = diagnosis().findings.front();
  EXPECT_TRUE(holds(first.what, "it collides with a shape of up to 130 m"));
  EXPECT_TRUE(holds(first.remedy, "are the sizes of <collision> in mm?"));
}

TEST_F(Checks, centres_of_mass_in_millimetres_come_before_the_inertias) {
  change("<link name=\"LF_THIGH\"", "-0.214583373795", "-214.583373795");
  const Finding first = diagnosis().findings.front();
  EXPECT_TRUE(holds(first.remedy, "is <inertial><origin> in mm?"));
  EXPECT_TRUE(first.is_cause);
}

TEST_F(Checks, lengths_in_inches) {
  for (const char* leg : {"LF", "RF", "LH", "RH"}) {
    const std::string joint = std::string("<joint name=\"") + leg;
    change(joint + "_KFE\"", "-0.25\"", "-9.84\"");
    change(joint + "_ADAPTER_TO_FOOT\"", "-0.32125\"", "-12.65\"");
  }
  EXPECT_TRUE(holds(diagnosis().findings.front().remedy, "or in inches? Divide them by 39.37"));
}

TEST_F(Checks, lengths_in_millimetres) {
  for (const char* leg : {"LF", "RF", "LH", "RH"}) {
    const std::string joint = std::string("<joint name=\"") + leg;
    change(joint + "_KFE\"", "-0.25\"", "-250\"");
    change(joint + "_ADAPTER_TO_FOOT\"", "-0.32125\"", "-321.25\"");
  }
  const Diagnosis robot = diagnosis();
  EXPECT_TRUE(holds(robot.findings.front().remedy, "are the origins in mm?"));
  EXPECT_TRUE(holds(robot.findings.front().what, "together in LF RF LH RH;"));
  EXPECT_FALSE(has(robot, Severity::error, "refuses"));
}

TEST_F(Checks, one_length_in_millimetres) {
  change("<joint name=\"LH_KFE\"", "-0.25\"", "-250\"");
  const Diagnosis robot = diagnosis();
  EXPECT_EQ(robot.findings.front().subject, "joint \"LH_KFE\"");
  EXPECT_FALSE(has(robot, Severity::warning, "differ"));
}

TEST_F(Checks, axis_that_turns_the_other_way) {
  change("<joint name=\"RH_KFE\"", "<axis xyz=\"0 1 0\"", "<axis xyz=\"0 -1 0\"");
  EXPECT_TRUE(has(diagnosis(), Severity::error,
                  "joint \"RH_KFE\": the KFE of RH turns the other way than those of the other"));
}

TEST_F(Checks, hip_abduction_that_turns_the_other_way) {
  change("<joint name=\"LF_HAA\"", "<axis xyz=\"1 0 0\"", "<axis xyz=\"-1 0 0\"");
  EXPECT_TRUE(has(diagnosis(), Severity::error, "joint \"LF_HAA\": the HAA of LF turns"));
}

TEST_F(Checks, hip_abduction_about_another_axis) {
  for (const char* axis : {"0 0 1", "0 1 0"}) {
    change("<joint name=\"RH_HAA\"", "<axis xyz=\"1 0 0\"",
           "<axis xyz=\"" + std::string(axis) + "\"");
    const Finding first = diagnosis().findings.front();
    EXPECT_EQ(first.subject, "joint \"RH_HAA\"");
    EXPECT_TRUE(holds(first.what, "HAA is turned by 1.57 rad against x of the base"));
    EXPECT_TRUE(holds(first.remedy, "1 0 0 in the base's frame is valid"));
    change("<joint name=\"RH_HAA\"", "<axis xyz=\"" + std::string(axis) + "\"",
           "<axis xyz=\"1 0 0\"");
  }
}

TEST_F(Checks, hip_abduction_of_all_legs_about_another_axis) {
  for (const char* leg : {"LF", "RF", "LH", "RH"})
    change(std::string("<joint name=\"") + leg + "_HAA\"", "<axis xyz=\"1 0 0\"",
           "<axis xyz=\"0 0 1\"");
  EXPECT_TRUE(has(diagnosis(), Severity::error, "so it is with RF_HAA LH_HAA RH_HAA"));
}

TEST_F(Checks, hip_abduction_that_is_tilted) {
  change("<joint name=\"RH_HAA\"", "<axis xyz=\"1 0 0\"", "<axis xyz=\"1 0.3 0\"");
  const Diagnosis robot = diagnosis();
  EXPECT_TRUE(has(robot, Severity::warning, "HAA is turned by 0.291 rad against x"));
  EXPECT_TRUE(has(robot, Severity::warning, "LH and RH, axis of HAA: one is turned by 0.291 rad"));
}

TEST_F(Checks, legs_that_reach_up) {
  for (const char* leg : {"LF", "RF", "LH", "RH"}) {
    const std::string joint = std::string("<joint name=\"") + leg;
    change(joint + "_KFE\"", "-0.25\"", "0.25\"");
    change(joint + "_ADAPTER_TO_FOOT\"", "-0.32125\"", "0.32125\"");
  }
  const Finding first = diagnosis().findings.front();
  EXPECT_TRUE(holds(first.what, "the foot is above the hip in LF RF LH RH"));
}

TEST_F(Checks, mirrored_hip_abduction_is_fine) {
  change("<joint name=\"LF_HAA\"", "<axis xyz=\"1 0 0\"", "<axis xyz=\"-1 0 0\"");
  change("<joint name=\"LH_HAA\"", "<axis xyz=\"1 0 0\"", "<axis xyz=\"-1 0 0\"");
  EXPECT_FALSE(has(diagnosis(), Severity::error, "HAA"));
}

TEST_F(Checks, knees_that_bend_one_way_only) {
  for (const char* leg : {"LF", "RF", "LH", "RH"}) {
    change(std::string("<joint name=\"") + leg + "_KFE\"", "upper=\"9.42\"", "upper=\"-0.5\"");
    change(std::string("<joint name=\"") + leg + "_KFE\"", "lower=\"-9.42\"", "lower=\"-2.6\"");
  }
  const Diagnosis robot = diagnosis();
  EXPECT_TRUE(has(robot, Severity::note, "knees of LF RF LH RH bend backward only"));
  EXPECT_TRUE(has(robot, Severity::note, "walk_flat stands with knees backward, not x"));
  EXPECT_TRUE(has(robot, Severity::note, "step_down stands with knees backward, not forward"));
  EXPECT_FALSE(has_error(robot.findings)) << robot.findings.front().what;
}

TEST_F(Checks, knee_that_can_not_bend) {
  change("<joint name=\"LF_KFE\"", "upper=\"9.42\"", "upper=\"0.1\"");
  change("<joint name=\"LF_KFE\"", "lower=\"-9.42\"", "lower=\"-0.1\"");
  EXPECT_TRUE(
      has(diagnosis(), Severity::error, "knees of LF bend by less than 0.5 rad to either side"));
}

TEST_F(Checks, effort_that_is_missing) {
  change("<joint name=\"LF_HFE\"", "effort=\"80\"", "effort=\"0\"");
  EXPECT_TRUE(
      has(diagnosis(), Severity::error, "the URDF has no effort limit above 0: LF_HFE, 0 N·m"));
  change("<joint name=\"LF_HFE\"", "effort=\"0\"", "");
  EXPECT_TRUE(has(diagnosis(), Severity::error, "the URDF has no effort limit: LF_HFE"));
}

TEST_F(Checks, effort_that_is_none_is_told_as_it_is_written) {
  change("<joint name=\"LF_HFE\"", "effort=\"80\"", "effort=\"nan\"");
  change("<joint name=\"RF_HFE\"", "effort=\"80\"", "effort=\"-80\"");
  const Diagnosis robot = diagnosis();
  EXPECT_TRUE(has(robot, Severity::error, "no effort limit above 0: LF_HFE, nan N·m"));
  EXPECT_TRUE(has(robot, Severity::error, "RF_HFE, -80 N·m"));
}

TEST_F(Checks, stall_torque_that_is_too_weak_to_stand) {
  test::write_file(folder_ / "robot.urdf", urdf_);
  test::write_file(
      folder_ / "robot.yaml",
      "name: weak\nurdf: robot.urdf\nlegs: {LF: {foot: LF_FOOT}, RF: {foot: RF_FOOT}, "
      "LH: {foot: LH_FOOT}, RH: {foot: RH_FOOT}}\nfoot: {radius: 0.031, center: [0, 0, "
      "0.02325]}\nlimits: {position_min: [-1.2, -2.6, -2.9], position_max: [1.2, 2.6, "
      "2.9]}\ndrives: {stall_torque: 2}\n");
  EXPECT_TRUE(
      has(examine(folder_ / "robot.yaml"), Severity::error, "of 2 N·m, drives.stall_torque"));
}

TEST_F(Checks, velocity_that_is_too_low_to_swing) {
  EXPECT_FALSE(has(diagnosis(), Severity::warning, "too low for a swing"));
  change("<joint name=\"RH_KFE\"", "velocity=\"15.0\"", "velocity=\"0.5\"");
  EXPECT_TRUE(has(diagnosis(), Severity::warning, "about 1.5 rad/s at this size: RH_KFE"));
}

TEST_F(Checks, centre_of_mass_beside_the_feet) {
  EXPECT_FALSE(has(diagnosis(), Severity::warning, "centre of mass"));
  change("<link name=\"base_inertia\"", "xyz=\"-0.00196", "xyz=\"0.90196");
  const Finding found = finding(diagnosis(), Severity::error, "the robot's centre of mass");
  EXPECT_TRUE(holds(found.what, "not over its feet"));
  EXPECT_TRUE(holds(found.remedy, "\"base_inertia\""));
}

TEST_F(Checks, centre_of_mass_near_the_edge_of_the_feet) {
  change("<link name=\"base_inertia\"", "xyz=\"-0.00196", "xyz=\"0.58196");
  EXPECT_TRUE(
      has(diagnosis(), Severity::warning, "m within its feet, so that it hardly lifts one"));
}

TEST_F(Checks, effort_that_is_too_weak_to_stand) {
  for (const char* leg : {"LF", "RF", "LH", "RH"})
    change(std::string("<joint name=\"") + leg + "_KFE\"", "effort=\"80\"", "effort=\"2\"");
  EXPECT_TRUE(has(diagnosis(), Severity::error, "to stand takes more torque than the limit"));
}

TEST_F(Checks, position_limits_in_degrees) {
  replace_all("upper=\"9.42\"", "upper=\"150\"");
  replace_all("lower=\"-9.42\"", "lower=\"-150\"");
  EXPECT_TRUE(has(diagnosis(), Severity::warning, "the position limits look like degrees"));
}

TEST_F(Checks, joints_without_stops) {
  replace_all("(name=\"(LF|RF|LH|RH)_(HAA|HFE|KFE)\" type=)\"revolute\"", "$1\"continuous\"");
  replace_all("(lower|upper)=\"-?9.42\"", "");
  const Diagnosis robot = diagnosis();
  EXPECT_TRUE(
      has(robot, Severity::warning, "these joints have no stops, so the legs' usual range"));
  EXPECT_FALSE(has_error(robot.findings)) << robot.findings.front().what;
}

TEST_F(Checks, reach_of_the_stance) {
  const Diagnosis sound = diagnosis();
  ASSERT_TRUE(sound.reach);
  EXPECT_NEAR(sound.reach->longest, 0.5643, 1e-3);
  EXPECT_GT(sound.reach->stretched, 0.7);
  EXPECT_LT(sound.reach->stretched, 0.95);
  EXPECT_GT(sound.reach->from_haa, 0.5);
}

TEST_F(Checks, singular_postures) {
  Diagnosis robot = diagnosis();
  EXPECT_FALSE(has(robot, Severity::warning, "is stretched to"));
  robot.reach = Reach{.longest = 0.5, .stretched = 0.99, .from_haa = 0.02, .leg = Leg::RH};
  check_singular(robot);
  EXPECT_TRUE(has(robot, Severity::warning, "RH is stretched to 99 % of its reach, 0.5 m"));
  EXPECT_TRUE(has(robot, Severity::warning, "a foot is only 0.01 m from the axis of its HAA"));
}

TEST_F(Checks, hip_flexion_and_knee_about_another_axis) {
  for (const char* joint : {"RH_HFE", "RH_KFE"})
    change(std::string("<joint name=\"") + joint + "\"", "<axis xyz=\"0 1 0\"",
           "<axis xyz=\"0 0 1\"");
  const Finding first = diagnosis().findings.front();
  EXPECT_EQ(first.subject, "joint \"RH_HFE\"");
  EXPECT_TRUE(holds(first.what, "HFE is turned by 1.57 rad against y of the base"));
}

TEST_F(Checks, names_of_two_legs_that_are_swapped) {
  replace_all("\\bLF_", "XX_");
  replace_all("\\bRF_", "LF_");
  replace_all("\\bXX_", "RF_");
  const Diagnosis robot = diagnosis();
  EXPECT_TRUE(has(robot, Severity::warning, "LF and RF seem to be swapped: \"RF_HAA\" is at the"));
  EXPECT_FALSE(has(robot, Severity::warning, "by its name it belongs"));
}

TEST_F(Checks, names_in_words_of_two_legs_that_are_swapped) {
  for (const auto& [code, words] : {std::pair{"LF", "front.right"},
                                    {"RF", "left_front"},
                                    {"LH", "rear-left"},
                                    {"RH", "hind_right"}})
    replace_all(std::string("\\b") + code + "_", std::string(words) + "_");
  EXPECT_TRUE(has(diagnosis(), Severity::warning,
                  "LF and RF seem to be swapped: \"front.right_HAA\" is at the place of LF"));
}

TEST_F(Checks, names_of_joined_words_of_two_legs_that_are_swapped) {
  for (const auto& [left, right] : {std::pair{"FrontLeft_", "FrontRight_"},
                                    {"frontleft_", "frontright_"},
                                    {"leg_fl_", "leg_fr_"},
                                    {"legFL_", "legFR_"},
                                    {"FLHip", "FRHip"},
                                    {"fl1_", "fr1_"}}) {
    const std::string original = urdf_;
    replace_all("\\bLF_", right);
    replace_all("\\bRF_", left);
    EXPECT_TRUE(has(diagnosis(), Severity::warning, "LF and RF seem to be swapped")) << left;
    urdf_ = original;
  }
}

TEST_F(Checks, no_axes) {
  replace_all("<axis [^>]*/>", "");
  const Finding first = diagnosis().findings.front();
  EXPECT_EQ(first.subject, "joint \"LF_HFE\"");
  EXPECT_TRUE(holds(first.what, "it has no <axis>, and a URDF then takes x"));
  EXPECT_TRUE(holds(first.remedy, "y of the base, 0 1 0"));
}

TEST_F(Checks, one_knee_that_bends_otherwise_than_the_others) {
  change("<joint name=\"RH_KFE\"", "lower=\"-9.42\"", "lower=\"0\"");
  EXPECT_TRUE(
      has(diagnosis(), Severity::warning,
          "by their limits, 0 to 9.42 rad, the knee of RH bends forward, those of the other "
          "legs both ways"));
}

TEST_F(Checks, feet_of_cylinders_are_enclosed) {
  replace_all("0 0 0.02325", "0 0 0");
  replace_all("<sphere radius=\"0.031\"/>", "<cylinder radius=\"0.03\" length=\"0.06\"/>");
  const Diagnosis robot = diagnosis();
  EXPECT_GE((*robot.anatomy.legs)[0].foot.radius, std::hypot(0.03, 0.03));
  EXPECT_FALSE(has(robot, Severity::error, "below the foot sphere"));
}

TEST_F(Checks, shape_of_a_shank_around_its_foot) {
  change("<link name=\"LF_SHANK\"", "<box size=\"0.08 0.07 0.13\"/>",
         "<box size=\"0.9 0.07 0.13\"/>");
  EXPECT_TRUE(has(diagnosis(), Severity::error, "the collision shape of \"LF_SHANK\" smaller"));
}

TEST_F(Checks, position_limits_of_whole_turns) {
  EXPECT_TRUE(has(diagnosis(), Severity::warning, "the position limits look like placeholders"));
}

class ChecksOfSolo : public test::ChangedRobot {
 protected:
  ChecksOfSolo() : ChangedRobot("solo12") {}
};

TEST_F(ChecksOfSolo, effort_and_velocity_placeholders) {
  const Diagnosis robot = diagnosis();
  EXPECT_TRUE(has(robot, Severity::warning, "the effort limit looks like a placeholder"));
  EXPECT_TRUE(has(robot, Severity::warning, "the velocity limit looks like a placeholder"));
  EXPECT_FALSE(has_error(robot.findings)) << robot.findings.front().what;
}

}  // namespace
}  // namespace surefoot::doctor
