#include "surefoot/base/formatted.hpp"
#include "surefoot/config/robot_plausibility.hpp"
#include "surefoot/doctor/checks.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace surefoot::doctor {
namespace {

constexpr double kMostOfLimit = 0.6;  // of the limit, to stand: little is left to walk

bool is_missing(double number) { return std::isnan(number) || number <= 0.0; }

double most_standing_torque(const Diagnosis& robot) {
  return robot.standing_torque.cwiseAbs().maxCoeff();
}

bool is_effort_placeholder(const Diagnosis& robot, double effort) {
  return config::is_effort_placeholder(effort, most_standing_torque(robot));
}

bool is_position_placeholder(const model::UrdfJoint& joint) {
  return config::is_position_placeholder(joint.lower, joint.upper);
}

bool has_no_position(const model::UrdfJoint& joint) {
  return std::isnan(joint.lower) || std::isnan(joint.upper);
}

/// The joints of all legs with the same fault, in one finding, by value.
class JointList {
 public:
  explicit JointList(const Diagnosis& robot)
      : num_leg_joints_(kJointsPerLeg * static_cast<int>(robot.anatomy.legs->size())) {}

  void add(const model::UrdfJoint& joint, const std::string& value) {
    if (line_ == 0) line_ = joint.line;
    ++count_;
    const auto same = std::ranges::find(groups_, value, &Group::value);
    Group& group = same == groups_.end() ? groups_.emplace_back(Group{value, {}, 0}) : *same;
    group.names += (group.count++ == 0 ? "" : " ") + joint.name;
  }
  void tell(Severity severity, Confidence confidence, const std::string& what,
            const std::string& remedy, Findings& findings) const {
    if (count_ == 0) return;
    std::string text;
    for (const Group& group : groups_) {
      text += (text.empty() ? "" : "; ") +
              (group.count == num_leg_joints_ ? "all joints of the legs" : group.names) +
              (group.value.empty() ? "" : ", " + group.value);
    }
    findings.push_back({severity, confidence, count_ == 1 ? "joint" : "joints", line_,
                        what + ": " + text, remedy});
  }

