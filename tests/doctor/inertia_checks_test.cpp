// Masses and inertias that can't be, or have another unit, give a finding.
#include "surefoot/doctor/checks.hpp"
#include "tests/doctor/changed_robot.hpp"
#include "tests/support/messages.hpp"

namespace surefoot::doctor {
namespace {

using test::finding;
using test::has;
using test::holds;

class InertiaChecks : public test::ChangedRobot {
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
  /// Changes what matches within a link.
  void in_link(const std::string& name, const std::string& pattern, const auto& by) {
    const std::size_t begin = urdf_.find("<link name=\"" + name + "\""),
                      end = urdf_.find("</link>", begin);
    std::string link = urdf_.substr(begin, end - begin), changed;
    for (std::smatch match; std::regex_search(link, match, std::regex(pattern));
         link = match.suffix())
      changed += match.prefix().str() + by(match.str());
    urdf_.replace(begin, end - begin, changed + link);
  }
};

TEST_F(InertiaChecks, masses_in_grams) {
  multiply_masses(1000.0);
  const Diagnosis robot = diagnosis();
  EXPECT_TRUE(holds(robot.findings.front().remedy, "are the masses in g?"));
  EXPECT_FALSE(has(robot, Severity::warning, "the inertia is too small for the mass"));
  EXPECT_FALSE(has(robot, Severity::error, "to stand takes more torque"));
}

TEST_F(InertiaChecks, one_mass_in_grams) {
  change("<link name=\"RF_THIGH\"", "<mass value=\"1.634976467\"", "<mass value=\"1635\"");
  const Finding first = diagnosis().findings.front();
  EXPECT_EQ(first.subject, "link \"RF_THIGH\"");
  EXPECT_TRUE(holds(first.what, "it has 1635 of the 1664 kg of all links"));
}

TEST_F(InertiaChecks, inertia_in_square_millimetres) {
  change("<link name=\"RF_THIGH\"", "ixx=\"0.0", "ixx=\"12036.");
  change("<link name=\"RF_THIGH\"", "iyy=\"0.0", "iyy=\"12064.");
  change("<link name=\"RF_THIGH\"", "izz=\"0.00249", "izz=\"2494.");
  EXPECT_TRUE(
      has(diagnosis(), Severity::error, "link \"RF_THIGH\": its radius of gyration, √(I/m), is"));
}

TEST_F(InertiaChecks, inertia_of_a_thigh_that_is_thirty_times_too_large) {
  in_link("LF_THIGH", "i(xx|yy|zz)=\"[^\"]*\"",
          [](const std::string& entry) { return entry.substr(0, 5) + "0.4\""; });
  EXPECT_TRUE(has(diagnosis(), Severity::warning, "the inertia is too large for the mass"));
}

TEST_F(InertiaChecks, inertia_that_is_the_same_everywhere) {
  replace_all("<inertia [^>]*>",
              "<inertia ixx=\"0.001\" iyy=\"0.001\" izz=\"0.001\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/>");
  EXPECT_TRUE(has(diagnosis(), Severity::warning, "have the same inertia, 0.001, 0.001, 0.001"));
}

TEST_F(InertiaChecks, inertias_in_square_millimetres_are_one_finding) {
  urdf_ = std::regex_replace(urdf_, std::regex("(i[xyz][xyz]=\"[^\"e]*)\""), "$1e6\"");
  const Diagnosis robot = diagnosis();
  const Finding found = finding(robot, Severity::error, "too large for the mass");
  EXPECT_TRUE(holds(found.what, "; so it is with LF_HIP"));
  EXPECT_EQ(std::ranges::count(robot.findings, found.remedy, &Finding::remedy), 1);
}

TEST_F(InertiaChecks, mass_of_0_beside_an_inertia) {
  change("<link name=\"LF_SHANK\"", "<mass value=\"0.207204302\"", "<mass value=\"0\"");
  const Finding first = diagnosis().findings.front();
  EXPECT_EQ(first.what, "its mass is 0, and its inertia is not");
  EXPECT_EQ(first.remedy, "correct <mass value>: a number above 0 is valid");
  EXPECT_GT(first.line, 0);
}

TEST_F(InertiaChecks, mass_without_an_inertia_counts_as_a_point) {
  in_link("LF_SHANK", "i[xyz][xyz]=\"[^\"]*\"",
          [](const std::string& entry) { return entry.substr(0, 3) + "=\"0\""; });
  EXPECT_TRUE(has(diagnosis(), Severity::warning,
                  "link \"LF_SHANK\": it moves, but its inertia is 0: its 0.207 kg count as a"));
}

TEST_F(InertiaChecks, link_whose_mass_is_only_that_of_what_is_fixed_to_it) {
  in_link("LF_SHANK", "<inertial>[^]*?</inertial>",
          [](const std::string&) { return std::string(); });
  EXPECT_TRUE(has(diagnosis(), Severity::warning,
                  "link \"LF_SHANK\": it moves, but its <inertial> is missing or 0"));
}

TEST_F(InertiaChecks, link_without_mass) {
  in_link("LF_THIGH", "<inertial>[^]*?</inertial>",
          [](const std::string&) { return std::string(); });
  const Finding found = finding(diagnosis(), Severity::error, "has no mass");
  EXPECT_EQ(found.subject, "link \"LF_THIGH\"");
  EXPECT_GT(found.line, 0);
}

TEST_F(InertiaChecks, negative_mass) {
  change("<link name=\"LF_THIGH\"", "<mass value=\"", "<mass value=\"-");
  EXPECT_TRUE(has(diagnosis(), Severity::error, "link \"LF_THIGH\": its mass is negative"));
}

TEST_F(InertiaChecks, a_placeholder_of_the_root_is_told_once) {
  const Diagnosis robot = diagnosis();
  EXPECT_TRUE(has(robot, Severity::note, "the root's inertia is a placeholder"));
  EXPECT_FALSE(has(robot, Severity::note, "walk_flat: root link"));
}

TEST_F(InertiaChecks, negative_inertia) {
  change("<link name=\"LF_THIGH\"", "ixx=\"", "ixx=\"-");
  EXPECT_TRUE(
      has(diagnosis(), Severity::error, "link \"LF_THIGH\": its inertia has a negative principal"));
}

}  // namespace
}  // namespace surefoot::doctor
