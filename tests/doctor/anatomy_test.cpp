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
  EXPECT_TRUE(has(robot, Severity::warning, "LF and RH seem to be swapped: \"RH_HAA\" is at"));
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

/// An arm of three hinges, and a gripper's two fingers of a kind.
std::string arm_with(const std::string& finger) {
  std::string text, parent = "base";
  const auto add = [&](const std::string& name, const std::string& behind,
                       const std::string& joint) {
    text += "<link name=\"" + name +
            "\"><inertial><mass value=\"0.2\"/><inertia ixx=\"1e-3\" iyy=\"1e-3\" izz=\"1e-3\" "
            "ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial></link><joint name=\"to_" +
            name + "\" " + joint + "<origin xyz=\"0.1 0 0.1\"/><parent link=\"" + behind +
            "\"/><child link=\"" + name + "\"/></joint>";
  };
  for (const std::string name : {"arm_1", "arm_2", "arm_3"}) {
    add(name, parent,
        "type=\"revolute\"><axis xyz=\"0 1 0\"/><limit lower=\"-1\" upper=\"1\" effort=\"9\" "
        "velocity=\"2\"/>");
    parent = name;
  }
  if (finger.empty()) return text;
  add("finger_1", parent, finger);
  add("finger_2", parent, finger + "<mimic joint=\"to_finger_1\" multiplier=\"-1\"/>");
  return text;
}

TEST_F(Anatomy, holds_the_fingers_of_a_gripper) {
  change("</robot>", "</robot>",
         arm_with("type=\"prismatic\"><limit lower=\"0.01\" upper=\"0.05\" effort=\"9\" "
                  "velocity=\"2\"/>") +
             "</robot>");
  const Diagnosis robot = diagnosis();
  ASSERT_EQ(robot.anatomy.others.size(), 1U);
  EXPECT_TRUE(robot.anatomy.others[0].is_arm);
  EXPECT_EQ(robot.anatomy.others[0].joints.size(), 3U);
  EXPECT_FALSE(has_error(robot.findings)) << robot.findings.front().what;
  EXPECT_TRUE(has(robot, Severity::note, "joint \"to_finger_1\" (line"));
  EXPECT_TRUE(has(robot, Severity::note, "slides: it is held at 0.01 m"));
  EXPECT_TRUE(has(robot, Severity::note, "follows \"to_finger_1\": it is held at 0.01 m"));
}

TEST_F(Anatomy, takes_a_finger_that_others_follow_for_the_arms_last_joint) {
  change("</robot>", "</robot>",
         arm_with("type=\"revolute\"><axis xyz=\"0 0 1\"/><limit lower=\"-1\" upper=\"1\" "
                  "effort=\"9\" velocity=\"2\"/>") +
             "</robot>");
  const Diagnosis robot = diagnosis();
  ASSERT_EQ(robot.anatomy.others.size(), 1U);
  EXPECT_EQ(robot.anatomy.others[0].joints.size(), 4U);
  EXPECT_FALSE(has_error(robot.findings)) << robot.findings.front().what;
}

TEST_F(Anatomy, of_legs_of_four_hinges_finds_those_that_place_the_foot) {
  const Diagnosis three = diagnosis();
  replace_all("(name=\"(LF|RF|LH|RH)_ADAPTER_TO_FOOT\" type=)\"fixed\"", "$1\"revolute\"");
  const Diagnosis robot = diagnosis();
  ASSERT_TRUE(robot.anatomy.legs);
  for (const Leg leg : robot.anatomy.legs->legs()) {
    const FoundLeg& found = (*robot.anatomy.legs)[index(leg)];
    const FoundLeg& before = (*three.anatomy.legs)[index(leg)];
    EXPECT_EQ(found.joints[2].name, before.joints[2].name);
    EXPECT_EQ(found.foot.link, before.foot.link);
    EXPECT_NEAR(found.shank, before.shank, 1e-12);
    EXPECT_EQ(found.all_joints.size(), 4U);
  }
  const Finding held = test::finding(robot, Severity::note, "the others are held at 0");
  EXPECT_TRUE(test::holds(held.what, "LF_ADAPTER_TO_FOOT"));
  EXPECT_FALSE(has(robot, Severity::note, "an arm begins here"));
}

