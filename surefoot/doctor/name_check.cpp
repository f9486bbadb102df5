#include "surefoot/doctor/checks.hpp"

#include <algorithm>
#include <cctype>
#include <string>
#include <utility>

namespace surefoot::doctor {
namespace {

/// The leg that a joint's name begins with, as robots are used to be described.
std::optional<Leg> leg_called(const std::string& joint, int num_legs) {
  std::string begin = joint.substr(0, 3);
  std::ranges::transform(begin, begin.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const auto& [prefix, leg] : {std::pair{"lf_", Leg::LF},
                                    {"fl_", Leg::LF},
                                    {"rf_", Leg::RF},
                                    {"fr_", Leg::RF},
                                    {"lh_", Leg::LH},
                                    {"hl_", Leg::LH},
                                    {"rl_", Leg::LH},
                                    {"rh_", Leg::RH},
                                    {"hr_", Leg::RH},
                                    {"rr_", Leg::RH}}) {
    if (begin == prefix)
      return is_front(leg) ? leg : static_cast<Leg>(static_cast<int>(leg) + num_legs - kNumLegs);
  }
  return std::nullopt;
}

}  // namespace

void check_names(Diagnosis& robot) {
  if (!robot.anatomy.legs) return;
  const int num_legs = static_cast<int>(robot.anatomy.legs->size());
  for (const Leg leg : robot.anatomy.legs->legs()) {
    const model::UrdfJoint& joint = (*robot.anatomy.legs)[index(leg)].joints[0];
    const std::optional<Leg> called = leg_called(joint.name, num_legs);
    if (!called || *called == leg) continue;
    robot.findings.push_back(
        {Severity::warning, Confidence::guess, "joint \"" + joint.name + "\"", joint.line,
         "by its name it belongs to " + std::string(leg_name(*called, num_legs)) +
             ", but its hip is at the place of " + std::string(leg_name(leg, num_legs)) +
             "; places count",
         "does the base look along x, with y to the left?"});
  }
}

}  // namespace surefoot::doctor
