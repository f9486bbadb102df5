// A fault in a URDF gives one message that names the element, its line and what would be valid,
// whether the reader refuses the file or the doctor finds it.
#include "surefoot/base/error.hpp"
#include "tests/doctor/changed_robot.hpp"
#include "tests/support/messages.hpp"

namespace surefoot::doctor {
namespace {

struct BadUrdf {
  const char *behind, *from, *to;
  std::vector<const char*> told;  ///< in the first message
};

class EachBadUrdf : public test::ChangedRobot, public testing::WithParamInterface<BadUrdf> {
 protected:
  std::string first_message() {
    try {
      const Finding first = diagnosis().findings.front();
      return first.subject + " (robot.urdf:" + std::to_string(first.line) + "): " + first.what +
             " → " + first.remedy;
    } catch (const Error& error) {
      return error.what();
    }
  }
};

TEST_P(EachBadUrdf, is_told_first) {
  const BadUrdf& bad = GetParam();
  change(bad.behind, bad.from, bad.to);
  const std::string message = first_message();
  for (const char* part : bad.told) EXPECT_TRUE(test::holds(message, part));
}

constexpr const char* kLoop =
    "<joint name=\"loop\" type=\"fixed\"><parent link=\"LF_FOOT\"/><child "
    "link=\"RF_FOOT\"/></joint>"
    "</robot>";
constexpr const char* kToe =
    "<link name=\"toe\"/><joint name=\"second\" type=\"revolute\"><parent link=\"LF_THIGH\"/>"
    "<child link=\"toe\"/><limit effort=\"1\" velocity=\"1\" lower=\"-1\" upper=\"1\"/></joint>"
    "</robot>";

INSTANTIATE_TEST_SUITE_P(
    Each, EachBadUrdf,
    testing::Values(
        BadUrdf{"</robot>",
                "</robot>",
                kLoop,
                {"robot.urdf:", "link \"RF_FOOT\" is the child of two joints",
                 "\"RF_ADAPTER_TO_FOOT\" and \"loop\" one must go", "a tree without loops"}},
        BadUrdf{"</robot>",
                "</robot>",
                kToe,
                {"joint \"LF_HAA\" (robot.urdf:", "it branches behind joint \"LF_HFE\"",
                 "LF_KFE second"}},
        BadUrdf{"<joint name=\"RF_HAA\"",
                "RF_HAA",
                "LF_HAA",
                {"robot.urdf:", "joint \"LF_HAA\" stands twice, first in line"}},
        BadUrdf{"<joint name=\"LF_KFE\"",
                "type=\"revolute\"",
                "type=\"hinge\"",
                {"joint \"LF_KFE\" (robot.urdf:", "a URDF has no joint of type \"hinge\"",
                 "set type=\"revolute\" (or continuous)"}},
        BadUrdf{"<joint name=\"LF_HAA\"",
                "<origin xyz=",
                "<origin rpy=\"0 0 90\" xyz=",
                {"joint \"LF_HAA\" (robot.urdf:", "is turned by more than a turn, rpy=\"0 0 90\"",
                 "is rpy in degrees?"}},
        BadUrdf{"<joint name=\"LF_KFE\"",
                "<axis xyz=\"0 1 0\"",
                "<axis xyz=\"1 0 0\"/><axis xyz=\"0 1 0\"",
                {"robot.urdf:", "joint \"LF_KFE\" has a second <axis>; one of them must go"}},
        BadUrdf{"<link name=\"LF_THIGH\"",
                "<inertial>",
                "<inertial/><inertial>",
                {"robot.urdf:", "link \"LF_THIGH\" has a second <inertial>"}},
        BadUrdf{"<joint name=\"LF_KFE\"",
                "<joint ",
                "<JOINT/><joint ",
                {"robot.urdf:", "<JOINT> does not belong in a URDF; did you mean <joint>?"}},
        BadUrdf{"<joint name=\"LF_KFE\"",
                "<axis ",
                "<mimic joint=\"nope\"/><axis ",
                {"robot.urdf:", "\"LF_KFE\" mimics \"nope\", and there is no joint of that name"}},
        BadUrdf{"<joint name=\"LF_KFE\"",
                "<axis ",
                "<mimic joint=\"LF_KFE\"/><axis ",
                {"robot.urdf:", "\"LF_KFE\" mimics \"LF_KFE\", which follows it in turn"}},
        BadUrdf{"</robot>",
                "</robot>",
                "<!-- </robot>",
                {"robot.urdf:", "a comment that begins with <!-- here does not end with -->"}},
        BadUrdf{"<link name=\"LF_THIGH\"",
                "<mass value=\"1.634976467\"",
                "<mass value=\"nan\"",
                {"robot.urdf:", "<mass> needs value=\"a finite number\", not \"nan\""}},
        BadUrdf{"<joint name=\"LF_KFE\"",
                "<axis xyz=\"0 1 0\"",
                "<axis xyz=\"0 0 0\"",
                {"robot.urdf:", "joint \"LF_KFE\": its axis has no direction; valid is <axis"}},
        BadUrdf{"<joint name=\"LF_KFE\"", "LF_KFE", "", {"robot.urdf:", "<joint> has no name"}},
        BadUrdf{"<link name=\"LF_FOOT\"",
                "<sphere radius=\"0.031\"/>",
                "<sphere radius=\"nan\"/>",
                {"robot.urdf:",
                 "link \"LF_FOOT\": the <sphere> that it collides with has a size of "
                 "nan m; it must be above 0"}},
        BadUrdf{"<link name=\"LF_FOOT\"",
                "<sphere radius=\"0.031\"/>",
                "<sphere radius=\"-0.031\"/>",
                {"robot.urdf:", "link \"LF_FOOT\"", "has a size of -0.031 m"}},
        BadUrdf{"<link name=\"LF_SHANK\"",
                "<box size=\"0.08 0.07 0.13\"/>",
                "<mesh filename=\"package://nowhere/shank.stl\"/>",
                {"robot.urdf:", "link \"LF_SHANK\": there is no \"package://nowhere/shank.stl\"",
                 "in a folder \"nowhere\" in", "and above it"}},
        BadUrdf{"<link name=\"LF_SHANK\"",
                "<box size=\"0.08 0.07 0.13\"/>",
                "<box size=\"0.9 0.07 0.13\"/>",
                {"a collision shape of link \"LF_SHANK\" reaches", "below the foot sphere of LF",
                 "must enclose what the foot stands on"}},
        BadUrdf{"<link name=\"LF_THIGH\"",
                "<mass value=\"1.634976467\"",
                "<mass value=\"0\"",
                {"link \"LF_THIGH\" (robot.urdf:194): its mass is 0, and its inertia is not",
                 "a number above 0 is valid"}}));

class KneesOfAnymal : public test::ChangedRobot {
 protected:
  void limit_knee(const std::string& leg, const char* lower, const char* upper) {
    const std::string joint = "<joint name=\"" + leg + "_KFE\"";
    change(joint, "upper=\"9.42\"", std::string("upper=\"") + upper + "\"");
    change(joint, "lower=\"-9.42\"", std::string("lower=\"") + lower + "\"");
  }
};

TEST_F(KneesOfAnymal, one_that_bends_the_wrong_way_is_told_first) {
  for (const char* leg : {"LF", "RF", "LH"}) limit_knee(leg, "-2.6", "-0.5");
  limit_knee("RH", "0.5", "2.6");
  const Finding first = diagnosis().findings.front();
  EXPECT_EQ(first.subject, "joint \"RH_KFE\"");
  EXPECT_TRUE(test::holds(first.what, "the knee of RH bends forward only, that of LH backward"));
  EXPECT_TRUE(test::holds(first.remedy, "exchange and negate lower and upper"));
}

TEST_F(KneesOfAnymal, axis_that_is_turned_round_is_told_before_the_stance_that_fails) {
  for (const char* leg : {"LF", "RF", "LH", "RH"}) limit_knee(leg, "-2.6", "-0.2");
  change("<joint name=\"LF_KFE\"", "<axis xyz=\"0 1 0\"", "<axis xyz=\"0 -1 0\"");
  const Diagnosis robot = diagnosis();
  EXPECT_EQ(robot.findings.front().subject, "joint \"LF_KFE\"");
}

TEST_F(KneesOfAnymal, one_of_a_left_leg_that_bends_the_wrong_way_is_told_of_it) {
  for (const char* leg : {"RF", "LH", "RH"}) limit_knee(leg, "-2.6", "-0.5");
  limit_knee("LF", "0.5", "2.6");
  const Finding first = diagnosis().findings.front();
  EXPECT_EQ(first.subject, "joint \"LF_KFE\"");
  EXPECT_TRUE(test::holds(first.what, "the knee of LF bends forward only, that of RF backward"));
}

TEST_F(KneesOfAnymal, in_x_are_fine) {
  for (const char* leg : {"LF", "RF"}) limit_knee(leg, "-2.6", "-0.5");
  for (const char* leg : {"LH", "RH"}) limit_knee(leg, "0.5", "2.6");
  EXPECT_FALSE(has_error(diagnosis().findings));
}

}  // namespace
}  // namespace surefoot::doctor
