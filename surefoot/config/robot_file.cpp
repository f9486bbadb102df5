#include "surefoot/config/robot_file.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/base/formatted.hpp"
#include "surefoot/config/data_directory.hpp"
#include "surefoot/config/data_file.hpp"
#include "surefoot/config/nearest_name.hpp"
#include "surefoot/config/section.hpp"
#include "surefoot/model/mesh_files.hpp"
#include "surefoot/model/robot_model.hpp"
#include "surefoot/model/urdf.hpp"

#include <algorithm>
#include <iomanip>
#include <map>
#include <sstream>

namespace surefoot {
namespace {

/// The URDF is looked for as its meshes are.
std::string resolve_urdf(const Section& top, const std::string& urdf,
                         const std::filesystem::path& robot_file) {
  const MeshFolders folders{.packages = package_directories(),
                            .urdf = std::filesystem::absolute(robot_file).parent_path()};
  const std::filesystem::path found = find_mesh(urdf, folders);
  if (found.empty()) top.fail("urdf", missing_text(urdf, folders));
  return found.string();
}

/// HAA, HFE, KFE of all legs alike.
void read_per_joint(Section& section, const char* key, JointVector& value) {
  Vec3 joints = value.head<3>();
  section.vector(key, joints);
  value = joints.replicate<kNumLegs, 1>();
}

/// One number for all joints, or those of HAA, HFE and KFE.
void read_drive_limit(Section& limits, const char* key, JointVector& value) {
  const ConfigNode* given = limits.node(key);
  Vec3 joints = Vec3::Zero();
  if (given != nullptr && given->kind == ConfigNode::Kind::scalar) {
    limits.number(key, joints[0], kPositive);
    joints.setConstant(joints[0]);
  } else {
    limits.elements(key, joints.data(), {"HAA", "HFE", "KFE"}, kPositive);
    if ((joints.array() <= 0.0).any()) limits.fail(key, "does not tell all of HAA, HFE and KFE");
  }
  value = joints.replicate<kNumLegs, 1>();
}

void read_limits(Section& limits, RobotDescription& robot) {
  for (const char* key : {"torque", "velocity", "position_min", "position_max"})
    limits.require(key);
  read_drive_limit(limits, "torque", robot.torque_limit);
  read_drive_limit(limits, "velocity", robot.velocity_limit);
  read_per_joint(limits, "position_min", robot.q_min);
  read_per_joint(limits, "position_max", robot.q_max);
  if ((robot.q_min.array() >= robot.q_max.array()).any()) {
    limits.fail("position_max", "must be above position_min at every joint");
  }
}

/// Is a leg's posture within the limits? `bad` gets the joint that is not.
bool is_within_limits(const RobotDescription& robot, Leg leg, const Vec3& q, Eigen::Index& bad) {
  const Eigen::Index first = first_joint(leg);
  for (bad = 0; bad < kJointsPerLeg; ++bad) {
    if (q[bad] < robot.q_min[first + bad] || q[bad] > robot.q_max[first + bad]) return false;
  }
  return true;
}

/// The posture of a front leg, its knee backward. Hind legs mirror HFE and KFE (X-configuration),
/// but where their limits leave that out, they stand like the front ones.
void read_posture(Section& posture, RobotDescription& robot) {
  posture.require("nominal");
  Vec3 front = Vec3::Zero();
  posture.vector("nominal", front);
  if (front.y() * front.z() >= 0.0) {
    posture.fail("nominal", "HFE and KFE must bend the knee, one above 0 and the other below");
  }
  for (const Leg leg : kLegs) {
    const Vec3 mirrored(front.x(), -front.y(), -front.z());
    Eigen::Index bad = 0;
    const bool mirror = !is_front(leg) && is_within_limits(robot, leg, mirrored, bad);
    const Vec3 q = mirror ? mirrored : front;
    robot.q_nominal.segment<3>(first_joint(leg)) = q;
    if (is_within_limits(robot, leg, q, bad)) continue;
    const Eigen::Index joint = first_joint(leg) + bad;
    posture.fail("nominal",
                 std::string(kJointNames[static_cast<std::size_t>(bad)]) +
                     formatted(" at %g rad lies outside limits.position_min and position_max, "
                               "%g to %g rad",
                               q[bad], robot.q_min[joint], robot.q_max[joint]));
  }
}

void read_gains(Section& gains, RobotDescription& robot) {
  gains.section("hold", [&](Section& hold) {
    hold.number("kp", robot.hold_kp, kNotNegative);
    hold.number("kd", robot.hold_kd, kNotNegative);
  });
  gains.number("damping", robot.damping_kd, kNotNegative);
}

/// Reads names and holds them against those of the URDF.
class NameReader {
 public:
  explicit NameReader(const Urdf& urdf) : urdf_(urdf) {
    for (const UrdfLink& link : urdf.links) links_.push_back(link.name);
    for (const UrdfJoint& joint : urdf.joints) {
      if (joint.type != "fixed") joints_.push_back(joint.name);
    }
  }

  void frame(Section& section, const char* key, std::string& value) const {
    section.require(key);
    section.text(key, value);
    if (section.node(key) != nullptr) check(section, key, "frame", value, links_);
  }

  void joints(Section& section, const char* key, std::array<std::string, kJointsPerLeg>& names) {
    section.require(key);
    const ConfigNode* given = section.node(key);
    if (given == nullptr) return;
    if (given->items.size() != names.size())
      section.fail(key, "is not a list of 3 joints: HAA, HFE, KFE");
    for (std::size_t i = 0; i < names.size(); ++i) {
      names[i] = read_text(given->items[i], section.path_of(key));
      check(section, key, "joint", names[i], joints_);
      check_hinge(section, key, names[i]);
    }
  }

