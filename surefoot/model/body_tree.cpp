#include "surefoot/model/body_tree.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/base/formatted.hpp"

#include <algorithm>
#include <initializer_list>
#include <map>
#include <numeric>
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
  for (const LegDescription& leg : description.legs) {
    for (const std::string& name : leg.further) add(name, body++, "a leg");
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
        first_arm_body_(1 + description.num_leg_joints()) {
    tree_.limb_bodies.resize(static_cast<std::size_t>(description.num_joints()));
    tree_.hips.resize(description.num_legs());
    tree_.feet.resize(description.num_legs());
    tree_.legs.resize(description.can_walk() ? description.num_legs() : 0);
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
    if (body >= first_arm_body_) check_arm(joint, body, parent.body);
    limb_body(body) = {parent.body, {R, p, joint.axis}, Inertia()};
    add_link(joint.child, {body, Mat3::Identity(), Vec3::Zero()});
    check_inertia(*urdf_.find_link(joint.child), inertia_of(body));
  }

  /// An arm is on the base, or behind a joint of an arm that comes earlier.
  void check_arm(const UrdfJoint& joint, int body, int parent) const {
    if (parent < body && (parent == kBaseBody || parent >= first_arm_body_)) return;
    throw Error("joint \"" + joint.name +
                "\" of an arm is neither on the base nor behind a joint named before it");
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

  LimbBody& limb_body(int body) { return tree_.limb_bodies[static_cast<std::size_t>(body - 1)]; }

  Inertia& inertia_of(int body) { return body == kBaseBody ? tree_.base : limb_body(body).inertia; }

  const Urdf& urdf_;
  const std::map<std::string, int> bodies_;
  const int first_arm_body_;
  BodyTree tree_;
};

/// Bodies from the base, without it, to this one.
std::vector<int> bodies_to(const BodyTree& tree, int body) {
  std::vector<int> bodies;
  for (; body != kBaseBody; body = tree.limb_bodies[static_cast<std::size_t>(body - 1)].parent)
    bodies.insert(bodies.begin(), body);
  return bodies;
}

[[noreturn]] void fail_as_no_chain(const LegDescription& names, Leg leg, int num_legs) {
  throw Error("the joints of leg " + std::string(leg_name(leg, num_legs)) +
              " are not a chain from the base to the link that \"" + names.foot_frame + "\" is on");
}

/// The leg is one chain from the base to the link of its foot.
void check_chain(const RobotDescription& description, Leg leg, const BodyTree& tree) {
  const JointRange joints = description.leg_joints(leg);
  std::vector<int> bodies(static_cast<std::size_t>(joints.count));
  std::iota(bodies.begin(), bodies.end(), 1 + joints.first);
  if (bodies == bodies_to(tree, tree.feet[index(leg)].body)) return;
  fail_as_no_chain(description.legs[index(leg)], leg, description.num_legs());
}

/// A walker's leg: its bodies are checked and found.
class LegFinder {
 public:
  LegFinder(const RobotDescription& description, const Urdf& urdf, Leg leg, const Builder& builder)
      : names_(description.legs[index(leg)]),
        urdf_(urdf),
        leg_(leg),
        num_legs_(description.num_legs()),
        further_(description.further_joints(leg)),
        builder_(builder) {}

  /// HAA, HFE and KFE in this order, and further joints.
  [[nodiscard]] std::vector<int> bodies() const {
    check_order();
    require(names_.thigh_link, {body_of(leg_, 1)});
    require(names_.hip_frame, {body_of(leg_, 0), body_of(leg_, 1)});
    require(names_.shank_link, {last()});
    require(names_.foot_frame, {last()});
    std::vector<int> bodies = bodies_to(builder_.tree(), last());
    if (std::ssize(bodies) != kJointsPerLeg + further_.count)
      fail_as_no_chain(names_, leg_, num_legs_);
    return bodies;
  }

 private:
  [[nodiscard]] bool is_further(int body) const {
    return body > further_.first && body <= further_.first + further_.count;
  }
  [[nodiscard]] int parent_of(int body) const {
    return builder_.tree().limb_bodies[static_cast<std::size_t>(body - 1)].parent;
  }

  void check_order() const {
    for (int joint = 0; joint < kJointsPerLeg; ++joint) {
      int parent = parent_of(body_of(leg_, joint));
      while (is_further(parent)) parent = parent_of(parent);
      if (parent == (joint == 0 ? kBaseBody : body_of(leg_, joint - 1))) continue;
      const std::string& name = names_.joints[static_cast<std::size_t>(joint)];
      throw Error("joint \"" + name + "\" moves with \"" +
                  std::ranges::find(urdf_.joints, name, &UrdfJoint::name)->parent +
                  "\", which is not what the joint before it in its leg moves; a leg is HAA, HFE "
                  "and KFE, from the base to the foot");
    }
  }

  /// The body behind the KFE, or behind the last of the further joints that follow it.
  [[nodiscard]] int last() const {
    int body = body_of(leg_, 2);
    for (int further = further_.first + 1; further <= further_.first + further_.count; ++further)
      if (parent_of(further) == body) body = further;
    return body;
  }

  void require(const std::string& link, std::initializer_list<int> bodies) const {
    const int body = builder_.placement(link).body;
    if (std::ranges::find(bodies, body) != bodies.end()) return;
    throw Error("frame \"" + link + "\" is not on the expected part of leg " +
                std::string(leg_name(leg_, num_legs_)));
  }

  const LegDescription& names_;
  const Urdf& urdf_;
  const Leg leg_;
  const int num_legs_;
  const JointRange further_;
  const Builder& builder_;
};

void add_leg(const RobotDescription& description, const Urdf& urdf, Leg leg, Builder& builder) {
  const LegDescription& names = description.legs[index(leg)];
  BodyTree& tree = builder.tree();
  BodyFrame& foot = tree.feet[index(leg)];
  foot = builder.placement(names.foot_frame);
  tree.hips[index(leg)] = builder.placement(names.hip_frame);
  foot.p += foot.R * names.foot_center;
  if (!description.can_walk()) return check_chain(description, leg, tree);
  tree.legs[index(leg)].bodies = LegFinder(description, urdf, leg, builder).bodies();
  foot.R = builder.placement(names.shank_link).R;
  tree.legs[index(leg)].chain = leg_chain(tree, leg, description.q_nominal);
}

}  // namespace

