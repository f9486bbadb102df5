#include "surefoot/config/robot_plausibility.hpp"

#include "surefoot/base/formatted.hpp"
#include "surefoot/model/body_tree.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::config {
namespace {

// Wide enough for any robot, too narrow for another unit.
constexpr double kShortestLeg = 0.01, kLongestLeg = 10.0;  // thigh and shank [m]
constexpr double kLeastMass = 0.05, kMostMass = 1e4;       // [kg]
constexpr double kLeastPart = 0.2;  // a thigh of its shank, or a shank of its thigh
constexpr double kMaxSkew = 0.5;    // of the KFE axis against that of HFE [rad]

constexpr double kMostGyration = 5.0;  // [m]

constexpr double kMuchTorque = 20.0;   // times what standing needs
constexpr double kLargeEffort = 1000;  // where that is not known [N·m]
constexpr double kWholeTurn = 2.0 * kPi - 1e-3;

void check_leg(const ConfigNode& legs, const std::string& name, const model::LegChain& chain,
               const model::LegDescription& leg) {
  const auto fail = [&](const std::string& what) {
    fail_at(*legs.find(name), "legs." + name, what);
  };
  if (chain.knee_skew() > kMaxSkew) {
    fail(formatted(
        "the axis of KFE, \"%s\", is turned by %.3g rad against that of HFE, \"%s\"; both "
        "must turn the leg in one plane",
        leg.joints[2].c_str(), chain.knee_skew(), leg.joints[1].c_str()));
  }
  const double thigh = chain.thigh(), shank = chain.shank();
  if (thigh + shank < kShortestLeg || thigh + shank > kLongestLeg) {
    fail(formatted("thigh and shank have %.4g and %.4g m; are the origins in m?", thigh, shank));
  }
  if (shank < kLeastPart * thigh) {
    fail(formatted(
        "its foot, \"%s\", is %.4g m from the knee's axis, and the thigh has %.4g m; name "
        "the frame at the shank's end, or tell its place by foot.center",
        leg.foot_frame.c_str(), shank, thigh));
  }
  if (thigh < kLeastPart * shank) {
    fail(formatted(
        "its thigh, between the axes of HFE and KFE, has %.4g m, and the shank %.4g m; is "
        "the origin of \"%s\" right?",
        thigh, shank, leg.joints[2].c_str()));
  }
}

/// Of the body behind a joint. More than any length of a robot is another unit.
void check_gyration(const ConfigNode& legs, const std::string& name, const std::string& joint,
                    const model::Inertia& inertia, const model::Urdf& urdf) {
  const double gyration = std::sqrt(principal_moments(inertia)[2] / inertia.mass);
  if (gyration < kMostGyration) return;
  const std::string& link = std::ranges::find(urdf.joints, joint, &model::UrdfJoint::name)->child;
  fail_at(
      *legs.find(name), "legs." + name,
      formatted("link \"%s\" (%s:%d) has a radius of gyration, √(I/m), of %.3g m, as if its mass "
                "were that far away; is its inertia in kg·m², and its mass in kg?",
                link.c_str(), urdf.path.c_str(), urdf.find_link(link)->line, gyration));
}

std::string listed(const std::vector<std::string>& names, std::size_t num_joints) {
  if (names.size() == num_joints) return "all joints";
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : " ") + name;
  return text;
}

}  // namespace

void check_plausible(const ConfigNode& legs, const model::Urdf& urdf,
                     const model::RobotDescription& robot) {
  const model::BodyTree tree = model::make_body_tree(robot, urdf);
  const std::vector<std::string> joints = robot.joint_names();
  for (const Leg leg : tree.legs.legs()) {
    const std::string name(leg_name(leg, robot.num_legs()));
    check_leg(legs, name, tree.legs[index(leg)].chain, robot.legs[index(leg)]);
    for (const int body : tree.legs[index(leg)].bodies) {
      const auto joint = static_cast<std::size_t>(body - 1);
      check_gyration(legs, name, joints[joint], tree.limb_bodies[joint].inertia, urdf);
    }
  }
  double mass = 0.0;
  for (const model::UrdfLink& link : urdf.links) mass += link.inertia.mass;
  if (mass < kLeastMass || mass > kMostMass) {
    fail_at(legs, "legs",
            formatted("with them the robot has %.4g kg in all, by %s; are its masses in kg?", mass,
                      urdf.path.c_str()));
  }
}

bool is_effort_placeholder(double effort, double most_standing_torque) {
  return std::isnan(most_standing_torque) ? effort >= kLargeEffort
                                          : effort > kMuchTorque * most_standing_torque;
}

bool is_velocity_placeholder(double velocity) { return velocity > kFastestJoint; }

bool is_position_placeholder(double lower, double upper) {
  return lower <= -kWholeTurn || upper >= kWholeTurn || lower >= upper;
}

std::vector<std::string> placeholder_notes(const model::RobotDescription& robot,
                                           const JointVector& standing_torque) {
  const double most = standing_torque.head(robot.num_leg_joints()).cwiseAbs().maxCoeff();
  const auto num_joints = static_cast<std::size_t>(robot.num_leg_joints());
  std::vector<std::string> efforts, velocities, notes;
  const std::vector<std::string> names = robot.joint_names();
  for (std::size_t i = 0; i < num_joints; ++i) {
    const auto joint = static_cast<Eigen::Index>(i);
    if (is_effort_placeholder(robot.torque_limit[joint], most)) efforts.push_back(names[i]);
    if (is_velocity_placeholder(robot.velocity_limit[joint])) velocities.push_back(names[i]);
  }
  if (!efforts.empty()) {
    notes.push_back("limits.torque of " + listed(efforts, num_joints) +
                    formatted(" is up to %g N·m, far above the %.3g N·m that standing needs",
                              robot.torque_limit.head(robot.num_leg_joints()).maxCoeff(), most));
  }
  if (!velocities.empty()) {
    notes.push_back("limits.velocity of " + listed(velocities, num_joints) +
                    formatted(" is up to %g rad/s, above %g",
                              robot.velocity_limit.head(robot.num_leg_joints()).maxCoeff(),
                              kFastestJoint));
  }
  for (std::string& note : notes) note += kPlaceholder;
  return notes;
}

}  // namespace surefoot::config