 private:
  /// A leg's joints are hinges, and each stands at one place.
  void check_hinge(const Section& section, const char* key, const std::string& name) {
    const auto joint = std::ranges::find(urdf_.joints, name, &UrdfJoint::name);
    if (joint->type != "revolute" && joint->type != "continuous") {
      section.fail(key, "joint \"" + name + "\" is " + joint->type + " (" + urdf_.path + ":" +
                            std::to_string(joint->line) + "); a leg's joint must be revolute");
    }
    if (!joint->mimics.empty()) {
      section.fail(key, "joint \"" + name + "\" mimics \"" + joint->mimics + "\" (" + urdf_.path +
                            ":" + std::to_string(joint->line) +
                            "); a leg's joints must each have a drive of their own");
    }
    const auto [first, is_new] = places_.emplace(name, section.path_of(key));
    if (!is_new) {
      section.fail(key, "joint \"" + name + "\" stands at two places, also in " + first->second);
    }
  }

  void check(const Section& section, const char* key, const char* what, const std::string& name,
             const std::vector<std::string>& valid) const {
    if (std::ranges::find(valid, name) != valid.end()) return;
    section.fail(key, std::string("unknown ") + what + " \"" + name + "\" in " + urdf_.path + "; " +
                          valid_names(name, valid));
  }

  const Urdf& urdf_;
  std::vector<std::string> links_, joints_;
  std::map<std::string, std::string> places_;  // of the joints so far
};

void read_leg(Section& section, LegDescription& leg, NameReader& names) {
  names.joints(section, "joints", leg.joints);
  names.frame(section, "hip", leg.hip_frame);
  names.frame(section, "thigh", leg.thigh_link);
  names.frame(section, "shank", leg.shank_link);
  names.frame(section, "foot", leg.foot_frame);
}

void read_foot(Section& foot, RobotDescription& robot) {
  foot.require("radius");
  foot.number("radius", robot.foot_radius, kPositive);
  foot.vector("center", robot.foot_center);
}

/// The URDF's content, with the robot file's line in front of what is wrong with it.
Urdf read_urdf_of(const Section& top, const std::string& path) {
  try {
    return read_urdf(path);
  } catch (const Error& error) {
    top.fail("urdf", error.what());
  }
}

/// With the nominal posture each foot stands in its own quadrant: two legs that were exchanged
/// would be walked with, and fall.
void check_quadrants(const ConfigNode& legs, const RobotModel& model) {
  for (const Leg leg : kLegs) {
    const Vec3 p_BF =
        model.foot_in_base(leg, model.description().q_nominal.segment<3>(first_joint(leg)));
    if (is_front(leg) == (p_BF.x() > 0.0) && is_left(leg) == (p_BF.y() > 0.0)) continue;
    const std::string name(kLegNames[index(leg)]);
    std::ostringstream message;
    message << std::setprecision(3) << "in the nominal posture its foot is at x = " << p_BF.x()
            << ", y = " << p_BF.y() << " m from the base, but the leg " << name << " belongs at x "
            << (is_front(leg) ? ">" : "<") << " 0, y " << (is_left(leg) ? ">" : "<")
            << " 0; are two legs exchanged, or does the base not look along x?";
    fail_at(*legs.find(name), "legs." + name, message.str());
  }
}

/// What no key shows by itself: whether the parts make a robot.
void check_robot(const Section& top, const ConfigNode& legs, const RobotDescription& robot) {
  const auto model = [&] {
    try {
      return RobotModel(robot);
    } catch (const FileError& error) {
      top.fail("urdf", error.what());
    } catch (const Error& error) {
      top.fail("legs", error.what());
    }
  }();
  check_quadrants(legs, model);
}

}  // namespace

RobotDescription load_robot(const std::string& name_or_path, const std::filesystem::path& beside) {
  const std::filesystem::path file = find_data_file("robots", name_or_path, beside);
  const ConfigNode tree = parse_yaml_file(file);
  Section top(tree, "");
  RobotDescription robot;
  for (const char* key : {"name", "urdf", "base", "legs", "foot", "limits", "posture"}) {
    top.require(key);
    (void)top.node(key);
  }
  (void)top.node("gains");
  top.finish();

  top.text("name", robot.name);
  std::string urdf_name;
  top.text("urdf", urdf_name);
  robot.urdf_path = resolve_urdf(top, urdf_name, file);
  for (const std::filesystem::path& folder : package_directories())
    robot.package_folders.push_back(folder.string());
  const Urdf urdf = read_urdf_of(top, robot.urdf_path);
  NameReader names(urdf);
  names.frame(top, "base", robot.base_link);
  top.section("legs", [&](Section& legs) {
    for (const Leg leg : kLegs) {
      const char* name = kLegNames[index(leg)].data();
      legs.require(name);
      legs.section(name,
                   [&](Section& section) { read_leg(section, robot.legs[index(leg)], names); });
    }
  });
  top.section("foot", [&](Section& foot) { read_foot(foot, robot); });
  top.section("limits", [&](Section& limits) { read_limits(limits, robot); });
  top.section("posture", [&](Section& posture) { read_posture(posture, robot); });
  top.section("gains", [&](Section& gains) { read_gains(gains, robot); });
  check_robot(top, *tree.find("legs"), robot);
  return robot;
}

}  // namespace surefoot
