#include "surefoot/model/body_tree.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/base/formatted.hpp"

#include <algorithm>
#include <map>
#include <ranges>

namespace surefoot::model {
namespace {

constexpr int kBaseBody = 0;
int body_of(Leg leg, int joint) { return 1 + first_joint(leg) + joint; }

/// The body that a link belongs to, and the link's frame in it.
using Placement = BodyFrame;

std::string known_links(const Urdf& urdf) {
  std::string names;
  for (const UrdfLink& link : urdf.links) names += " " + link.name;
  return names;
}

std::string known_joints(const Urdf& urdf) {
  std::string names;
  for (const UrdfJoint& joint : urdf.joints) {
    if (joint.type != "fixed") names += " " + joint.name;
  }
  return names;
}

void check_joint(const Urdf& urdf, const std::string& name, const std::string& limb) {
  const auto found = std::ranges::find(urdf.joints, name, &UrdfJoint::name);
  if (found == urdf.joints.end()) {
    throw UnknownNameError("unknown joint \"" + name + "\"; the robot has:" + known_joints(urdf));
  }
  const std::string& type = found->held_type.empty() ? found->type : found->held_type;
  if (type != "revolute" && type != "continuous") {
    throw Error("joint \"" + name + "\" is " + type + "; " + limb + "'s joint must be revolute");
  }
  if (found->mimics.empty()) return;
  throw FileError(urdf.path + ":" + std::to_string(found->line) + ": joint \"" + name +
                  "\" mimics \"" + found->mimics + "\"; " + limb +
                  "'s joints must each have a drive of their own");
}

/// Number of the body behind every described joint.
std::map<std::string, int> described_joints(const RobotDescription& description, const Urdf& urdf) {
  std::map<std::string, int> bodies;
  const auto add = [&](const std::string& name, int body, const std::string& limb) {
    check_joint(urdf, name, limb);
    if (!bodies.emplace(name, body).second) {
      throw Error("joint \"" + name + "\" is named for two places of the robot");
    }
  };
  int body = 1;
  for (const LegDescription& leg : description.legs) {
    for (const std::string& name : leg.joints) add(name, body++, "a leg");
  }
  for (const ArmDescription& arm : description.arms) {
    for (const std::string& name : arm.joints) add(name, body++, "an arm");
  }
  return bodies;
}

/// Walks the tree from its root and collects bodies, hinges and the placement of every link.
class Builder {
 public:
  Builder(const RobotDescription& description, const Urdf& urdf)
      : urdf_(urdf),
        bodies_(described_joints(description, urdf)),
        first_arm_body_(1 + description.num_leg_joints()),
        first_limb_body_(description.can_walk() ? first_arm_body_ : 1) {
    tree_.legs.resize(description.can_walk() ? description.num_legs() : 0);
    tree_.limb_bodies.resize(
        static_cast<std::size_t>(1 + description.num_joints() - first_limb_body_));
    tree_.hips.resize(0);
    tree_.soles.resize(0);
    add_link(urdf.root, Placement());
    check_inertia(*urdf.find_link(urdf.root), tree_.base);
  }

  [[nodiscard]] const BodyTree& tree() const { return tree_; }
  [[nodiscard]] BodyTree& tree() { return tree_; }

  [[nodiscard]] const Placement& placement(const std::string& link) const {
    const auto found = tree_.links.find(link);
    if (found == tree_.links.end()) {
      throw UnknownNameError("unknown frame \"" + link + "\"; the robot has:" + known_links(urdf_));
    }
    return found->second;
  }

 private:
  void add_link(const std::string& name, const Placement& placement) {
    tree_.links[name] = placement;
    Inertia& inertia = inertia_of(placement.body);
    inertia = inertia + urdf_.find_link(name)->inertia.placed(placement.R, placement.p);
    for (const UrdfJoint& joint : urdf_.joints) {
      if (joint.parent == name) add_joint(joint, placement);
    }
  }

  void add_joint(const UrdfJoint& joint, const Placement& parent) {
    const Mat3 R = parent.R * joint.R;
    const Vec3 p = parent.p + parent.R * joint.p;
    const auto described = bodies_.find(joint.name);
    if (described == bodies_.end()) {
      if (joint.type != "fixed") {
        throw FileError(
            urdf_.path + ":" + std::to_string(joint.line) + ": joint \"" + joint.name +
            "\" can move but is not a joint of a leg or an arm of the description; name it under "
            "`arms:`, or make it fixed");
      }
      add_link(joint.child, {parent.body, R, p});
      return;
    }
    const int body = described->second;
    body >= first_limb_body_ ? connect_limb(joint, body, {parent.body, R, p})
                             : connect_leg(joint, body, {parent.body, R, p});
    add_link(joint.child, {body, Mat3::Identity(), Vec3::Zero()});
    check_inertia(*urdf_.find_link(joint.child), inertia_of(body));
  }

  void connect_leg(const UrdfJoint& joint, int body, const Placement& parent) {
    const int place = (body - 1) % kJointsPerLeg;
    if (parent.body != (place == 0 ? kBaseBody : body - 1)) {
      throw Error("joint \"" + joint.name + "\" moves with \"" + joint.parent +
                  "\", which is not what the joint before it in its leg moves; a leg is HAA, HFE "
                  "and KFE, from the base to the foot");
    }
    leg_of(body).chain.hinges[static_cast<std::size_t>(place)] = {parent.R, parent.p, joint.axis};
  }

