#include "surefoot/base/formatted.hpp"
#include "surefoot/config/robot_plausibility.hpp"
#include "surefoot/doctor/checks.hpp"
#include "surefoot/doctor/limit_guesses.hpp"
#include "surefoot/model/joints_as_written.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace surefoot::doctor {
namespace {

constexpr double kMostOfLimit = 0.6;  // of the limit, to stand: little is left to walk

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

bool is_mjcf(const Diagnosis& robot) { return !robot.urdf.text.empty(); }

/// The limits of all joints of the legs of one kind.
class LimitCheck {
 public:
  explicit LimitCheck(Diagnosis& robot)
      : robot_(robot), missing_(robot), useless_(robot), placeholders_(robot) {}

  /// `written` tells what stands where a limit is missing; empty: nothing.
  void run(const auto& missing, const auto& written, const auto& is_placeholder,
           const auto& value) {
    for (const FoundLeg& leg : *robot_.anatomy.legs) {
      for (const model::UrdfJoint& joint : leg.joints) {
        if (missing(joint)) {
          const std::string given = written(joint);
          (given.empty() ? missing_ : useless_).add(joint, given);
        } else if (is_placeholder(joint)) {
          placeholders_.add(joint, value(joint));
        }
      }
    }
  }
  /// `taken`: for what is missing.
  void tell(Severity severity, const std::string& limit, const std::string& taken,
            const std::string& placeholder, const std::string& remedy,
            const std::string& what) const {
    const std::string none = "the " + std::string(robot_.urdf.format()) + " has no " + limit;
    missing_.tell(severity, Confidence::certain, none + taken, remedy, robot_.findings);
    useless_.tell(severity, Confidence::certain, none + " above 0" + taken, remedy,
                  robot_.findings);
    placeholders_.tell(Severity::warning, Confidence::likely, placeholder, remedy + what,
                       robot_.findings);
  }

