#include "surefoot/doctor/anatomy.hpp"

#include "surefoot/doctor/found_feet.hpp"
#include "surefoot/doctor/found_flat_legs.hpp"
#include "surefoot/doctor/found_legs.hpp"
#include "surefoot/model/placing_joints.hpp"

#include <utility>

namespace surefoot::doctor {
namespace {

bool is_hinge(const model::UrdfJoint& joint) {
  return joint.type == "revolute" || joint.type == "continuous";
}

/// Collects what moves behind a joint, and says why it is no leg.
class LimbFinder {
 public:
  LimbFinder(const model::Urdf& urdf, const std::map<std::string, model::Weld>& welds)
      : urdf_(urdf), welds_(welds) {}

  [[nodiscard]] std::vector<model::UrdfJoint> moving_from(const std::string& body) const {
    std::vector<model::UrdfJoint> joints;
    for (const model::UrdfJoint& joint : urdf_.joints) {
      if (joint.type != "fixed" && welds_.at(joint.parent).body == body) joints.push_back(joint);
    }
    return joints;
  }

  [[nodiscard]] Limb limb(const model::UrdfJoint& first) const {
    Limb limb;
    collect(first, limb);
    if (!limb.no_leg.empty()) return limb;
    if (limb.joints.size() < kJointsPerLeg) add_held(limb);
    if (!limb.no_leg.empty()) return limb;
    limb.is_chain = true;
    if (limb.joints.size() != kJointsPerLeg)
      limb.no_leg = "it has " + std::to_string(limb.joints.size()) + " joints, a leg has 3";
    return limb;
  }

 private:
  void collect(const model::UrdfJoint& joint, Limb& limb) const {
    limb.joints.push_back(joint);
    if (!is_hinge(joint)) limb.no_leg = "joint \"" + joint.name + "\" is " + joint.type;
    const std::vector<model::UrdfJoint> next = moving_from(joint.child);
    if (next.size() > 1) limb.no_leg = "it branches behind joint \"" + joint.name + "\"";
    for (const model::UrdfJoint& child : next) collect(child, limb);
  }

  /// What might be a leg, but for a joint that follows another or slides.
  void add_held(Limb& limb) const {
    for (const model::UrdfJoint& joint : urdf_.joints) {
      const std::string& parent = welds_.at(joint.parent).body;
      const bool is_behind =
          std::ranges::find(limb.joints, parent, &model::UrdfJoint::child) != limb.joints.end();
      if (joint.held_type.empty() || !is_behind) continue;
      limb.no_leg = "joint \"" + joint.name + "\" " +
                    (joint.mimics.empty() ? "is " + joint.held_type : "mimics another");
      limb.joints.push_back(joint);
    }
  }