BodyTree make_body_tree(const RobotDescription& description, const Urdf& urdf) {
  Builder builder(description, urdf);
  (void)builder.placement(description.base_link);  // report an unknown name before a wrong one
  if (description.base_link != urdf.root) {
    throw Error("the base \"" + description.base_link + "\" must be the root of the URDF, \"" +
                urdf.root + "\"");
  }
  for (const Leg leg : description.legs.legs()) add_leg(description, urdf, leg, builder);
  for (const ArmDescription& arm : description.arms) {
    builder.tree().arm_tips.push_back(builder.placement(arm.tip_frame));
  }
  return builder.tree();
}

LegChain leg_chain(const BodyTree& tree, Leg leg, const JointVector& q) noexcept {
  LegChain chain;
  const BodyFrame& hip = tree.hips[index(leg)];
  const BodyFrame& foot = tree.feet[index(leg)];
  chain.hip = hip.p;
  chain.hip_hinge = hip.body - body_of(leg, 0);
  // Of the last further body, in the body of the hinge before it.
  Mat3 R = Mat3::Identity();
  Vec3 p = Vec3::Zero();
  std::size_t num_hinges = 0;
  for (const int body : tree.legs[index(leg)].bodies) {
    const Hinge& hinge = tree.limb_bodies[static_cast<std::size_t>(body - 1)].hinge;
    p += R * hinge.p;
    R = R * hinge.R;
    if (body == body_of(leg, static_cast<int>(num_hinges))) {
      chain.hinges[num_hinges++] = {R, p, hinge.axis};
      R.setIdentity();
      p.setZero();
    } else {
      R = R * Eigen::AngleAxisd(q[body - 1], hinge.axis).toRotationMatrix();
    }
  }
  chain.foot = p + R * foot.p;
  return chain;
}

}  // namespace surefoot::model