 private:
  Diagnosis& robot_;
  JointList missing_, useless_, placeholders_;
};

/// An effort or velocity limit that is missing, as it is written.
auto written(const Diagnosis& robot, const char* attribute, double model::UrdfJoint::* limit,
             const char* unit) {
  return [&robot, attribute, limit, unit](const model::UrdfJoint& joint) {
    const std::string text = std::isnan(joint.*limit)
                                 ? model::written_limit(robot.urdf, joint.name, attribute)
                                 : formatted("%.4g", joint.*limit);
    return text.empty() ? "" : text + " " + unit;
  };
}

void check_effort(Diagnosis& robot) {
  const double most = most_standing_torque(robot);
  LimitCheck check(robot);
  check.run([](const auto& joint) { return is_missing(joint.effort); },
            written(robot, "effort", &model::UrdfJoint::effort, "N·m"),
            [&](const auto& joint) { return config::is_effort_placeholder(joint.effort, most); },
            [](const auto& joint) { return number(joint.effort, "N·m"); });
  check.tell(Severity::error, "effort limit", "",
             "the effort limit looks like a placeholder, far above what standing needs" +
                 (std::isnan(most) ? std::string() : formatted(" (at most %.3g N·m)", most)),
             "fill in limits.torque of the robot file", " with the drive's torque");
}

void check_velocity(Diagnosis& robot) {
  const LimitGuess guess = limit_guesses(robot)[kVelocity];
  LimitCheck check(robot);
  check.run([](const auto& joint) { return is_missing(joint.velocity); },
            written(robot, "velocity", &model::UrdfJoint::velocity, "rad/s"),
            [](const auto& joint) { return config::is_velocity_placeholder(joint.velocity); },
            [](const auto& joint) { return number(joint.velocity, "rad/s"); });
  check.tell(
      is_mjcf(robot) ? Severity::warning : Severity::error, "velocity limit",
      formatted("; %.3g %s, ANYmal B's to size, is taken for it", guess.numbers[0], guess.unit),
      formatted("the velocity limit looks like a placeholder, above %g rad/s",
                config::kFastestJoint),
      "fill in limits.velocity of the robot file", " with the drive's no-load speed");
}

/// Limits that are below the speeds of a walk's swings.
void check_speed(Diagnosis& robot) {
  // Of a usual joint's: with so much Solo12 and Marten walk, with half of it they do not.
  constexpr double kSwing = 0.1;
  const LimitGuess guess = limit_guesses(robot)[kVelocity];
  JointList slow(robot);
  for (const FoundLeg& leg : *robot.anatomy.legs) {
    for (const model::UrdfJoint& joint : leg.joints) {
      if (!is_missing(joint.velocity) && joint.velocity < kSwing * guess.numbers[0])
        slow.add(joint, number(joint.velocity, guess.unit));
    }
  }
  slow.tell(Severity::warning, Confidence::likely,
            formatted("the velocity limit is too low for a swing, which takes about %.2g %s at "
                      "this size",
                      kSwing * guess.numbers[0], guess.unit),
            "correct it here or in limits.velocity of the robot file; expected are rad/s",
            robot.findings);
}

/// Beyond any turn of a leg: in degrees?
bool is_in_degrees(const model::UrdfJoint& joint) {
  constexpr double kMostTurn = 20.0;  // [rad]
  return std::max(std::abs(joint.lower), std::abs(joint.upper)) > kMostTurn;
}

void check_position(Diagnosis& robot) {
  LimitCheck check(robot), in_degrees(robot);
  const auto value = [](const auto& joint) {
    return formatted("%.4g to %.4g rad", joint.lower, joint.upper);
  };
  const auto turns = [&](const auto& joint) { return gaps_of(robot, joint).turns; };
  const auto is_placeholder = [](const auto& joint) {
    return config::is_position_placeholder(joint.lower, joint.upper) && !is_in_degrees(joint);
  };
  const std::string keys = "limits.position_min and position_max of the robot file";
  const auto nothing = [](const auto&) { return std::string(); };
  check.run([&](const auto& joint) { return has_no_stops(joint) && !turns(joint); }, nothing,
            is_placeholder, value);
  check.tell(Severity::error, "position limits", "",
             "the position limits look like placeholders, a whole turn or more, or empty",
             "fill in " + keys, " with what the legs can do");
  in_degrees.run([](const auto&) { return false; }, nothing, is_in_degrees, value);
  in_degrees.tell(Severity::error, "", "", "the position limits look like degrees",
                  "give them in rad (1° is 0.01745 rad), here or in " + keys, "");
  JointList turning(robot);
  for (const FoundLeg& leg : *robot.anatomy.legs) {
    for (const model::UrdfJoint& joint : leg.joints) {
      if (turns(joint)) turning.add(joint, "");
    }
  }
  const auto [haa, hfe, kfe] = limit_guesses(robot)[kPositionMax].numbers;
  turning.tell(Severity::warning, Confidence::certain,
               formatted("these joints have no stops, so the legs' usual range is taken for them, "
                         "HAA ±%g, HFE ±%g, KFE ±%g rad",
                         haa, hfe, kfe),
               "narrow " + keys + " where something is in the way", robot.findings);
}

/// A limit that joints of arms lack, so that a guess stands in for it. `keys`: of it.
void check_arms(Diagnosis& robot, const LimitGuess& guess, const char* missing, const char* keys) {
  const bool is_position = guess.gap == &LimitGaps::position;
  std::string names;
  int line = 0;
  bool all_turn = true;
  for (const Limb& limb : robot.anatomy.others) {
    for (const model::UrdfJoint& joint : limb.joints) {
      const bool lacks = is_position ? has_no_stops(joint) : is_missing(joint.*guess.given);
      if (!limb.is_arm || !lacks) continue;
      all_turn = all_turn && gaps_of(robot, joint).turns;
      if (line == 0) line = joint.line;
      names += " " + joint.name;
    }
  }
  if (names.empty()) return;
  // An MJCF has no velocity limits at all.
  const bool is_usual =
      is_position ? all_turn : guess.gap == &LimitGaps::velocity && is_mjcf(robot);
  robot.findings.push_back({is_usual ? Severity::warning : Severity::error, Confidence::certain,
                            "arms", line,
                            "the " + std::string(robot.urdf.format()) + " has no " + missing +
                                formatted("; %s%.3g %s is taken:", is_position ? "±" : "",
                                          std::abs(guess.of_arm), guess.unit) +
                                names,
                            std::string("fill in ") + keys + " of the arm in the robot file"});
}

void check_arms(Diagnosis& robot) {
  const std::vector<LimitGuess> guesses = limit_guesses(robot);
  check_arms(robot, guesses[kTorque], "effort limit", "torque");
  check_arms(robot, guesses[kVelocity], "velocity limit", "velocity");
  check_arms(robot, guesses[kPositionMin], "position limits", "position_min and position_max");
}

/// What a leg's drive has at rest.
struct Strength {
  double torque;
  const char* by;  ///< behind the number
};
Strength strength_of(const Diagnosis& robot, const model::UrdfJoint& joint, Eigen::Index i) {
  const double stall = robot.robot ? robot.robot->stall_torque[i] : kInfinity;
  if (stall < joint.effort) return {stall, " N·m, drives.stall_torque"};
  return {joint.effort, " N·m"};
}

void check_strength(Diagnosis& robot) {
  if (std::isnan(most_standing_torque(robot))) return;
  JointList weak(robot), tired(robot);
  for (const Leg leg : robot.anatomy.legs->legs()) {
    for (std::size_t j = 0; j < kJointsPerLeg; ++j) {
      const model::UrdfJoint& joint = (*robot.anatomy.legs)[index(leg)].joints[j];
      const Eigen::Index i = first_joint(leg) + static_cast<Eigen::Index>(j);
      const double needed = std::abs(robot.standing_torque[i]);
      const Strength strength = strength_of(robot, joint, i);
      if (is_missing(joint.effort) || needed < kMostOfLimit * strength.torque) continue;
      JointList& list = needed > strength.torque ? weak : tired;
      list.add(joint, formatted("%.3g of %.3g%s", needed, strength.torque, strength.by));
    }
  }
  weak.tell(
      Severity::error, Confidence::likely, "to stand takes more torque than the limit",
      "are masses in g, efforts or drives.stall_torque in other units? Expected are kg and N·m",
      robot.findings);
  tired.tell(Severity::warning, Confidence::likely,
             "to stand takes most of the torque limit, so little is left to walk",
             "check masses, effort limits and drives.stall_torque", robot.findings);
}

}  // namespace

void check_limits(Diagnosis& robot) {
  if (has_legs(robot.anatomy)) check_arms(robot);
  if (!robot.anatomy.legs) return;
  check_effort(robot);
  check_velocity(robot);
  check_speed(robot);
  check_position(robot);
  check_strength(robot);
}

}  // namespace surefoot::doctor
