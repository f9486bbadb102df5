#include "surefoot/base/formatted.hpp"
#include "surefoot/doctor/checks.hpp"
#include "surefoot/doctor/part_list.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace surefoot::doctor {
namespace {

constexpr std::array<std::string_view, 6> kTypes{"revolute", "continuous", "prismatic",
                                                 "fixed",    "floating",   "planar"};
constexpr double kMostOriginTurn = 2.0 * kPi + 0.1;  // of an <origin>: more is in degrees [rad]

}  // namespace

void check_joints(Diagnosis& robot) {
  PartList unknown, turned;
  const bool is_mjcf = !robot.urdf.text.empty();
  for (const model::UrdfJoint& joint : robot.urdf.joints) {
    if (std::ranges::count(kTypes, joint.type) == 0)
      unknown.add(joint, is_mjcf
                             ? "its type is \"" + joint.type + "\", and a leg or an arm has hinges"
                             : "a URDF has no joint of type \"" + joint.type + "\"");
    if (joint.rpy.cwiseAbs().maxCoeff() > kMostOriginTurn) {
      turned.add(joint, formatted("its <origin> is turned by more than a turn, rpy=\"%g %g %g\"",
                                  joint.rpy.x(), joint.rpy.y(), joint.rpy.z()));
    }
  }
  Findings found;
  unknown.tell(Severity::error, Confidence::certain,
               "set type=\"revolute\" (or continuous) for a joint of a limb, type=\"fixed\" for "
               "one that does not move",
               found, true);
  turned.tell(Severity::error, Confidence::certain,
              "is rpy in degrees? Expected is rad: 90° is 1.5708", found, true);
  if (!found.empty()) robot.findings = found;  // the rest may only follow from it
}

}  // namespace surefoot::doctor
