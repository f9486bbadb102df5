#include "surefoot/doctor/found_legs.hpp"

#include "surefoot/base/formatted.hpp"
#include "surefoot/doctor/found_feet.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::doctor {
namespace {

double length_across(const Vec3& vector, const Vec3& axis) {
  return (vector - axis * axis.dot(vector)).norm();
}

Limb limb_of(const FoundLeg& leg, const char* why) {
  return {{leg.joints.begin(), leg.joints.end()}, why};
}

void tell_too_few(const std::vector<FoundLeg>& legs, Findings& findings) {
  std::string names;
  for (const FoundLeg& leg : legs) names += " " + leg.joints[0].name;
  findings.push_back(
      {Severity::error, Confidence::certain, "legs", 0,
       "the base has " + std::to_string(legs.size()) + " limbs of exactly three hinges" +
           (names.empty() ? "" : ", beginning at" + names) + ", but the robot needs four legs",
       "each leg must be three revolute joints, one behind the other; make fixed "
       "what does not move, and add what is missing"});
}

/// The legs' axes tell where the base looks, even if the places of the hips do not.
void check_heading(const Anatomy& anatomy, Findings& findings) {
  Vec3 sideways = Vec3::Zero();
  for (const FoundLeg& leg : *anatomy.legs) {
    const model::Hinge& haa = leg.chain.hinges[0];
    const model::Hinge& hfe = leg.chain.hinges[1];
    sideways += (haa.R * hfe.R * hfe.axis).cwiseAbs();
  }
  if (sideways.y() >= sideways.x() && sideways.y() >= sideways.z()) return;
  findings.push_back({Severity::error, Confidence::likely, "link \"" + anatomy.base + "\"", 0,
                      "most HFE axes do not lie along y of the base; x must point forward and z up",
                      "turn the base's frame, or its joints' origins, by 90°", true});
}

void check_origin(const Anatomy& anatomy, Findings& findings) {
  for (const Leg leg : kLegs) {
    const FoundLeg& found = (*anatomy.legs)[index(leg)];
    if (is_front(leg) == (found.tip.x() > 0.0) && is_left(leg) == (found.tip.y() > 0.0)) continue;
    findings.push_back({Severity::error, Confidence::certain, "link \"" + found.foot.link + "\"",
                        found.foot.line,
                        formatted("the foot of %s is at x = %.3g, y = %.3g m, so the base's origin "
                                  "is not between the legs",
                                  kLegNames[index(leg)].data(), found.tip.x(), found.tip.y()),
                        "move the base's frame between the hips"});
  }
}

void tell_quadrants(const std::vector<FoundLeg>& legs, Findings& findings) {
  std::string places;
  for (const FoundLeg& leg : legs) {
    places += formatted(" %s at x = %.3g, y = %.3g m;", leg.joints[0].name.c_str(), leg.hip.x(),
                        leg.hip.y());
  }
  findings.push_back({Severity::error, Confidence::certain, "legs", 0,
                      "the hips are not in four quadrants of the base:" + places +
                          " so it can't be told which leg is which",
                      "the base's x must point forward and y to the left"});
}

}  // namespace

FoundLeg measured_leg(const Limb& limb, const std::map<std::string, model::Weld>& welds,
                      const FootFinder& feet) {
  FoundLeg leg;
  std::ranges::copy(limb.joints, leg.joints.begin());
  for (std::size_t j = 0; j < kJointsPerLeg; ++j) {
    const model::UrdfJoint& joint = leg.joints[j];
    const model::Weld& parent = welds.at(joint.parent);
    leg.chain.hinges[j] = {parent.R * joint.R, parent.p + parent.R * joint.p, joint.axis};
  }
  leg.foot = feet.foot_behind(leg.joints[2]);
  const model::Weld& foot = welds.at(leg.foot.link);
  leg.chain.foot = foot.p + foot.R * leg.foot.center;
  leg.hip = leg.chain.hip_in_base(Vec3::Zero());
  leg.tip = leg.chain.foot_in_base(Vec3::Zero());
  leg.thigh = length_across(leg.chain.hinges[2].p, leg.joints[1].axis);
  leg.shank = length_across(leg.chain.foot, leg.joints[2].axis);
  return leg;
}

void keep_lowest(std::vector<FoundLeg>& legs, Anatomy& anatomy) {
  std::ranges::stable_sort(legs, {}, [](const FoundLeg& leg) { return leg.tip.z(); });
  while (legs.size() > kNumLegs) {
    anatomy.others.push_back(limb_of(legs.back(), "four others reach lower"));
    legs.pop_back();
  }
}

void name_legs(const std::vector<FoundLeg>& legs, Anatomy& anatomy, Findings& findings) {
  anatomy.loose = legs;
  if (legs.size() != kNumLegs) return tell_too_few(legs, findings);
  Vec3 middle = Vec3::Zero();
  for (const FoundLeg& leg : legs) middle += leg.hip / kNumLegs;
  PerLeg<const FoundLeg*> found{};
  for (const FoundLeg& leg : legs) {
    for (const Leg place : kLegs) {
      const bool fits = is_front(place) == (leg.hip.x() > middle.x()) &&
                        is_left(place) == (leg.hip.y() > middle.y());
      if (fits) found[index(place)] = &leg;
    }
  }
  if (std::ranges::find(found, nullptr) != found.end()) return tell_quadrants(legs, findings);
  anatomy.legs.emplace();
  for (const Leg leg : kLegs) (*anatomy.legs)[index(leg)] = *found[index(leg)];
  anatomy.loose.clear();
  check_heading(anatomy, findings);
  check_origin(anatomy, findings);
}

}  // namespace surefoot::doctor
