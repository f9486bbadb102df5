#include "surefoot/config/limb_chains.hpp"

#include "surefoot/model/placing_joints.hpp"

#include <algorithm>
#include <iterator>
#include <vector>

namespace surefoot::config {
namespace {

/// A list is empty, or has a number for each joint of its limb.
void check_lists(const Section& top, const std::string& key, const JointLists& given,
                 std::size_t num_joints, const char* limb, const char* what_joints = "joints") {
  for (const auto& [what, numbers] : {std::pair{".posture", &given.posture},
                                      {".torque", &given.torque},
                                      {".velocity", &given.velocity},
                                      {".position_min", &given.position_min},
                                      {".position_max", &given.position_max}}) {
    const bool is_limit = numbers == &given.torque || numbers == &given.velocity;
    if (is_limit && std::ranges::any_of(*numbers, [](double limit) { return limit <= 0.0; }))
      top.fail(key + what, "must have numbers above 0 only");
    if (numbers->empty() || numbers->size() == num_joints) continue;
    top.fail(key + what, "has " + std::to_string(numbers->size()) + " numbers, but the " + limb +
                             " has " + std::to_string(num_joints) + " " + what_joints);
  }
}

/// Joints between the base and a foot; with those that are held, so that these are told.
std::vector<const model::UrdfJoint*> chain_to(const model::Urdf& urdf, const std::string& base,
                                              const std::string& foot, bool with_held = false) {
  std::vector<const model::UrdfJoint*> chain;
  for (std::string link = foot; link != base && link != urdf.root;) {
    const auto joint = std::ranges::find(urdf.joints, link, &model::UrdfJoint::child);
    if (joint->type != "fixed" || (with_held && !joint->held_type.empty()))
      chain.insert(chain.begin(), &*joint);
    link = joint->parent;
  }
  return chain;
}

/// The link behind a joint; empty: there is no such joint.
std::string moved_by(const model::Urdf& urdf, const std::string& name) {
  const auto joint = std::ranges::find(urdf.joints, name, &model::UrdfJoint::name);
  return joint == urdf.joints.end() ? std::string() : joint->child;
}

/// Joints up to an arm's tip that belong to no limb before it.
std::vector<std::string> free_chain(const Section& top, const model::Urdf& urdf,
                                    const model::ArmDescription& arm,
                                    const model::RobotDescription& robot) {
  const std::string tip = "\"" + arm.tip_frame + "\"";
  const std::vector<std::string> known = robot.joint_names();
  std::vector<std::string> chain;
  for (std::string link = arm.tip_frame; link != robot.base_link && link != urdf.root;) {
    const auto joint = std::ranges::find(urdf.joints, link, &model::UrdfJoint::child);
    const auto taken = std::ranges::find(known, joint->name);
    if (taken != known.end()) {
      const std::string limb = limb_of(robot, taken - known.begin());
      if (chain.empty())
        top.fail("arms." + arm.name + ".tip",
                 tip + " moves with joint \"" + joint->name + "\" of " + limb +
                     ", and no joint lies between them; an arm has joints of its own");
      if (taken - known.begin() < robot.num_leg_joints())
        top.fail("arms." + arm.name + ".tip",
                 tip + " is on " + limb + "; an arm is on the base, or on an arm above it");
      return chain;
    }
    if (joint->type != "fixed") chain.insert(chain.begin(), joint->name);
    link = joint->parent;
  }
  if (chain.empty())
    top.fail("arms." + arm.name + ".tip", "no joint moves between the base and " + tip);
  return chain;
}

void check_num_leg_joints(const Section& top, const std::string& key, std::size_t num_joints) {
  if (num_joints > kMaxLegJoints)
    top.fail(key, "the leg has " + std::to_string(num_joints) + " joints; valid are at most " +
                      std::to_string(kMaxLegJoints));
}

std::vector<std::string> names_of(const std::vector<const model::UrdfJoint*>& joints) {
  std::vector<std::string> names;
  for (const model::UrdfJoint* joint : joints) names.push_back(joint->name);
  return names;
}

std::string spaced(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += " " + name;
  return text.empty() ? " none" : text;
}

}  // namespace

const model::ArmDescription* arm_of(const model::RobotDescription& robot, Eigen::Index joint) {
  Eigen::Index end = robot.num_leg_joints();
  for (const model::ArmDescription& arm : robot.arms) {
    end += static_cast<Eigen::Index>(arm.joints.size());
    if (joint >= robot.num_leg_joints() && joint < end) return &arm;
  }
  return nullptr;
}

Leg leg_of(const model::RobotDescription& robot, Eigen::Index joint) {
  for (const auto& range :
       {&model::RobotDescription::leg_joints, &model::RobotDescription::further_joints}) {
    for (const Leg leg : robot.legs.legs()) {
      const auto [first, count] = (robot.*range)(leg);
      if (joint < first + count) return leg;
    }
  }
  return Leg{0};
}

std::string limb_of(const model::RobotDescription& robot, Eigen::Index joint) {
  const model::ArmDescription* arm = arm_of(robot, joint);
  if (arm != nullptr) return "arm \"" + arm->name + "\"";
  return "leg " + std::string(leg_name(leg_of(robot, joint), robot.num_legs()));
}

void complete_leg(const Section& top, const model::Urdf& urdf, const std::string& base,
                  const std::string& key, const LegInFile& given, model::LegDescription& leg) {
  std::vector<const model::UrdfJoint*> chain = chain_to(urdf, base, leg.foot_frame);
  if (chain.size() < kJointsPerLeg) chain = chain_to(urdf, base, leg.foot_frame, true);
  const std::vector<std::string> names = names_of(chain);
  if (given.joints.empty()) {
    if (names.size() < kJointsPerLeg) {
      top.fail(key, "between the base and \"" + leg.foot_frame + "\" there are " +
                        std::to_string(names.size()) + " joints that move:" + spaced(names) +
                        "; a leg that walks has three, HAA, HFE and KFE, or more, as fewer can't "
                        "place a foot in space: is this its foot?");
    }
    leg.joints =
        names.size() == kJointsPerLeg ? names : names_of(model::placing_joints(urdf, base, chain));
    if (leg.joints.size() < kJointsPerLeg) {
      top.fail(key, "of the joints between the base and \"" + leg.foot_frame + "\"," +
                        spaced(names) +
                        ", no three turn about x, y and y of the base in this order; name by "
                        "`joints` those that place the foot: HAA, HFE, KFE");
    }
  }
  const auto is_among = [](const std::vector<std::string>& all, const std::string& name) {
    return std::ranges::find(all, name) != all.end();
  };
  if (std::ranges::all_of(leg.joints, [&](const auto& name) { return is_among(names, name); }))
    std::ranges::copy_if(names, std::back_inserter(leg.further),
                         [&](const auto& name) { return !is_among(leg.joints, name); });
  check_num_leg_joints(top, key, leg.joints.size() + leg.further.size());
  check_lists(top, key + ".further", given.lists, leg.further.size(), "leg", "further joints");
  if (leg.thigh_link.empty()) leg.thigh_link = moved_by(urdf, leg.joints[1]);
  if (leg.hip_frame.empty()) leg.hip_frame = leg.thigh_link;
  if (leg.shank_link.empty())
    leg.shank_link = moved_by(urdf, leg.further.empty() ? leg.joints[2] : names.back());
}

void complete_standing_leg(const Section& top, const model::Urdf& urdf, const std::string& base,
                           const std::string& key, const LegInFile& given,
                           model::LegDescription& leg) {
  if (given.joints.empty()) {
    leg.joints.clear();
    for (const model::UrdfJoint* joint : chain_to(urdf, base, leg.foot_frame))
      leg.joints.push_back(joint->name);
  }
  if (leg.joints.empty())
    top.fail(key + ".foot", "no joint moves between the base and \"" + leg.foot_frame + "\"");
  check_num_leg_joints(top, key, leg.joints.size());
  if (leg.hip_frame.empty()) leg.hip_frame = moved_by(urdf, leg.joints.front());
  if (leg.hip_frame.empty()) leg.hip_frame = base;  // the joint's name is found to be wrong later
  leg.thigh_link.clear();
  check_lists(top, key, given.lists, leg.joints.size(), "leg");
}

void complete_arm(const Section& top, const model::Urdf& urdf, const ArmInFile& given,
                  model::RobotDescription& robot) {
  model::ArmDescription arm = given.names;
  const std::string key = "arms." + arm.name;
  if (std::ranges::find(robot.arms, arm.name, &model::ArmDescription::name) != robot.arms.end())
    top.fail("arms", "two arms have the name \"" + arm.name + "\"");
  if (arm.joints.empty()) arm.joints = free_chain(top, urdf, arm, robot);
  check_lists(top, key, given.lists, arm.joints.size(), "arm");
  robot.arms.push_back(std::move(arm));
  check_num_joints(top, key, robot);
}

void check_num_joints(const Section& top, const std::string& key,
                      const model::RobotDescription& robot) {
  if (robot.num_joints() > kMaxJoints)
    top.fail(key, "with it the robot has " + std::to_string(robot.num_joints()) +
                      " joints; valid are at most " + std::to_string(kMaxJoints));
}

}  // namespace surefoot::config
