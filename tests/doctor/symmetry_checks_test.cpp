// A leg that is not as its mirror image gives a finding.
#include "surefoot/doctor/checks.hpp"
#include "tests/doctor/changed_robot.hpp"
#include "tests/support/messages.hpp"

namespace surefoot::doctor {
namespace {

using test::finding;
using test::has;
using test::holds;

using Symmetry = test::ChangedRobot;

TEST_F(Symmetry, leg_that_is_longer_than_its_mirror_image) {
  change("<joint name=\"RF_KFE\"", "-0.25\"", "-0.28\"");
  EXPECT_TRUE(has(diagnosis(), Severity::warning, "LF and RF, thigh, HFE axis to KFE axis"));
}

/// A change of one joint or link, and what is told of it.
struct Lopsided {
  const char *what, *behind, *from, *to, *told;
};

class EachLopsided : public test::ChangedRobot, public testing::WithParamInterface<Lopsided> {};

TEST_P(EachLopsided, is_told_of_the_leg_that_the_others_are_not_like) {
  const Lopsided& one = GetParam();
  for (const std::string leg : {"LF", "RF", "LH", "RH"}) {
    const std::string sound = urdf_;
    const auto of_leg = [&](std::string text) {
      return std::regex_replace(text, std::regex("LF"), leg);
    };
    change(of_leg(one.behind), one.from, one.to);
    const Finding found = finding(diagnosis(), Severity::warning, one.told);
    EXPECT_TRUE(holds(found.what, "left and right differ")) << leg;
    EXPECT_TRUE(holds(found.what, "the other legs are as")) << leg;
    EXPECT_TRUE(holds(found.subject, "\"" + leg + "_")) << found.what;
    urdf_ = sound;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Each, EachLopsided,
    testing::Values(Lopsided{"Length", "<joint name=\"LF_KFE\"", "-0.25\"", "-0.28\"",
                             "thigh, HFE axis to KFE"},
                    Lopsided{"Mass", "<link name=\"LF_THIGH\"", "<mass value=\"1.634976467\"",
                             "<mass value=\"0.6\"", "mass that HFE moves"},
                    Lopsided{"Effort", "<joint name=\"LF_HFE\"", " effort=\"80\"", " effort=\"40\"",
                             "effort limit of HFE"},
                    Lopsided{"Velocity", "<joint name=\"LF_HFE\"", " velocity=\"15.0\"",
                             " velocity=\"8\"", "velocity limit of HFE"},
                    Lopsided{"Limits", "<joint name=\"LF_HFE\"", "lower=\"-9.42\"", "lower=\"-1\"",
                             "position limits of HFE"},
                    Lopsided{"Zero", "<joint name=\"LF_KFE\"", "<origin ",
                             "<origin rpy=\"0 0.35 0\" ", "shank at the joints' 0"},
                    Lopsided{"Com", "<link name=\"LF_THIGH\"", "-0.214583373795\"", "-0.05\"",
                             "centre of mass of what HFE moves"},
                    Lopsided{"Inertia", "<link name=\"LF_THIGH\"", "ixx=\"0.012", "ixx=\"0.4",
                             "inertia of what HFE moves"}),
    [](const auto& each) { return each.param.what; });

TEST_F(Symmetry, hip_at_the_wrong_place) {
  change("<joint name=\"RH_HAA\"", "xyz=\"-0.277 -0.116", "xyz=\"-0.247 -0.116");
  EXPECT_TRUE(has(diagnosis(), Severity::warning, "LH and RH, place of the hip"));
}

}  // namespace
}  // namespace surefoot::doctor