  const model::Urdf& urdf_;
  const std::map<std::string, model::Weld>& welds_;
};

bool can_place(const Limb& limb) { return limb.placing.size() == kJointsPerLeg; }

/// Of chains with more joints than three.
void find_placing_joints(const model::Urdf& urdf, const std::string& base,
                         std::vector<Limb>& limbs) {
  for (Limb& limb : limbs) {
    const std::size_t num_joints = limb.joints.size();
    if (!limb.is_chain || num_joints <= kJointsPerLeg || num_joints > kMaxLegJoints) continue;
    std::vector<const model::UrdfJoint*> chain;
    for (const model::UrdfJoint& joint : limb.joints) chain.push_back(&joint);
    for (const model::UrdfJoint* joint : model::placing_joints(urdf, base, chain))
      limb.placing.push_back(*joint);
  }
}

/// As if the further joints of legs were fixed at 0.
model::Urdf with_further_joints_held(model::Urdf urdf, const std::vector<Limb>& limbs) {
  const auto is_among = [](const std::vector<model::UrdfJoint>& joints, const std::string& name) {
    return std::ranges::find(joints, name, &model::UrdfJoint::name) != joints.end();
  };
  for (const Limb& limb : limbs) {
    for (model::UrdfJoint& joint : urdf.joints) {
      if (can_place(limb) && is_among(limb.joints, joint.name) &&
          !is_among(limb.placing, joint.name))
        joint.type = "fixed";
    }
  }
  return urdf;
}

/// Four limbs or more of as many hinges, and more than three, are legs if three joints of each can
/// place its foot. From the other limbs to the legs.
void take_long_legs(Anatomy& anatomy, std::vector<Limb>& legs) {
  for (std::size_t num_joints = kJointsPerLeg + 1; num_joints <= kMaxLegJoints; ++num_joints) {
    std::vector<Limb*> alike;
    for (Limb& limb : anatomy.others)
      if (limb.is_chain && limb.joints.size() == num_joints) alike.push_back(&limb);
    if (alike.size() < kNumLegs) continue;
    const bool are_legs = std::ranges::all_of(alike, [](Limb* limb) { return can_place(*limb); });
    for (Limb* limb : alike) {
      if (are_legs) {
        limb->no_leg.clear();
      } else if (!can_place(*limb)) {
        limb->no_leg += ", and no three turn about x, y and y of the base";
      }
    }
  }
  for (const Limb& limb : anatomy.others)
    if (limb.no_leg.empty()) legs.push_back(limb);
  std::erase_if(anatomy.others, [](const Limb& limb) { return limb.no_leg.empty(); });
}

std::string heaviest_link(const model::Urdf& urdf, const Anatomy& anatomy) {
  const model::UrdfLink* heaviest = urdf.find_link(anatomy.base);
  for (const model::UrdfLink& link : urdf.links) {
    if (anatomy.welds.at(link.name).body != anatomy.base) continue;
    if (link.inertia.mass > heaviest->inertia.mass) heaviest = &link;
  }
  return heaviest->name;
}

/// A massless root before a joint that carries the whole robot is a world, not a base.
void find_base(const model::Urdf& urdf, const LimbFinder& finder, Anatomy& anatomy,
               Findings& findings) {
  anatomy.root = anatomy.base = urdf.root;
  const std::vector<model::UrdfJoint> from_root = finder.moving_from(urdf.root);
  if (from_root.size() != 1 || finder.moving_from(from_root.front().child).size() < 2) return;
  const model::UrdfJoint& joint = from_root.front();
  anatomy.base = joint.child;
  findings.push_back(
      {Severity::error, Confidence::certain, "joint \"" + joint.name + "\"", joint.line,
       "the whole robot hangs on this " + joint.type + " joint of the root \"" + urdf.root +
           "\", but the base must be the root",
       "take joint and root link out of the URDF, so that \"" + joint.child + "\" is the root"});
}

std::string remedy_of(const Limb& limb, const model::Urdf& urdf) {
  const std::string fixed = std::string(urdf.text.empty() ? "set type=\"fixed\" at these joints"
                                                          : "take these <joint>s out of the MJCF") +
                            "; the limb is then part of its parent";
  const bool mimics = std::ranges::any_of(
      limb.joints, [](const model::UrdfJoint& joint) { return !joint.mimics.empty(); });
  if (mimics)
    return "if it is a leg, take out <mimic>: each of its joints has a drive of its own; else " +
           fixed;
  const bool is_hinged = std::ranges::all_of(limb.joints, is_hinge);
  if (!is_hinged && limb.joints.size() == kJointsPerLeg)
    return "if it is a leg, set type=\"revolute\" (or continuous) at each joint; else " + fixed;
  if (limb.is_chain) return "a leg must have three joints: add what is missing; else " + fixed;
  return fixed;
}

/// Parts a limb that branches into chains of hinges, each from the base or a chain before it. Empty
/// if a joint of it is no hinge.
std::vector<Limb> chains_of(const Limb& limb, const std::map<std::string, model::Weld>& welds) {
  std::vector<Limb> chains;
  const auto parent = [&](const model::UrdfJoint& joint) { return welds.at(joint.parent).body; };
  for (const model::UrdfJoint& joint : limb.joints) {
    if (!is_hinge(joint)) return {};
    const auto siblings = std::ranges::count_if(
        limb.joints, [&](const auto& other) { return parent(other) == parent(joint); });
    const bool goes_on =
        siblings == 1 && !chains.empty() && chains.back().joints.back().child == parent(joint);
    if (!goes_on)
      chains.push_back({.joints = {}, .placing = {}, .no_leg = limb.no_leg, .is_chain = true});
    chains.back().joints.push_back(joint);
  }
  return chains;
}

/// Where the legs are known, other chains are arms; where not, only those too long for a leg, and
/// fewer than a robot has legs.
void name_arms(Anatomy& anatomy) {
  std::vector<Limb> limbs;
  for (const Limb& limb : anatomy.others) {
    const std::vector<Limb> chains =
        has_legs(anatomy) ? chains_of(limb, anatomy.welds) : std::vector<Limb>();
    if (chains.empty()) limbs.push_back(limb);
    limbs.insert(limbs.end(), chains.begin(), chains.end());
  }
  const auto is_single = [&](const Limb& limb) {
    return std::ranges::count_if(limbs, [&](const Limb& other) {
             return other.joints.size() == limb.joints.size();
           }) < kNumLegs;
  };
  for (Limb& limb : limbs) {
    const bool is_long = limb.joints.size() > kJointsPerLeg && is_single(limb);
    limb.is_arm = limb.is_chain && (has_legs(anatomy) || is_long);
  }
  anatomy.others = std::move(limbs);
}

/// Limbs that may be legs of another build are told together.
bool may_be_legs(const Limb& limb, const Anatomy& anatomy) {
  return !has_legs(anatomy) && limb.is_chain && !limb.is_arm &&
         std::ranges::count_if(anatomy.others, [&](const Limb& other) {
           return other.is_chain && other.joints.size() == limb.joints.size();
         }) >= kNumLegs;
}

void tell_others(const model::Urdf& urdf, const Anatomy& anatomy,
                 const std::vector<model::ArmDescription>& known, Findings& findings) {
  for (const Limb& limb : anatomy.others) {
    if (may_be_legs(limb, anatomy)) continue;
    std::string names;
    for (const model::UrdfJoint& joint : limb.joints) names += " " + joint.name;
    const model::UrdfJoint& first = limb.joints.front();
    if (limb.is_arm && std::ranges::any_of(known, [&](const model::ArmDescription& arm) {
          return std::ranges::find(arm.joints, first.name) != arm.joints.end();
        }))
      continue;
    if (limb.is_arm) {
      const std::string& last = limb.joints.back().child;
      const bool is_waist = std::ranges::any_of(anatomy.others, [&](const Limb& other) {
        return anatomy.welds.at(other.joints.front().parent).body == last;
      });
      findings.push_back(
          {Severity::note, Confidence::likely, "joint \"" + first.name + "\"", first.line,
           (is_waist ? "what carries arms begins here, a waist perhaps:" : "an arm begins here:") +
               names,
           "give it a posture under `arms:` in the robot file, or make its joints "
           "fixed"});
      continue;
    }
    findings.push_back({Severity::error, Confidence::certain, "joint \"" + first.name + "\"",
                        first.line,
                        "the limb that begins here is neither a leg (" + limb.no_leg +
                            ") nor an arm, a chain of hinges:" + names,
                        remedy_of(limb, urdf)});
  }
}

}  // namespace

Anatomy find_anatomy(const model::Urdf& urdf, Findings& findings,
                     const std::vector<model::ArmDescription>& known) {
  Anatomy anatomy;
  anatomy.welds = model::welds(urdf);
  const LimbFinder finder(urdf, anatomy.welds);
  find_base(urdf, finder, anatomy, findings);
  anatomy.torso = heaviest_link(urdf, anatomy);
  std::vector<Limb> limbs;
  for (const model::UrdfJoint& joint : finder.moving_from(anatomy.base)) {
    Limb limb = finder.limb(joint);
    if (limb.no_leg.empty()) limb.placing = limb.joints;
    (limb.no_leg.empty() ? limbs : anatomy.others).push_back(std::move(limb));
  }
  find_placing_joints(urdf, anatomy.base, anatomy.others);
  const model::Urdf held = with_further_joints_held(urdf, anatomy.others);
  const std::map<std::string, model::Weld> welds = model::welds(held);
  const FootFinder feet(held, welds);
  const auto measured = [&](const std::vector<Limb>& of) {
    std::vector<FoundLeg> legs;
    for (const Limb& limb : of)
      if (can_place(limb)) legs.push_back(measured_leg(limb, welds, feet));
    return legs;
  };
  if (limbs.size() < kNumLegs) find_flat_legs(urdf, measured(limbs), anatomy);
  if (!anatomy.flat_legs) take_long_legs(anatomy, limbs);
  std::vector<FoundLeg> legs = measured(limbs);
  if (!anatomy.flat_legs) add_unequal(measured(anatomy.others), legs, anatomy);
  keep_lowest(legs, anatomy);
  Findings of_legs;
  if (anatomy.flat_legs) {
    for (const FoundLeg& leg : legs) {
      anatomy.others.push_back(
          {.joints = leg.all_joints, .placing = {}, .no_leg = "", .is_chain = true});
    }
  } else {
    name_legs(legs, urdf, anatomy, of_legs);
  }
  name_arms(anatomy);
  tell_others(urdf, anatomy, known, findings);
  findings.insert(findings.end(), of_legs.begin(), of_legs.end());
  return anatomy;
}

}  // namespace surefoot::doctor