 private:
  struct Group {
    std::string value, names;
    int count;
  };
  int num_leg_joints_;
  std::vector<Group> groups_;
  int line_ = 0, count_ = 0;
};

std::string number(double value, const char* unit) { return formatted("%.4g %s", value, unit); }

void check_effort(Diagnosis& robot) {
  const std::string format = robot.urdf.format();
  JointList missing(robot), placeholders(robot);
  for (const FoundLeg& leg : *robot.anatomy.legs) {
    for (const model::UrdfJoint& joint : leg.joints) {
      if (is_missing(joint.effort)) {
        missing.add(joint, "");
      } else if (is_effort_placeholder(robot, joint.effort)) {
        placeholders.add(joint, number(joint.effort, "N·m"));
      }
    }
  }
  missing.tell(Severity::error, Confidence::certain, "the " + format + " has no effort limit",
               "fill in limits.torque of the robot file", robot.findings);
  placeholders.tell(Severity::warning, Confidence::likely,
                    "the effort limit looks like a placeholder, far above what standing needs" +
                        (std::isnan(most_standing_torque(robot))
                             ? std::string()
                             : formatted(" (at most %.3g N·m)", most_standing_torque(robot))),
                    "fill in limits.torque of the robot file with the drive's torque",
                    robot.findings);
}

void check_velocity(Diagnosis& robot) {
  const std::string format = robot.urdf.format();
  JointList missing(robot), placeholders(robot);
  for (const FoundLeg& leg : *robot.anatomy.legs) {
    for (const model::UrdfJoint& joint : leg.joints) {
      if (is_missing(joint.velocity)) {
        missing.add(joint, "");
      } else if (config::is_velocity_placeholder(joint.velocity)) {
        placeholders.add(joint, number(joint.velocity, "rad/s"));
      }
    }
  }
  missing.tell(Severity::error, Confidence::certain, "the " + format + " has no velocity limit",
               "fill in limits.velocity of the robot file", robot.findings);
  placeholders.tell(Severity::warning, Confidence::likely,
                    "the velocity limit looks like a placeholder, above 100 rad/s",
                    "fill in limits.velocity of the robot file with the drive's no-load speed",
                    robot.findings);
}

void check_position(Diagnosis& robot) {
  const std::string format = robot.urdf.format();
  JointList missing(robot), placeholders(robot);
  for (const FoundLeg& leg : *robot.anatomy.legs) {
    for (const model::UrdfJoint& joint : leg.joints) {
      if (has_no_position(joint)) {
        missing.add(joint, "");
      } else if (is_position_placeholder(joint)) {
        placeholders.add(joint, formatted("%.4g to %.4g rad", joint.lower, joint.upper));
      }
    }
  }
  missing.tell(Severity::error, Confidence::certain, "the " + format + " has no position limits",
               "fill in limits.position_min and position_max of the robot file", robot.findings);
  placeholders.tell(Severity::warning, Confidence::likely,
                    "the position limits look like placeholders, a whole turn or more, or empty",
                    "fill in limits.position_min and position_max of the robot file with what the "
                    "legs can do",
                    robot.findings);
}

/// What arms lack, for which guesses stand in.
void check_arms(Diagnosis& robot) {
  for (const auto& [described, what, key] :
       {std::tuple{&model::UrdfJoint::effort, " has no effort limit", "torque"},
        {&model::UrdfJoint::velocity, " has no velocity limit", "velocity"},
        {&model::UrdfJoint::lower, " has no position limits", "position_min and position_max"}}) {
    std::string names;
    int line = 0;
    for (const Limb& limb : robot.anatomy.others) {
      for (const model::UrdfJoint& joint : limb.joints) {
        const double given = joint.*described;
        const bool is_missing =
            std::isnan(given) || (described != &model::UrdfJoint::lower && given <= 0.0);
        if (!limb.is_arm || !is_missing) continue;
        if (line == 0) line = joint.line;
        names += " " + joint.name;
      }
    }
    if (names.empty()) continue;
    robot.findings.push_back({Severity::error, Confidence::certain, "arms", line,
                              "the " + std::string(robot.urdf.format()) + what + ":" + names,
                              "fill in " + std::string(key) + " of the arm in the robot file"});
  }
}

void check_strength(Diagnosis& robot) {
  if (std::isnan(most_standing_torque(robot))) return;
  JointList weak(robot), tired(robot);
  for (const Leg leg : robot.anatomy.legs->legs()) {
    for (std::size_t j = 0; j < kJointsPerLeg; ++j) {
      const model::UrdfJoint& joint = (*robot.anatomy.legs)[index(leg)].joints[j];
      const double needed =
          std::abs(robot.standing_torque[first_joint(leg) + static_cast<Eigen::Index>(j)]);
      if (is_missing(joint.effort) || needed < kMostOfLimit * joint.effort) continue;
      JointList& list = needed > joint.effort ? weak : tired;
      list.add(joint, formatted("%.3g of %.3g N·m", needed, joint.effort));
    }
  }
  weak.tell(Severity::error, Confidence::likely, "to stand takes more torque than the limit",
            "are masses in g or efforts in other units? Expected are kg and N·m", robot.findings);
  tired.tell(Severity::warning, Confidence::likely,
             "to stand takes most of the torque limit, so little is left to walk",
             "check masses and effort limits", robot.findings);
}

}  // namespace

LimitGaps gaps_of(const Diagnosis& robot, const model::UrdfJoint& joint) {
  return {.effort = is_missing(joint.effort) || is_effort_placeholder(robot, joint.effort),
          .velocity = is_missing(joint.velocity) || config::is_velocity_placeholder(joint.velocity),
          .position = has_no_position(joint) || is_position_placeholder(joint)};
}

bool has_gaps(const Diagnosis& robot) {
  if (!robot.anatomy.legs) return false;
  return std::ranges::any_of(*robot.anatomy.legs, [&](const FoundLeg& leg) {
    return std::ranges::any_of(leg.joints, [&](const model::UrdfJoint& joint) {
      const LimitGaps gaps = gaps_of(robot, joint);
      return gaps.effort || gaps.velocity || gaps.position;
    });
  });
}

void check_limits(Diagnosis& robot) {
  if (has_legs(robot.anatomy)) check_arms(robot);
  if (!robot.anatomy.legs) return;
  check_effort(robot);
  check_velocity(robot);
  check_position(robot);
  check_strength(robot);
}

}  // namespace surefoot::doctor
