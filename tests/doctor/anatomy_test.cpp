// What the doctor finds in a URDF that it has never seen: base, legs, feet.
#include "surefoot/doctor/knees.hpp"
#include "tests/doctor/changed_robot.hpp"
#include "tests/support/messages.hpp"

namespace surefoot::doctor {
namespace {

using test::has;
using Anatomy = test::ChangedRobot;

TEST_F(Anatomy, of_anymal_b_is_that_of_its_robot_file) {
  const Diagnosis robot = diagnosis();
  EXPECT_FALSE(has_error(robot.findings)) << robot.findings.front().what;
  EXPECT_EQ(robot.anatomy.base, "base");
  ASSERT_TRUE(robot.anatomy.legs);
  for (const Leg leg : kLegs) {
    const FoundLeg& found = (*robot.anatomy.legs)[index(leg)];
    const std::string name(kLegNames[index(leg)]);
    EXPECT_EQ(found.joints[0].name, name + "_HAA");
    EXPECT_EQ(found.joints[2].name, name + "_KFE");
    EXPECT_EQ(found.foot.link, name + "_FOOT");
    EXPECT_EQ(found.foot.radius, 0.031);
    EXPECT_NEAR(found.foot.center.z(), 0.02325, 1e-12);
    EXPECT_STREQ(doctor::name(knee_sides(found)), "both ways");
  }
  ASSERT_TRUE(robot.proportions);
  EXPECT_NEAR(robot.proportions->leg, 0.5643, 1e-3);
}

TEST_F(Anatomy, goes_by_places_not_by_names) {
  replace_all("\\bLF_", "XX_");
  replace_all("\\bRH_", "LF_");
  replace_all("\\bXX_", "RH_");
  const Diagnosis robot = diagnosis();
  ASSERT_TRUE(robot.anatomy.legs);
  EXPECT_EQ((*robot.anatomy.legs)[index(Leg::LF)].foot.link, "RH_FOOT");
  EXPECT_EQ((*robot.anatomy.legs)[index(Leg::RH)].foot.link, "LF_FOOT");
  EXPECT_FALSE(has_error(robot.findings)) << robot.findings.front().what;
  EXPECT_TRUE(has(robot, Severity::warning, "joint \"RH_HAA\": by its name it belongs to RH"));
}

TEST_F(Anatomy, with_a_joint_too_few_says_that_legs_are_missing) {
  change("<joint name=\"RH_HAA\"", "type=\"revolute\"", "type=\"fixed\"");
  const Diagnosis robot = diagnosis();
  EXPECT_FALSE(robot.anatomy.legs);
  EXPECT_TRUE(has(robot, Severity::error, "3 limbs of exactly three hinges"));
  EXPECT_TRUE(has(robot, Severity::error, "joint \"RH_HFE\": the limb that begins here"));
  EXPECT_TRUE(test::holds(test::finding(robot, Severity::error, "it has 2 joints").remedy,
                          "a leg must have three joints"));
}

TEST_F(Anatomy, of_a_leg_with_a_mimic_joint_says_to_take_that_out) {
  change("<joint name=\"LF_KFE\"", ">", "><mimic joint=\"LF_HFE\"/>");
  const Finding finding = test::finding(diagnosis(), Severity::error, "mimics another");
  EXPECT_TRUE(test::holds(finding.remedy, "take out <mimic>"));
}

TEST_F(Anatomy, with_an_arm_says_which_joints_must_be_fixed) {
  change("</robot>", "</robot>",
         "<link name=\"gripper\"/><joint name=\"arm\" type=\"prismatic\"><parent link=\"base\"/>"
         "<child link=\"gripper\"/></joint></robot>");
  const Diagnosis robot = diagnosis();
  ASSERT_TRUE(robot.anatomy.legs);
  ASSERT_EQ(robot.anatomy.others.size(), 1U);
  EXPECT_TRUE(has(robot, Severity::error, "joint \"arm\" is prismatic"));
}

TEST_F(Anatomy, takes_the_four_lowest_of_five_limbs_for_legs) {
  std::string arm;
  std::string parent = "base";
  for (const std::string name : {"arm_1", "arm_2", "arm_3"}) {
    arm += "<link name=\"" + name + "\"/><joint name=\"to_" + name +
           "\" type=\"revolute\"><origin xyz=\"0.1 0 0.1\"/><parent link=\"" + parent +
           "\"/><child link=\"" + name + "\"/></joint>";
    parent = name;
  }
  change("</robot>", "</robot>", arm + "</robot>");
  const Diagnosis robot = diagnosis();
  ASSERT_TRUE(robot.anatomy.legs);
  EXPECT_TRUE(has(robot, Severity::note, "an arm begins here"));
}

TEST_F(Anatomy, of_a_robot_that_looks_along_y_says_so) {
  for (const char* leg : {"LF", "RF", "LH", "RH"}) {
    const std::string joint = std::string("<joint name=\"") + leg + "_HAA\"";
    change(joint, "<origin xyz=", "<origin rpy=\"0 0 1.5707963\" xyz=");
  }
  EXPECT_TRUE(has(diagnosis(), Severity::error, "HFE axes do not lie along y"));
}

TEST_F(Anatomy, below_a_joint_that_floats_names_that_joint) {
  change("<link name=\"base\"", "<link",
         "<link name=\"world\"/><joint name=\"free\" type=\"floating\"><parent link=\"world\"/>"
         "<child link=\"base\"/></joint><link");
  const Diagnosis robot = diagnosis();
  EXPECT_TRUE(has(robot, Severity::error, "joint \"free\": the whole robot hangs on this"));
  EXPECT_TRUE(robot.anatomy.legs);
}

TEST_F(Anatomy, without_a_foot_says_whose) {
  change("<child link=\"LF_ADAPTER\"/>", "xyz=\"0.0 0.0 -0.32125\"", "xyz=\"0 0 0\"");
  const Diagnosis robot = diagnosis();
  EXPECT_TRUE(test::holds(robot.findings.front().what, "the foot is missing of LF"));
  EXPECT_FALSE(has(robot, Severity::error, "turns the other way"));
}

TEST_F(Anatomy, without_any_foot_says_so) {
  for (const char* leg : {"LF", "RF", "LH", "RH"})
    change(std::string("<child link=\"") + leg + "_ADAPTER\"/>", "-0.32125\"", "0\"");
  const Diagnosis robot = diagnosis();
  EXPECT_TRUE(test::holds(robot.findings.front().what, "the foot is missing of LF RF LH RH"));
  EXPECT_FALSE(has(robot, Severity::warning, "is a guess"));
}

TEST_F(Anatomy, guesses_the_radius_of_a_foot_without_sphere) {
  replace_all("<sphere radius=\"0.031\"/>", "<box size=\"0.05 0.04 0.03\"/>");
  const Diagnosis robot = diagnosis();
  ASSERT_TRUE(robot.anatomy.legs);
  EXPECT_EQ((*robot.anatomy.legs)[0].foot.guessed_from, "a box");
  EXPECT_NEAR((*robot.anatomy.legs)[0].foot.radius, 0.015, 1e-12);
  EXPECT_TRUE(has(robot, Severity::warning, "foot.radius is a guess"));
}

class AnatomyOfG1 : public test::ChangedRobot {
 protected:
  AnatomyOfG1() : ChangedRobot("g1") {
    replace_all("<mesh filename=[^>]*>", "<box size=\"1 1 1\"/>");
  }
};

TEST_F(AnatomyOfG1, has_two_legs_with_flat_feet_and_three_arms) {
  const Diagnosis robot = diagnosis();
  ASSERT_TRUE(robot.anatomy.flat_legs);
  const FlatLegs& found = *robot.anatomy.flat_legs;
  EXPECT_EQ(found.legs[0].foot, "left_ankle_roll_link");
  EXPECT_EQ(found.legs[1].joints.size(), 6u);
  EXPECT_EQ(found.legs[1].posture, (std::vector{-0.3, 0.0, 0.0, 0.6, -0.3, 0.0}));
  EXPECT_NEAR(found.sole.size.x(), 0.17, 1e-9);
  EXPECT_NEAR(found.sole.center.z(), -0.035, 1e-9);
  ASSERT_EQ(robot.anatomy.others.size(), 3u);
  for (const Limb& limb : robot.anatomy.others) EXPECT_TRUE(limb.is_arm);
  EXPECT_TRUE(has(robot, Severity::note, "but does not walk"));
}

TEST_F(AnatomyOfG1, with_a_leg_of_another_length_has_no_legs) {
  change("<joint name=\"left_knee_joint\"", "-0.078273", "0.3");
  const Diagnosis robot = diagnosis();
  EXPECT_FALSE(robot.anatomy.flat_legs);
  EXPECT_TRUE(has(robot, Severity::error, "a robot that walks has four or six legs"));
}

}  // namespace
}  // namespace surefoot::doctor
