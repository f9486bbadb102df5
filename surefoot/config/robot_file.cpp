#include "surefoot/config/robot_file.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/base/formatted.hpp"
#include "surefoot/config/data_directory.hpp"
#include "surefoot/config/data_file.hpp"
#include "surefoot/config/field_reader.hpp"
#include "surefoot/config/nearest_name.hpp"
#include "surefoot/config/robot_fields.hpp"
#include "surefoot/model/mesh_files.hpp"
#include "surefoot/model/proportions.hpp"
#include "surefoot/model/robot_model.hpp"
#include "surefoot/model/urdf.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <map>
#include <optional>
#include <sstream>

namespace surefoot::config {
namespace {

/// The URDF is looked for as its meshes are.
std::string resolve_urdf(const Section& top, const std::string& urdf,
                         const std::filesystem::path& robot_file) {
  const model::MeshFolders folders{.packages = package_directories(),
                                   .urdf = std::filesystem::absolute(robot_file).parent_path()};
  const std::filesystem::path found = model::find_mesh(urdf, folders);
  if (found.empty()) top.fail("urdf", model::missing_text(urdf, folders));
  return found.string();
}

/// Is a leg's posture within the limits? `bad` gets the joint that is not.
bool is_within_limits(const model::RobotDescription& robot, Leg leg, const Vec3& q,
                      Eigen::Index& bad) {
  const Eigen::Index first = first_joint(leg);
  for (bad = 0; bad < kJointsPerLeg; ++bad) {
    if (q[bad] < robot.q_min[first + bad] || q[bad] > robot.q_max[first + bad]) return false;
  }
  return true;
}

/// Hind legs mirror HFE and KFE of a front leg (X-configuration), but where their limits leave that
/// out, they stand like the front ones.
void set_posture(const Section& top, const Vec3& front, model::RobotDescription& robot) {
  for (const Leg leg : kLegs) {
    const Vec3 mirrored(front.x(), -front.y(), -front.z());
    Eigen::Index bad = 0;
    const bool mirror = !is_front(leg) && is_within_limits(robot, leg, mirrored, bad);
    const Vec3 q = mirror ? mirrored : front;
    robot.q_nominal.segment<3>(first_joint(leg)) = q;
    if (is_within_limits(robot, leg, q, bad)) continue;
    const Eigen::Index joint = first_joint(leg) + bad;
    top.fail("posture.nominal",
             std::string(kJointNames[static_cast<std::size_t>(bad)]) +
                 formatted(" at %g rad lies outside limits.position_min and position_max, "
                           "%g to %g rad",
                           q[bad], robot.q_min[joint], robot.q_max[joint]));
  }
}

/// The nominal posture of legs whose limits leave one side of the knee, or both: X-configuration
/// where that is possible, else all knees backward, else all forward. The knee is bent by 0.8 rad,
/// or by as little more as its limits allow.
void choose_posture(const Section& top, const model::RobotModel& model,
                    model::RobotDescription& robot) {
  constexpr double kLeastBend = 0.8, kMostBend = 2.0, kStep = 0.05;
  constexpr double kSmallTurn = 1e-3;  // that tells which way a joint turns [rad]
  const auto bent = [&](Leg leg, bool is_backward) -> std::optional<Vec3> {
    const double x = model.foot_in_base(leg, Vec3::Zero()).x();
    const double hip_moves = model.foot_in_base(leg, Vec3(0.0, kSmallTurn, 0.0)).x() - x;
    const double knee_moves = model.foot_in_base(leg, Vec3(0.0, 0.0, kSmallTurn)).x() - x;
    const double side = is_backward ? 1.0 : -1.0;
    for (double bend = kLeastBend; bend < kMostBend; bend += kStep) {
      const Vec3 q(0.0, -std::copysign(0.5 * bend, side * hip_moves),
                   std::copysign(bend, side * knee_moves));
      Eigen::Index bad = 0;
      if (is_within_limits(robot, leg, q, bad)) return q;
    }
    return std::nullopt;
  };
  for (const auto& [front, hind] :
       {std::pair{true, false}, std::pair{true, true}, std::pair{false, false}}) {
    bool fits = true;
    for (const Leg leg : kLegs) {
      const std::optional<Vec3> q = bent(leg, is_front(leg) ? front : hind);
      if (q) robot.q_nominal.segment<3>(first_joint(leg)) = *q;
      fits = fits && q;
    }
    if (fits) return;
  }
  top.fail("posture.nominal",
           "this key is missing, and the joints' limits leave no posture with its knees bent by "
           "0.8 to 2 rad under the hips");
}

/// Holds names against those of the URDF.
class NameCheck {
 public:
  NameCheck(const Section& top, const model::Urdf& urdf) : top_(top), urdf_(urdf) {
    for (const model::UrdfLink& link : urdf.links) links_.push_back(link.name);
    for (const model::UrdfJoint& joint : urdf.joints) {
      if (joint.type != "fixed") joints_.push_back(joint.name);
    }
  }