TEST_F(Anatomy, finds_legs_also_if_those_behind_alone_have_a_further_joint) {
  replace_all("(name=\"(LH|RH)_ADAPTER_TO_FOOT\" type=)\"fixed\"", "$1\"revolute\"");
  change("</robot>", "</robot>", arm_with("") + "</robot>");
  const Diagnosis robot = diagnosis();
  EXPECT_FALSE(robot.anatomy.flat_legs);
  ASSERT_TRUE(robot.anatomy.legs);
  for (const Leg leg : robot.anatomy.legs->legs()) {
    const FoundLeg& found = (*robot.anatomy.legs)[index(leg)];
    EXPECT_EQ(found.foot.link, std::string(kLegNames[index(leg)]) + "_FOOT");
    EXPECT_EQ(found.further().size(), is_front(leg) ? 0U : 1U);
  }
  ASSERT_EQ(robot.anatomy.others.size(), 1U);
  EXPECT_TRUE(robot.anatomy.others[0].is_arm);
}

TEST_F(Anatomy, of_four_limbs_that_no_three_joints_place_says_what_to_make_fixed) {
  replace_all("(name=\"(LF|RF|LH|RH)_ADAPTER_TO_FOOT\" type=)\"fixed\"", "$1\"revolute\"");
  replace_all("<axis xyz=\"(-?)1 0 0\"/>", "<axis xyz=\"0 0 1\"/>");
  const Diagnosis robot = diagnosis();
  const Finding legs = test::finding(robot, Severity::error, "one of 4 limbs of 4 hinges each");
  EXPECT_TRUE(test::holds(legs.remedy, "make fixed what they can walk without:"));
  EXPECT_TRUE(test::holds(legs.remedy, "LF_ADAPTER_TO_FOOT"));
}

TEST_F(Anatomy, of_four_long_legs_names_the_one_that_no_three_joints_place) {
  replace_all("(name=\"(LF|RF|LH|RH)_ADAPTER_TO_FOOT\" type=)\"fixed\"", "$1\"revolute\"");
  change("<joint name=\"RH_HAA\"", "<axis xyz=\"1 0 0\"/>", "<axis xyz=\"0 0 1\"/>");
  const Diagnosis robot = diagnosis();
  EXPECT_FALSE(robot.anatomy.legs);
  const Finding legs = test::finding(robot, Severity::error, "one of 4 limbs of 4 hinges each");
  EXPECT_TRUE(test::holds(legs.what, "in those that begin with RH_HAA"));
  EXPECT_FALSE(test::holds(legs.what, "LF_HAA"));
}

TEST_F(Anatomy, takes_the_four_lowest_of_five_limbs_for_legs) {
  change("</robot>", "</robot>", arm_with("") + "</robot>");
  const Diagnosis robot = diagnosis();
  ASSERT_TRUE(robot.anatomy.legs);
  EXPECT_TRUE(has(robot, Severity::note, "an arm begins here"));
  EXPECT_FALSE(has(examine("anymal_b_kinova"), Severity::note, "an arm begins here"))
      << "its robot file has the arm";
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
  replace_all("0 0 0.02325", "0 0 0");
  replace_all("<sphere radius=\"0.031\"/>", "<box size=\"0.05 0.04 0.03\"/>");
  const Diagnosis robot = diagnosis();
  ASSERT_TRUE(robot.anatomy.legs);
  EXPECT_EQ((*robot.anatomy.legs)[0].foot.guessed_from, "a box");
  EXPECT_NEAR((*robot.anatomy.legs)[0].foot.radius, 0.036, 1e-12);
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

TEST_F(AnatomyOfG1, has_two_legs_also_if_its_arms_have_as_many_joints) {
  replace_all("(name=\"(left|right)_wrist_yaw_joint\" type=)\"revolute\"", "$1\"fixed\"");
  const Diagnosis robot = diagnosis();
  EXPECT_FALSE(robot.anatomy.legs);
  ASSERT_TRUE(robot.anatomy.flat_legs);
  EXPECT_EQ(robot.anatomy.flat_legs->legs[0].foot, "left_ankle_roll_link");
}

TEST_F(AnatomyOfG1, with_a_leg_of_another_length_has_no_legs) {
  change("<joint name=\"left_knee_joint\"", "-0.078273", "0.3");
  const Diagnosis robot = diagnosis();
  EXPECT_FALSE(robot.anatomy.flat_legs);
  EXPECT_TRUE(has(robot, Severity::error, "a robot that walks has four or six legs"));
}

}  // namespace
}  // namespace surefoot::doctor