  /// An arm is on the base, or behind a joint of an arm that comes earlier. Legs: see `add_sole`.
  void connect_limb(const UrdfJoint& joint, int body, const Placement& parent) {
    const bool is_arm = body >= first_arm_body_;
    if (is_arm &&
        (parent.body >= body || (parent.body != kBaseBody && parent.body < first_arm_body_))) {
      throw Error("joint \"" + joint.name +
                  "\" of an arm is neither on the base nor behind a joint named before it");
    }
    limb_body(body) = {parent.body, {parent.R, parent.p, joint.axis}, Inertia()};
  }

  /// `inertia`: of the link and all that is fixed to it.
  void check_inertia(const UrdfLink& link, const Inertia& inertia) const {
    const Vec3 moments = principal_moments(inertia);
    if (inertia.mass <= 0.0) fail(link, "has no mass; it must be above 0");
    if (moments[0] <= 0.0) fail(link, "has no inertia about some axis; all must be above 0");
    if (!obeys_triangle_inequality(moments)) {
      fail(link, formatted("has principal moments of inertia of %.3g, %.3g and %.3g kg·m²; in a "
                           "body none is larger than the sum of the two others",
                           moments[0], moments[1], moments[2]));
    }
  }

  [[noreturn]] void fail(const UrdfLink& link, const std::string& what) const {
    throw FileError(urdf_.path + ":" + std::to_string(link.line) + ": link \"" + link.name +
                    "\" moves, but with all that is fixed to it " + what);
  }

  LimbBody& limb_body(int body) {
    return tree_.limb_bodies[static_cast<std::size_t>(body - first_limb_body_)];
  }

  LegTree& leg_of(int body) {
    return tree_.legs[static_cast<std::size_t>((body - 1) / kJointsPerLeg)];
  }

  Inertia& inertia_of(int body) {
    if (body == kBaseBody) return tree_.base;
    if (body >= first_limb_body_) return limb_body(body).inertia;
    return leg_of(body).inertias[static_cast<std::size_t>((body - 1) % kJointsPerLeg)];
  }

  const Urdf& urdf_;
  const std::map<std::string, int> bodies_;
  const int first_arm_body_, first_limb_body_;
  BodyTree tree_;
};

/// The placement of a link, which must lie between two joints of a leg.
const Placement& require(const Builder& builder, const std::string& link, Leg leg, int first,
                         int last) {
  const int num_legs = static_cast<int>(builder.tree().legs.size());
  const Placement& placement = builder.placement(link);
  if (placement.body < body_of(leg, first) || placement.body > body_of(leg, last)) {
    throw Error("frame \"" + link + "\" is not on the expected part of leg " +
                std::string(leg_name(leg, num_legs)));
  }
  return placement;
}

/// The leg is one chain from the base to the link of its foot.
void add_sole(const RobotDescription& description, Leg leg, Builder& builder) {
  const LegDescription& names = description.legs[index(leg)];
  const JointRange joints = description.leg_joints(leg);
  BodyTree& tree = builder.tree();
  BodyFrame sole = builder.placement(names.foot_frame);
  const int first = joints.first + 1, last = joints.first + joints.count;
  bool is_chain = sole.body == last;
  for (int body = first; body <= last; ++body) {
    const int parent = tree.limb_bodies[static_cast<std::size_t>(body - 1)].parent;
    is_chain = is_chain && parent == (body == first ? kBaseBody : body - 1);
  }
  if (!is_chain) {
    throw Error("the joints of leg " + std::string(leg_name(leg, description.num_legs())) +
                " are not a chain from the base to the link that \"" + names.foot_frame +
                "\" is on");
  }
  sole.p += sole.R * names.foot_center;
  const auto num_legs = static_cast<int>(index(leg)) + 1;
  tree.soles.resize(num_legs);
  tree.hips.resize(num_legs);
  tree.soles[index(leg)] = sole;
  tree.hips[index(leg)] = builder.placement(names.hip_frame);
}

void add_points(const RobotDescription& description, Leg leg, Builder& builder) {
  const LegDescription& names = description.legs[index(leg)];
  LegTree& tree = builder.tree().legs[index(leg)];
  (void)require(builder, names.thigh_link, leg, 1, 1);
  const Placement& hip = require(builder, names.hip_frame, leg, 0, 1);
  tree.chain.hip = hip.p;
  tree.chain.hip_hinge = hip.body - body_of(leg, 0);
  tree.R_shank = require(builder, names.shank_link, leg, 2, 2).R;
  const Placement& foot = require(builder, names.foot_frame, leg, 2, 2);
  tree.chain.foot = foot.p + foot.R * names.foot_center;
}

}  // namespace

BodyTree make_body_tree(const RobotDescription& description, const Urdf& urdf) {
  Builder builder(description, urdf);
  (void)builder.placement(description.base_link);  // report an unknown name before a wrong one
  if (description.base_link != urdf.root) {
    throw Error("the base \"" + description.base_link + "\" must be the root of the URDF, \"" +
                urdf.root + "\"");
  }
  for (const Leg leg : description.legs.legs())
    description.can_walk() ? add_points(description, leg, builder)
                           : add_sole(description, leg, builder);
  for (const ArmDescription& arm : description.arms) {
    builder.tree().arm_tips.push_back(builder.placement(arm.tip_frame));
  }
  return builder.tree();
}

}  // namespace surefoot::model