  void frame(const std::string& key, const std::string& name) const {
    check(key, "frame", name, links_);
  }

  void leg(const std::string& key, const model::LegDescription& leg) {
    for (const std::string& joint : leg.joints) {
      check(key + ".joints", "joint", joint, joints_);
      check_hinge(key + ".joints", joint);
    }
    frame(key + ".hip", leg.hip_frame);
    frame(key + ".thigh", leg.thigh_link);
    frame(key + ".shank", leg.shank_link);
    frame(key + ".foot", leg.foot_frame);
  }

 private:
  /// A leg's joints are hinges, and each stands at one place.
  void check_hinge(const std::string& key, const std::string& name) {
    const auto joint = std::ranges::find(urdf_.joints, name, &model::UrdfJoint::name);
    const std::string place = " (" + urdf_.path + ":" + std::to_string(joint->line) + ")";
    if (joint->type != "revolute" && joint->type != "continuous") {
      top_.fail(key, "joint \"" + name + "\" is " + joint->type + place +
                         "; a leg's joint must be revolute");
    }
    if (!joint->mimics.empty()) {
      top_.fail(key, "joint \"" + name + "\" mimics \"" + joint->mimics + "\"" + place +
                         "; a leg's joints must each have a drive of their own");
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
  std::map<std::string, std::string> places_;  // of the joints so far
};

/// The URDF's content, with the robot file's line in front of what is wrong with it.
model::Urdf read_urdf_of(const Section& top, const std::string& path) {
  try {
    return model::read_urdf(path);
  } catch (const Error& error) {
    top.fail("urdf", error.what());
  }
}

/// With the nominal posture each foot stands in its own quadrant: two legs that were exchanged
/// would be walked with, and fall.
void check_quadrants(const ConfigNode& legs, const model::RobotModel& model) {
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

/// Joints and links that the file leaves out: those between the base and the foot.
void complete_leg(const Section& top, const model::Urdf& urdf, const std::string& base,
                  const std::string& key, model::LegDescription& leg) {
  std::vector<const model::UrdfJoint*> chain;
  for (std::string link = leg.foot_frame; link != base && link != urdf.root;) {
    const auto joint = std::ranges::find(urdf.joints, link, &model::UrdfJoint::child);
    if (joint->type != "fixed") chain.insert(chain.begin(), &*joint);
    link = joint->parent;
  }
  if (leg.joints.front().empty()) {
    std::string names;
    for (const model::UrdfJoint* joint : chain) names += " " + joint->name;
    if (chain.size() != leg.joints.size()) {
      top.fail(key, "between the base and \"" + leg.foot_frame + "\" there are " +
                        std::to_string(chain.size()) + " joints that move:" +
                        (names.empty() ? " none" : names) + "; a leg has three, HAA, HFE and KFE");
    }
    for (std::size_t i = 0; i < chain.size(); ++i) leg.joints[i] = chain[i]->name;
  }
  const auto moved_by = [&](const std::string& name) {
    const auto joint = std::ranges::find(urdf.joints, name, &model::UrdfJoint::name);
    return joint == urdf.joints.end() ? std::string() : joint->child;
  };
  if (leg.thigh_link.empty()) leg.thigh_link = moved_by(leg.joints[1]);
  if (leg.hip_frame.empty()) leg.hip_frame = leg.thigh_link;
  if (leg.shank_link.empty()) leg.shank_link = moved_by(leg.joints[2]);
}

/// A number of each joint: the file's, else the URDF's.
class JointNumbers {
 public:
  JointNumbers(const Section& top, const model::Urdf& urdf, const model::RobotDescription& robot)
      : top_(top), urdf_(urdf), robot_(robot) {}

  [[nodiscard]] JointVector of(const char* key, const LegJoints& given,
                               double model::UrdfJoint::* described, bool is_positive) const {
    JointVector numbers = JointVector::Zero();
    for (const Leg leg : kLegs) {
      for (std::size_t i = 0; i < kJointsPerLeg; ++i) {
        const Eigen::Index joint = first_joint(leg) + static_cast<Eigen::Index>(i);
        numbers[joint] = given[static_cast<Eigen::Index>(i)];
        if (!std::isnan(numbers[joint])) continue;
        const model::UrdfJoint& from = *std::ranges::find(
            urdf_.joints, robot_.legs[index(leg)].joints[i], &model::UrdfJoint::name);
        numbers[joint] = from.*described;
        if (std::isnan(numbers[joint]) || (is_positive && numbers[joint] <= 0.0)) {
          top_.fail(key, "this key is missing, and the URDF does not limit joint \"" + from.name +
                             "\" (" + urdf_.path + ":" + std::to_string(from.line) + ")");
        }
      }
    }
    return numbers;
  }

 private:
  const Section& top_;
  const model::Urdf& urdf_;
  const model::RobotDescription& robot_;
};

JointVector or_else(const LegJoints& given, const JointVector& others) {
  const JointVector all = given.replicate<kNumLegs, 1>();
  return all.array().isNaN().select(others, all);
}

void set_limits(const Section& top, const model::Urdf& urdf, const RobotInFile& given,
                model::RobotDescription& robot) {
  const JointNumbers numbers(top, urdf, robot);
  using model::UrdfJoint;
  robot.torque_limit = numbers.of("limits.torque", given.torque, &UrdfJoint::effort, true);
  robot.velocity_limit = numbers.of("limits.velocity", given.velocity, &UrdfJoint::velocity, true);
  robot.q_min = numbers.of("limits.position_min", given.position_min, &UrdfJoint::lower, false);
  robot.q_max = numbers.of("limits.position_max", given.position_max, &UrdfJoint::upper, false);
  for (Eigen::Index i = 0; i < kNumJoints; ++i) {
    if (robot.q_min[i] < robot.q_max[i]) continue;
    top.fail("limits.position_max",
             formatted("must be above position_min at every joint, but joint \"%s\" has %g and %g "
                       "rad",
                       robot.legs[static_cast<std::size_t>(i / kJointsPerLeg)]
                           .joints[static_cast<std::size_t>(i % kJointsPerLeg)]
                           .c_str(),
                       robot.q_min[i], robot.q_max[i]));
  }
  robot.stall_torque = or_else(given.stall_torque, robot.torque_limit);
  robot.no_load_speed = or_else(given.no_load_speed, robot.velocity_limit);
}

/// Gains that the file leaves out: ANYmal B's, for a robot of this size.
void complete_gains(model::RobotDescription& robot) {
  const double stiffness = robot.scale.torque(), damping = stiffness * robot.scale.time();
  if (std::isnan(robot.hold_kp)) robot.hold_kp = 80.0 * stiffness;
  if (std::isnan(robot.hold_kd)) robot.hold_kd = 4.0 * damping;
  if (std::isnan(robot.damping_kd)) robot.damping_kd = 6.0 * damping;
}

/// What no key shows by itself: whether the parts make a robot, how it stands and how large it is.
void complete_robot(const Section& top, const ConfigNode& legs, const Vec3& nominal,
                    model::RobotDescription& robot) {
  const auto model_of = [&] {
    try {
      return model::RobotModel(robot);
    } catch (const FileError& error) {
      top.fail("urdf", error.what());
    } catch (const Error& error) {
      top.fail("legs", error.what());
    }
  };
  if (nominal.array().isNaN().any()) {
    choose_posture(top, model_of(), robot);
  } else {
    set_posture(top, nominal, robot);
  }
  const model::RobotModel model = model_of();
  check_quadrants(legs, model);
  robot.scale = model::scale_of(model::proportions_of(model));
  complete_gains(robot);
}

}  // namespace

model::RobotDescription load_robot(const std::string& name_or_path,
                                   const std::filesystem::path& beside) {
  const std::filesystem::path file = find_data_file("robots", name_or_path, beside);
  const ConfigNode tree = parse_yaml_file(file);
  Section top(tree, "");
  RobotInFile given;
  model::RobotDescription& robot = given.robot;
  robot.hold_kp = robot.hold_kd = robot.damping_kd = kNaN;
  read(top, fields(given));
  top.finish();

  robot.urdf_path = resolve_urdf(top, robot.urdf_path, file);
  for (const std::filesystem::path& folder : package_directories())
    robot.package_folders.push_back(folder.string());
  const model::Urdf urdf = read_urdf_of(top, robot.urdf_path);
  if (robot.base_link.empty()) robot.base_link = urdf.root;
  NameCheck names(top, urdf);
  names.frame("base", robot.base_link);
  for (const Leg leg : kLegs) {
    const std::string key = "legs." + std::string(kLegNames[index(leg)]);
    model::LegDescription& description = robot.legs[index(leg)];
    std::ranges::copy(given.joints[index(leg)], description.joints.begin());
    names.frame(key + ".foot", description.foot_frame);
    complete_leg(top, urdf, robot.base_link, key, description);
    names.leg(key, description);
  }
  set_limits(top, urdf, given, robot);
  complete_robot(top, *tree.find("legs"), given.nominal, robot);
  return robot;
}

}  // namespace surefoot::config
