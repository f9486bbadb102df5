#include "surefoot/base/formatted.hpp"
#include "surefoot/doctor/checks.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

namespace surefoot::doctor {
namespace {

constexpr std::array<std::string_view, 6> kTypes{"revolute", "continuous", "prismatic",
                                                 "fixed",    "floating",   "planar"};
constexpr double kTurn = 2.0 * kPi + 0.1;  // an <origin> turned further is in degrees [rad]

/// Joints with the same fault, told at the first.
Findings at_first(const model::Urdf& urdf, const auto& is_wrong, const auto& what,
                  const std::string& remedy) {
  Findings found;
  for (const model::UrdfJoint& joint : urdf.joints) {
    if (!is_wrong(joint)) continue;
    if (found.empty()) {
      found.push_back({Severity::error, Confidence::certain, "joint \"" + joint.name + "\"",
                       joint.line, what(joint), remedy, true});
    } else {
      found.front().what += (found.front().what.ends_with("\"") ? "; so it is with " : " ");
      found.front().what += joint.name;
    }
  }
  return found;
}

}  // namespace

void check_joints(Diagnosis& robot) {
  Findings found = at_first(
      robot.urdf,
      [](const model::UrdfJoint& joint) { return std::ranges::count(kTypes, joint.type) == 0; },
      [](const model::UrdfJoint& joint) {
        return "a URDF has no joint of type \"" + joint.type + "\"";
      },
      "set type=\"revolute\" (or continuous) for a joint of a limb, type=\"fixed\" for one that "
      "does not move");
  const Findings turned = at_first(
      robot.urdf,
      [](const model::UrdfJoint& joint) { return joint.rpy.cwiseAbs().maxCoeff() > kTurn; },
      [](const model::UrdfJoint& joint) {
        return formatted("its <origin> is turned by more than a turn, rpy=\"%g %g %g\"",
                         joint.rpy.x(), joint.rpy.y(), joint.rpy.z());
      },
      "is rpy in degrees? Expected is rad: 90° is 1.5708");
  found.insert(found.end(), turned.begin(), turned.end());
  if (!found.empty()) robot.findings = found;  // the rest may only follow from it
}

}  // namespace surefoot::doctor
