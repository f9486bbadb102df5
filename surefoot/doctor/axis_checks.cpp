#include "surefoot/base/formatted.hpp"
#include "surefoot/doctor/checks.hpp"
#include "surefoot/doctor/found_legs.hpp"
#include "surefoot/doctor/part_list.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace surefoot::doctor {
namespace {

constexpr double kMostSkew = 0.1;  // of a knee's axis against its hip's [rad]
// Of a hip's axis against the base's: a warning, an error [rad].
constexpr double kOddAngle = 0.2, kWrongAngle = 0.7;

/// The axis of HAA or HFE in B at q = 0.
Vec3 axis_in_base(const FoundLeg& leg, std::size_t joint) {
  Mat3 R = leg.chain.hinges[0].R;
  if (joint == 1) R = R * leg.chain.hinges[1].R;
  return R * leg.chain.hinges[joint].axis;
}

/// The hips' joints of one kind that turn about another axis than the base's, in one finding.
void check_hips(Diagnosis& robot, std::size_t joint) {
  const bool is_haa = joint == 0;
  const Vec3 wanted = is_haa ? Vec3::UnitX() : Vec3::UnitY();
  PartList odd;
  double most = 0.0;
  for (const FoundLeg& leg : *robot.anatomy.legs) {
    const double share = std::abs(axis_in_base(leg, joint).dot(wanted));
    const double angle = std::acos(std::min(1.0, share));
    if (angle < kOddAngle) continue;
    most = std::max(most, angle);
    odd.add(
        leg.joints[joint],
        formatted("the axis of %s is turned by %.3g rad against %s of the base; %s",
                  kJointNames[joint].data(), angle, is_haa ? "x" : "y",
                  is_haa ? "HAA must swing the leg sideways" : "HFE must swing the leg forward"));
  }
  const bool is_wrong = most > kWrongAngle;
  odd.tell(is_wrong ? Severity::error : Severity::warning, Confidence::likely,
           formatted("correct its <axis>, %s in the base's frame is valid, or the rpy of its "
                     "<origin>",
                     is_haa ? "1 0 0" : "0 1 0"),
           robot.findings, is_wrong);
}

void check_knees(Diagnosis& robot) {
  for (const FoundLeg& leg : *robot.anatomy.legs) {
    if (leg.chain.knee_skew() < kMostSkew) continue;
    robot.findings.push_back(
        {Severity::error, Confidence::likely, "joint \"" + leg.joints[2].name + "\"",
         leg.joints[2].line,
         formatted("the knee's axis is turned by %.3g rad against that of \"%s\"; both must bend "
                   "the leg in one plane",
                   leg.chain.knee_skew(), leg.joints[1].name.c_str()),
         "correct its <axis>, or the rpy of its <origin>", true});
  }
}

/// Of legs whose HFE and KFE do not both turn about y.
bool check_missing(Diagnosis& robot) {
  std::vector<FoundLeg> odd;
  for (const FoundLeg& leg : *robot.anatomy.legs) {
    const double share = std::abs(axis_in_base(leg, 1).dot(Vec3::UnitY()));
    if (leg.chain.knee_skew() >= kMostSkew || share < std::cos(kWrongAngle)) odd.push_back(leg);
  }
  return !odd.empty() && tell_missing_axes(odd, robot.urdf, robot.findings);
}

/// Legs that reach up.
void check_up(Diagnosis& robot) {
  const PerLeg<FoundLeg>& legs = *robot.anatomy.legs;
  std::string names;
  const FoundLeg* first = nullptr;
  for (const Leg leg : legs.legs()) {
    const FoundLeg& found = legs[index(leg)];
    if (found.tip.z() <= found.hip.z()) continue;
    if (first == nullptr) first = &found;
    names += " " + std::string(leg_name(leg, static_cast<int>(legs.size())));
  }
  if (first == nullptr) return;
  robot.findings.push_back(
      {Severity::error, Confidence::likely, "link \"" + first->foot.link + "\"", first->foot.line,
       "with all joints at 0 the foot is above the hip in" + names,
       "does z of the base point up? Else look at the <origin> of the leg's joints: all angles at "
       "0 must leave the legs below the base",
       true});
}

}  // namespace

void check_axes(Diagnosis& robot) {
  if (!robot.anatomy.legs || check_missing(robot)) return;
  check_knees(robot);
  if (has_cause(robot.findings)) return;
  check_hips(robot, 0);
  check_hips(robot, 1);
  if (!has_cause(robot.findings)) check_up(robot);
}

}  // namespace surefoot::doctor
