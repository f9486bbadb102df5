#include "surefoot/doctor/found_legs.hpp"

#include "surefoot/base/formatted.hpp"
#include "surefoot/doctor/found_feet.hpp"
#include "surefoot/doctor/part_list.hpp"
#include "surefoot/model/joints_as_written.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>

namespace surefoot::doctor {
namespace {

constexpr const char* kNameJoints =
    "name by `joints` in the robot file those that place the foot (docs/robots.md, further joints)";

Limb limb_of(const FoundLeg& leg, const char* why) {
  return {.joints = leg.all_joints, .placing = {}, .no_leg = why, .is_chain = true};
}

/// Limbs of as many hinges each, but not of three: legs of another build.
bool tell_other_legs(const Anatomy& anatomy, Findings& findings) {
  for (const Limb& limb : anatomy.others) {
    const auto is_alike = [&](const Limb& other) {
      return other.is_chain && other.joints.size() == limb.joints.size();
    };
    const auto count = std::ranges::count_if(anatomy.others, is_alike);
    if (!limb.is_chain || count < kNumLegs) continue;
    std::string last, wrong;
    for (const Limb& other : anatomy.others) {
      if (!is_alike(other)) continue;
      last += " " + other.joints.back().name;
      if (other.placing.size() < kJointsPerLeg) wrong += " " + other.joints.front().name;
    }
    const std::string hinges = std::to_string(limb.joints.size()) + " hinges";
    findings.push_back(
        {Severity::error, Confidence::certain, "joint \"" + limb.joints.front().name + "\"",
         limb.joints.front().line,
         "here begins one of " + std::to_string(count) + " limbs of " + hinges +
             " each; no three of them turn about x, y and y of the base, as HAA, HFE and KFE, in "
             "those that begin with" +
             wrong,
         limb.joints.size() > kJointsPerLeg
             ? std::string("if they are legs, ") + kNameJoints +
                   ", or make fixed what they can walk without:" + last
             : "if they are legs, they can't walk with this program"});
    return true;
  }
  return false;
}

void tell_too_many(const std::vector<FoundLeg>& legs, Findings& findings) {
  std::string names;
  for (const FoundLeg& leg : legs) names += " " + leg.joints[0].name;
  findings.push_back({Severity::error, Confidence::certain, "legs", 0,
                      "the base has " + std::to_string(legs.size()) +
                          " limbs of three hinges that reach as low, beginning at" + names +
                          "; valid are four or six legs",
                      "take out the legs beyond six, or make their joints fixed"});
}

void tell_too_few(const std::vector<FoundLeg>& legs, Findings& findings) {
  std::string names;
  for (const FoundLeg& leg : legs) names += " " + leg.joints[0].name;
  findings.push_back({Severity::error, Confidence::certain, "legs", 0,
                      "the base has " + std::to_string(legs.size()) +
                          " limbs of exactly three hinges" +
                          (names.empty() ? "" : ", beginning at" + names) +
                          ", but a robot that walks has four or six legs",
                      "each leg must be three revolute joints, one behind the other; make fixed "
                      "what does not move, and add what is missing; of legs with further joints " +
                          std::string(kNameJoints)});
}

/// The legs' axes tell where the base looks, even if the places of the hips do not.
void check_heading(const Anatomy& anatomy, const model::Urdf& urdf, Findings& findings) {
  Vec3 sideways = Vec3::Zero();
  for (const FoundLeg& leg : *anatomy.legs) {
    const model::Hinge& haa = leg.chain.hinges[0];
    const model::Hinge& hfe = leg.chain.hinges[1];
    sideways += (haa.R * hfe.R * hfe.axis).cwiseAbs();
  }
  if (sideways.y() >= sideways.x() && sideways.y() >= sideways.z()) return;
  if (tell_missing_axes({anatomy.legs->begin(), anatomy.legs->end()}, urdf, findings)) return;
  findings.push_back({Severity::error, Confidence::likely, "link \"" + anatomy.base + "\"", 0,
                      "most HFE axes do not lie along y of the base; x must point forward and z up",
                      "turn the base's frame, or its joints' origins, by 90°", true});
}

void check_origin(const Anatomy& anatomy, Findings& findings) {
  const int num_legs = static_cast<int>(anatomy.legs->size());
  for (const Leg leg : anatomy.legs->legs()) {
    const FoundLeg& found = (*anatomy.legs)[index(leg)];
    const bool is_middle = !is_front(leg) && !is_hind(leg, num_legs);
    if ((is_middle || is_front(leg) == (found.tip.x() > 0.0)) &&
        is_left(leg) == (found.tip.y() > 0.0))
      continue;
    findings.push_back({Severity::error, Confidence::certain, "link \"" + found.foot.link + "\"",
                        found.foot.line,
                        formatted("the foot of %s is at x = %.3g, y = %.3g m, so the base's origin "
                                  "is not between the legs",
                                  leg_name(leg, num_legs).data(), found.tip.x(), found.tip.y()),
                        "move the base's frame between the hips"});
  }
}

/// Joints of legs that the program holds, and does not walk with.
void tell_held(const Anatomy& anatomy, Findings& findings) {
  std::string names;
  int line = 0;
  for (const FoundLeg& leg : *anatomy.legs) {
    for (const model::UrdfJoint& joint : leg.further()) {
      if (line == 0) line = joint.line;
      names += " " + joint.name;
    }
  }
  if (names.empty()) return;
  findings.push_back({Severity::note, Confidence::likely, "joints", line,
                      "three joints of each leg place its foot; the others are held at 0, or the "
                      "limit next to it:" +
                          names,
                      "`further` in the robot file gives them a posture, `joints` says which three "
                      "place the foot"});
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

bool tell_missing_axes(const std::vector<FoundLeg>& legs, const model::Urdf& urdf,
                       Findings& findings) {
  const std::vector<std::string> without = model::joints_without_axis(urdf);
  PartList list;
  for (const FoundLeg& leg : legs) {
    for (const std::size_t j : {1u, 2u}) {
      if (std::ranges::count(without, leg.joints[j].name) > 0)
        list.add(leg.joints[j], "it has no <axis>, and a URDF then takes x, 1 0 0");
    }
  }
  const std::size_t before = findings.size();
  list.tell(Severity::error, Confidence::likely,
            "add <axis>; that of HFE and KFE is y of the base, 0 1 0", findings, true);
  return findings.size() > before;
}

FoundLeg measured_leg(const Limb& limb, const std::map<std::string, model::Weld>& welds,
                      const FootFinder& feet) {
  FoundLeg leg;
  std::ranges::copy(limb.placing, leg.joints.begin());
  leg.all_joints = limb.joints;
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
  leg.thigh = leg.chain.thigh();
  leg.shank = leg.chain.shank();
  return leg;
}

namespace {

void sort_from_lowest(std::vector<FoundLeg>& legs) {
  std::ranges::stable_sort(legs, {}, [](const FoundLeg& leg) { return leg.tip.z(); });
}

/// Do so many, sorted from the lowest, reach as low, and stand in pairs? Else the upper are arms.
bool are_alike(const std::vector<FoundLeg>& legs, std::size_t num_legs) {
  constexpr double kAsLow = 0.2;  // of the leg's length
  const auto first = std::span(legs).first(num_legs);
  const double length = first.front().thigh + first.front().shank;
  const auto num_left =
      std::ranges::count_if(first, [](const FoundLeg& leg) { return leg.hip.y() > 0.0; });
  return first.back().tip.z() - first.front().tip.z() < kAsLow * length &&
         2 * num_left == std::ssize(first);
}

/// The place of each of six legs: on both sides from the front to the hind one.
PerLeg<const FoundLeg*> by_places(const std::vector<FoundLeg>& legs) {
  std::vector<const FoundLeg*> left, right;
  for (const FoundLeg& leg : legs) (leg.hip.y() > 0.0 ? left : right).push_back(&leg);
  PerLeg<const FoundLeg*> found(kMaxLegs, nullptr);
  for (auto* side : {&left, &right}) {
    std::ranges::sort(*side, std::greater(), [](const FoundLeg* leg) { return leg->hip.x(); });
    for (std::size_t i = 0; i < side->size(); ++i)
      found[2 * i + (side == &left ? 0 : 1)] = (*side)[i];
  }
  return found;
}

/// The place of each of four legs: in the quadrants around their middle; null: none there.
PerLeg<const FoundLeg*> by_quadrants(const std::vector<FoundLeg>& legs) {
  Vec3 middle = Vec3::Zero();
  for (const FoundLeg& leg : legs) middle += leg.hip / kNumLegs;
  PerLeg<const FoundLeg*> found(kNumLegs, nullptr);
  for (const FoundLeg& leg : legs) {
    for (const Leg place : found.legs()) {
      const bool fits = is_front(place) == (leg.hip.x() > middle.x()) &&
                        is_left(place) == (leg.hip.y() > middle.y());
      if (fits) found[index(place)] = &leg;
    }
  }
  return found;
}

}  // namespace

void add_unequal(const std::vector<FoundLeg>& others, std::vector<FoundLeg>& legs,
                 Anatomy& anatomy) {
  std::vector<FoundLeg> all = legs;
  all.insert(all.end(), others.begin(), others.end());
  sort_from_lowest(all);
  for (const std::size_t num_legs : {std::size_t{kMaxLegs}, std::size_t{kNumLegs}}) {
    if (legs.size() >= num_legs || all.size() < num_legs || !are_alike(all, num_legs)) continue;
    all.resize(num_legs);
    for (const FoundLeg& leg : all) {
      const auto begins_alike = [&](const auto& limb) {
        return limb.joints.front().name == leg.all_joints.front().name;
      };
      if (std::erase_if(anatomy.others, begins_alike) > 0) legs.push_back(leg);
    }
    return;
  }
}

void keep_lowest(std::vector<FoundLeg>& legs, Anatomy& anatomy) {
  sort_from_lowest(legs);
  if (legs.size() > kMaxLegs && are_alike(legs, legs.size())) return;  // `name_legs` tells it
  const bool is_hexapod = legs.size() >= kMaxLegs && are_alike(legs, kMaxLegs);
  const std::size_t num_legs = is_hexapod ? kMaxLegs : kNumLegs;
  const char* const why = is_hexapod ? "six others reach lower" : "four others reach lower";
  while (legs.size() > num_legs) {
    anatomy.others.push_back(limb_of(legs.back(), why));
    legs.pop_back();
  }
}

void name_legs(const std::vector<FoundLeg>& legs, const model::Urdf& urdf, Anatomy& anatomy,
               Findings& findings) {
  anatomy.loose = legs;
  const bool is_hexapod = legs.size() == kMaxLegs;
  if (legs.size() > kMaxLegs) return tell_too_many(legs, findings);
  if (!is_hexapod && legs.size() != kNumLegs) {
    if (legs.size() > 1 || !tell_other_legs(anatomy, findings)) tell_too_few(legs, findings);
    return;
  }
  const PerLeg<const FoundLeg*> found = is_hexapod ? by_places(legs) : by_quadrants(legs);
  if (std::ranges::find(found, nullptr) != found.end()) return tell_quadrants(legs, findings);
  anatomy.legs.emplace(static_cast<int>(legs.size()), FoundLeg{});
  for (const Leg leg : found.legs()) (*anatomy.legs)[index(leg)] = *found[index(leg)];
  anatomy.loose.clear();
  tell_held(anatomy, findings);
  check_heading(anatomy, urdf, findings);
  check_origin(anatomy, findings);
}

}  // namespace surefoot::doctor
