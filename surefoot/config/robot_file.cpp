#include "surefoot/config/robot_file.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/base/formatted.hpp"
#include "surefoot/base/nearest_name.hpp"
#include "surefoot/config/data_directory.hpp"
#include "surefoot/config/data_file.hpp"
#include "surefoot/config/description_file.hpp"
#include "surefoot/config/field_reader.hpp"
#include "surefoot/config/limb_chains.hpp"
#include "surefoot/config/robot_completion.hpp"
#include "surefoot/config/robot_plausibility.hpp"
#include "surefoot/control/standing_torque.hpp"
#include "surefoot/model/proportions.hpp"
#include "surefoot/model/robot_model.hpp"
#include "surefoot/model/urdf.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <map>
#include <sstream>

namespace surefoot::config {
namespace {

/// The key of the robot's description: one of two.
const char* description_key(const Section& top, const RobotInFile& given) {
  const bool has_urdf = !given.robot.urdf_path.empty(), has_mjcf = !given.mjcf.empty();
  if (has_urdf && has_mjcf) top.fail("mjcf", "urdf stands beside it; a robot has one of them");
  if (!has_urdf && !has_mjcf) top.fail("urdf", "this key is missing, or mjcf");
  return has_urdf ? "urdf" : "mjcf";
}

/// Finds and reads URDF or MJCF, with the robot file's line in front of what is wrong with it.
model::Urdf read_description(const Section& top, const char* key, RobotInFile& given,
                             const std::filesystem::path& file) {
  model::RobotDescription& robot = given.robot;
  const std::string name = given.mjcf.empty() ? robot.urdf_path : given.mjcf;
  try {
    robot.urdf_path = find_description(name, std::filesystem::absolute(file).parent_path());
    if (!given.mjcf.empty()) robot.urdf_text = urdf_of_mjcf_named(name, robot.urdf_path);
    return model::read_urdf(robot);
  } catch (const MissingDescription& error) {
    try {
      top.fail(key, error.what());
    } catch (const Error& placed) {
      throw MissingDescription(placed.what(), error.remedy());
    }
  } catch (const Error& error) {
    top.fail(key, error.what());
  }
}

/// Checks names against the URDF.
class NameCheck {
 public:
  NameCheck(const Section& top, const model::Urdf& urdf) : top_(top), urdf_(urdf) {
    for (const model::UrdfLink& link : urdf.links) links_.push_back(link.name);
    for (const model::UrdfJoint& joint : urdf.joints) {
      if (joint.type != "fixed" || !joint.held_type.empty()) joints_.push_back(joint.name);
    }
  }

  void frame(const std::string& key, const std::string& name) const {
    check(key, "frame", name, links_);
  }

  void leg(const std::string& key, const model::LegDescription& leg) {
    joints(key, leg.joints, "a leg");
    frame(key + ".hip", leg.hip_frame);
    if (leg.thigh_link.empty()) return;  // of a robot that only stands
    frame(key + ".thigh", leg.thigh_link);
    frame(key + ".shank", leg.shank_link);
    frame(key + ".foot", leg.foot_frame);
  }

  void arm(const std::string& key, const model::ArmDescription& arm) {
    joints(key, arm.joints, "an arm");
  }

 private:
  void joints(const std::string& key, const auto& names, const std::string& limb) {
    for (const std::string& joint : names) {
      check(key + ".joints", "joint", joint, joints_);
      check_hinge(key + ".joints", joint, limb);
    }
  }

  /// A limb's joints are hinges, and each is used once.
  void check_hinge(const std::string& key, const std::string& name, const std::string& limb) {
    const auto joint = std::ranges::find(urdf_.joints, name, &model::UrdfJoint::name);
    const std::string place = " (" + urdf_.path + ":" + std::to_string(joint->line) + ")";
    const std::string& type = joint->held_type.empty() ? joint->type : joint->held_type;
    if (type != "revolute" && type != "continuous") {
      top_.fail(key, "joint \"" + name + "\" is " + type + place + "; " + limb +
                         "'s joint must be revolute");
    }
    if (!joint->mimics.empty()) {
      top_.fail(key, "joint \"" + name + "\" mimics \"" + joint->mimics + "\"" + place + "; " +
                         limb + "'s joints must each have a drive of their own");
    }
    const auto [first, is_new] = places_.emplace(name, key);
    if (is_new) return;
    top_.fail(key, "joint \"" + name + "\" stands at two places, also in " + first->second);
  }

