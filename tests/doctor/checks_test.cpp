// Each fault that a URDF may have gives a finding.
#include "tests/doctor/changed_robot.hpp"
#include "tests/support/messages.hpp"

namespace surefoot::doctor {
namespace {

using test::finding;
using test::has;
using test::holds;

class Checks : public test::ChangedRobot {
 protected:
  void multiply_masses(double factor) {
    std::string result;
    const std::regex mass("<mass value=\"([^\"]*)\"");
    std::sregex_iterator each(urdf_.begin(), urdf_.end(), mass);
    std::size_t from = 0;
    for (; each != std::sregex_iterator(); ++each) {
      const auto place = static_cast<std::size_t>(each->position());
      result += urdf_.substr(from, place - from) + "<mass value=\"" +
                std::to_string(factor * std::stod((*each)[1])) + "\"";
      from = place + static_cast<std::size_t>(each->length());
    }
    urdf_ = result + urdf_.substr(from);
  }
};

TEST_F(Checks, masses_in_grams) {
  multiply_masses(1000.0);
  const Diagnosis robot = diagnosis();
  EXPECT_TRUE(holds(robot.findings.front().remedy, "are the masses in g?"));
  EXPECT_FALSE(has(robot, Severity::warning, "the inertia is too small for the mass"));
  EXPECT_FALSE(has(robot, Severity::error, "to stand takes more torque"));
}

TEST_F(Checks, one_mass_in_grams) {
  change("<link name=\"RF_THIGH\"", "<mass value=\"1.634976467\"", "<mass value=\"1635\"");
  const Finding first = diagnosis().findings.front();
  EXPECT_EQ(first.subject, "link \"RF_THIGH\"");
  EXPECT_TRUE(holds(first.what, "it has 1635 of the 1664 kg of all links"));
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

TEST_F(Checks, inertia_in_square_millimetres) {
  change("<link name=\"RF_THIGH\"", "ixx=\"0.0", "ixx=\"12036.");
  change("<link name=\"RF_THIGH\"", "iyy=\"0.0", "iyy=\"12064.");
  change("<link name=\"RF_THIGH\"", "izz=\"0.00249", "izz=\"2494.");
  EXPECT_TRUE(
      has(diagnosis(), Severity::error, "link \"RF_THIGH\": its radius of gyration, √(I/m), is"));
}

TEST_F(Checks, inertias_in_square_millimetres_are_one_finding) {
  urdf_ = std::regex_replace(urdf_, std::regex("(i[xyz][xyz]=\"[^\"e]*)\""), "$1e6\"");
  const Diagnosis robot = diagnosis();
  const Finding found = finding(robot, Severity::error, "too large for the mass");
  EXPECT_TRUE(holds(found.what, "; so it is with LF_HIP"));
  EXPECT_EQ(std::ranges::count(robot.findings, found.remedy, &Finding::remedy), 1);
}

TEST_F(Checks, link_whose_mass_is_only_that_of_what_is_fixed_to_it) {
  change("<link name=\"LF_SHANK\"", "<mass value=\"0.207204302\"", "<mass value=\"0\"");
  EXPECT_TRUE(has(diagnosis(), Severity::warning,
                  "link \"LF_SHANK\": it moves, but its <inertial> is missing or 0"));
}

TEST_F(Checks, link_without_mass) {
  change("<link name=\"LF_THIGH\"", "<mass value=\"1.634976467\"", "<mass value=\"0\"");
  const Finding found = finding(diagnosis(), Severity::error, "has no mass");
  EXPECT_EQ(found.subject, "link \"LF_THIGH\"");
  EXPECT_EQ(found.line, 194);
}

TEST_F(Checks, negative_mass) {
  change("<link name=\"LF_THIGH\"", "<mass value=\"", "<mass value=\"-");
  EXPECT_TRUE(has(diagnosis(), Severity::error, "link \"LF_THIGH\": its mass is negative"));
}

TEST_F(Checks, negative_inertia) {
  change("<link name=\"LF_THIGH\"", "ixx=\"", "ixx=\"-");
  EXPECT_TRUE(
      has(diagnosis(), Severity::error, "link \"LF_THIGH\": its inertia has a negative principal"));
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
  EXPECT_TRUE(has(diagnosis(), Severity::error, "knees of LF bend not at all"));
}

TEST_F(Checks, leg_that_is_longer_than_its_mirror_image) {
  change("<joint name=\"RF_KFE\"", "-0.25\"", "-0.28\"");
  EXPECT_TRUE(has(diagnosis(), Severity::warning, "LF and RF, thigh, HFE axis to KFE axis"));
}

TEST_F(Checks, hip_at_the_wrong_place) {
  change("<joint name=\"RH_HAA\"", "xyz=\"-0.277 -0.116", "xyz=\"-0.247 -0.116");
  EXPECT_TRUE(has(diagnosis(), Severity::warning, "LH and RH, place of the hip"));
}

TEST_F(Checks, effort_that_is_missing) {
  change("<joint name=\"LF_HFE\"", "effort=\"80\"", "effort=\"0\"");
  EXPECT_TRUE(has(diagnosis(), Severity::error, "the URDF has no effort limit: LF_HFE"));
}

TEST_F(Checks, effort_that_is_too_weak_to_stand) {
  for (const char* leg : {"LF", "RF", "LH", "RH"})
    change(std::string("<joint name=\"") + leg + "_KFE\"", "effort=\"80\"", "effort=\"2\"");
  EXPECT_TRUE(has(diagnosis(), Severity::error, "to stand takes more torque than the limit"));
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