  void check(const std::string& key, const char* what, const std::string& name,
             const std::vector<std::string>& valid) const {
    if (std::ranges::find(valid, name) != valid.end()) return;
    top_.fail(key, std::string("unknown ") + what + " \"" + name + "\" in " + urdf_.path + "; " +
                       valid_names(name, valid));
  }

  const Section& top_;
  const model::Urdf& urdf_;
  std::vector<std::string> links_, joints_;
  std::map<std::string, std::string> places_;  // keys, by joint
};

std::string listed(const auto& names) {
  std::string text;
  for (const auto& name : names) text += (text.empty() ? "" : ", ") + std::string(name);
  return text;
}

/// Of the legs that the file names.
int num_legs_of(const ConfigNode& tree) {
  const ConfigNode* legs = tree.find("legs");
  if (legs == nullptr || legs->kind != ConfigNode::Kind::map) return kNumLegs;
  std::vector<std::string_view> given;
  for (const auto& member : legs->members) given.push_back(member.first);
  for (const int num_legs : {2, kNumLegs, kMaxLegs}) {
    if (std::ranges::is_permutation(given, leg_names(num_legs))) return num_legs;
  }
  fail_at(*legs, "legs",
          "has " + (given.empty() ? "no keys" : listed(given)) + "; valid are " +
              listed(leg_names(kNumLegs)) + ", of six legs " + listed(leg_names(kMaxLegs)) +
              ", or of two with flat feet " + listed(leg_names(2)));
}

/// In the nominal posture, with a level torso, soles lie flat at one height, the left one to the
/// left.
void check_soles(const ConfigNode& legs, model::RobotModel& model) {
  constexpr double kMaxLean = 0.02;   // [rad]
  constexpr double kMaxStep = 0.018;  // of the leg
  const double max_step = kMaxStep * model::proportions_of(model).leg;
  const model::Dynamics& dynamics =
      model.update(control::level_at_rest(model.description().q_nominal), Vec3::UnitZ());
  for (const Leg leg : dynamics.contact.legs()) {
    const Vec3& p_BF = dynamics.contact[index(leg)].p;
    const std::string name(leg_name(leg, dynamics.num_legs()));
    const auto fail = [&](const std::string& what) {
      fail_at(*legs.find(name), "legs." + name, "in the nominal posture " + what);
    };
    if (is_left(leg) != (p_BF.y() > 0.0))
      fail(formatted("its foot is at y = %.3g m from the base; L belongs to the left, y > 0",
                     p_BF.y()));
    const double lean = std::acos(std::clamp(dynamics.shank[index(leg)].R(2, 2), -1.0, 1.0));
    if (lean > kMaxLean)
      fail(formatted("its sole leans by %.3g rad; valid is up to %.3g, so that it stands flat",
                     lean, kMaxLean));
    const double step = p_BF.z() - dynamics.contact[0].p.z();
    if (std::abs(step) > max_step)
      fail(formatted("its sole is %.3g m %s than that of L; valid is up to %.3g", std::abs(step),
                     step > 0.0 ? "higher" : "lower", max_step));
  }
}

/// In the nominal posture each foot is in its own quadrant, or between those of its side's front
/// and hind leg; else legs may be exchanged.
void check_places(const ConfigNode& legs, model::RobotModel& model) {
  const model::RobotDescription& robot = model.description();
  if (!robot.can_walk()) {
    check_soles(legs, model);
    return;
  }
  PerLeg<Vec3> feet(robot.num_legs(), Vec3::Zero());
  for (const Leg leg : feet.legs())
    feet[index(leg)] = model.foot_in_base(leg, robot.q_nominal.segment<3>(first_joint(leg)));
  for (const Leg leg : feet.legs()) {
    const Vec3& p_BF = feet[index(leg)];
    const bool is_middle = !is_front(leg) && !is_hind(leg, robot.num_legs());
    const bool is_along =
        is_middle ? p_BF.x() < feet[index(leg) - 2].x() && p_BF.x() > feet[index(leg) + 2].x()
                  : is_front(leg) == (p_BF.x() > 0.0);
    if (is_along && is_left(leg) == (p_BF.y() > 0.0)) continue;
    const std::string name(leg_name(leg, robot.num_legs()));
    std::ostringstream message;
    message << std::setprecision(3) << "in the nominal posture its foot is at x = " << p_BF.x()
            << ", y = " << p_BF.y() << " m from the base, but the leg " << name << " belongs at x "
            << (is_middle       ? "between those of the front and the hind foot"
                : is_front(leg) ? "> 0"
                                : "< 0")
            << ", y " << (is_left(leg) ? ">" : "<")
            << " 0; are two legs exchanged, or does the base not look along x?";
    fail_at(*legs.find(name), "legs." + name, message.str());
  }
}

/// A base floats by itself.
void check_root(const Section& top, const char* key, const model::Urdf& urdf) {
  for (const model::UrdfJoint& joint : urdf.joints) {
    if (joint.type != "floating") continue;
    top.fail(key, urdf.path + ":" + std::to_string(joint.line) + ": joint \"" + joint.name +
                      "\" is floating; the root floats without a joint, so take it and \"" +
                      joint.parent + "\" out, or make it fixed");
  }
}

/// Each leg has a foot of its own.
void check_feet(const Section& top, const model::RobotDescription& robot) {
  std::map<std::string, std::string> legs;
  for (const Leg leg : robot.legs.legs()) {
    const std::string name(leg_name(leg, robot.num_legs()));
    const std::string& foot = robot.legs[index(leg)].foot_frame;
    const auto [first, is_new] = legs.emplace(foot, name);
    if (is_new) continue;
    top.fail("legs." + name + ".foot", "\"" + foot + "\" is the foot of legs." + first->second +
                                           " already; each has its own");
  }
}

/// What needs the whole robot: checks, nominal posture, scale and gains.
void complete_robot(const Section& top, const char* key, const ConfigNode& legs,
                    const RobotInFile& given, const model::Urdf& urdf,
                    model::RobotDescription& robot) {
  const auto model_of = [&] {
    try {
      return model::RobotModel(robot);
    } catch (const FileError& error) {
      top.fail(key, error.what());
    } catch (const Error& error) {
      top.fail("legs", error.what());
    }
  };
  if (robot.can_walk()) {
    const model::RobotModel model = model_of();
    check_plausible(legs, urdf, robot);
    complete_posture(top, given, model, robot);
  }
  model::RobotModel model = model_of();
  check_places(legs, model);
  robot.scale = model::scale_of(model::proportions_of(model));
  complete_gains(given, robot);
}

}  // namespace

model::RobotDescription load_robot(const std::string& name_or_path,
                                   const std::filesystem::path& beside) {
  const std::filesystem::path file = find_data_file("robots", name_or_path, beside);
  const ConfigNode tree = parse_yaml_file(file);
  Section top(tree, "");
  RobotInFile given;
  set_num_legs(given, num_legs_of(tree));
  model::RobotDescription& robot = given.robot;
  read(top, fields(given));
  top.finish();

  for (const std::filesystem::path& folder : package_directories())
    robot.package_folders.push_back(folder.string());
  const char* key_of_description = description_key(top, given);
  const model::Urdf urdf = read_description(top, key_of_description, given, file);
  if (robot.base_link.empty()) robot.base_link = urdf.root;
  check_root(top, key_of_description, urdf);
  check_feet(top, robot);
  NameCheck names(top, urdf);
  names.frame("base", robot.base_link);
  if (robot.base_link != urdf.root)
    top.fail("base", "\"" + robot.base_link + "\" is not the root of the URDF; valid is \"" +
                         urdf.root + "\"");
  for (const Leg leg : robot.legs.legs()) {
    const std::string key = "legs." + std::string(leg_name(leg, robot.num_legs()));
    model::LegDescription& description = robot.legs[index(leg)];
    if (const auto& joints = given.legs[index(leg)].joints; !joints.empty())
      description.joints = joints;
    names.frame(key + ".foot", description.foot_frame);
    if (robot.can_walk()) {
      complete_leg(top, urdf, robot.base_link, key, given.legs[index(leg)], description);
    } else {
      complete_standing_leg(top, urdf, robot.base_link, key, given.legs[index(leg)], description);
    }
    names.leg(key, description);
    check_num_joints(top, key, robot);
  }
  for (const ArmInFile& arm : given.arms) {
    names.frame("arms." + arm.names.name + ".tip", arm.names.tip_frame);
    complete_arm(top, urdf, arm, robot);
    names.arm("arms." + arm.names.name, robot.arms.back());
  }
  complete_feet(given, robot);
  complete_limits(top, urdf, given, robot);
  complete_robot(top, key_of_description, *tree.find("legs"), given, urdf, robot);
  return robot;
}

}  // namespace surefoot::config
