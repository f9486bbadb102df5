#include "surefoot/base/formatted.hpp"
#include "surefoot/doctor/checks.hpp"
#include "surefoot/doctor/knees.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

namespace surefoot::doctor {
namespace {

/// Signs of the legs at one joint.
PerLeg<double> signs_of(const PerLeg<FoundLeg>& legs, std::size_t joint) {
  PerLeg<double> signs(static_cast<int>(legs.size()), 0.0);
  for (const Leg leg : legs.legs())
    signs[index(leg)] = turning_signs(legs[index(leg)])[static_cast<Eigen::Index>(joint)];
  return signs;
}

/// The leg that alone turns its own way; signs.size(): none.
std::size_t odd_one(const PerLeg<double>& signs) {
  double sum = 0.0;
  for (const double sign : signs) sum += sign;
  const double others = static_cast<double>(signs.size()) - 2.0;
  for (std::size_t leg = 0; leg < signs.size(); ++leg) {
    if (signs[leg] * sum == -others) return leg;
  }
  return signs.size();
}

void tell_odd(Diagnosis& robot, std::size_t leg, std::size_t joint) {
  const model::UrdfJoint& odd = (*robot.anatomy.legs)[leg].joints[joint];
  robot.findings.push_back(
      {Severity::error, Confidence::likely, "joint \"" + odd.name + "\"", odd.line,
       "the " + std::string(kJointNames[joint]) + " of " +
           std::string(leg_names(static_cast<int>(robot.anatomy.legs->size()))[leg]) +
           " turns the other way than those of the other legs, by the " + robot.urdf.format() +
           "; if its drive does not, the controller drives it the wrong way",
       "change the sign of its <axis>, and exchange and negate its lower and upper limit, unless "
       "the robot is built so"});
}

/// Some and some: which belong together?
void tell_pairs(Diagnosis& robot, const PerLeg<double>& signs, std::size_t joint) {
  bool sides_alike = signs[0] != signs[1], pairs_alike = true;
  for (std::size_t leg = 2; leg < signs.size(); ++leg) sides_alike &= signs[leg] == signs[leg - 2];
  for (std::size_t leg = 0; leg < signs.size(); leg += 2)
    pairs_alike &= signs[leg] == signs[leg + 1];
  const auto other = static_cast<std::size_t>(std::ranges::find(signs, -signs[0]) - signs.begin());
  if (joint == 0 && sides_alike) return;
  const model::UrdfJoint& first =
      (*robot.anatomy.legs)[signs.size() == kNumLegs && !sides_alike ? 2 : other].joints[joint];
  const bool is_hind = pairs_alike && signs.size() == kNumLegs;
  const bool is_regular = sides_alike || pairs_alike;
  robot.findings.push_back(
      {is_regular ? Severity::note : Severity::warning, Confidence::certain,
       "joint \"" + first.name + "\"", first.line,
       std::string(kJointNames[joint]) + " turns one way in " +
           (signs.size() == kNumLegs ? "two"
            : sides_alike            ? "three"
                                     : "some") +
           " legs and the other way in the " +
           (sides_alike                ? "right ones"
            : is_hind                  ? "hind ones"
            : signs.size() == kNumLegs ? "diagonal ones"
                                       : "others"),
       joint == 0 ? "fine as long as posture.nominal has HAA at 0"
                  : "fine if the drives turn so; a posture.nominal of these legs is then given by "
                    "legs.RF.posture.nominal and so on"});
}

void check_joint(Diagnosis& robot, std::size_t joint) {
  const PerLeg<double> signs = signs_of(*robot.anatomy.legs, joint);
  double sum = 0.0;
  for (const double sign : signs) sum += sign;
  const std::size_t odd = odd_one(signs);
  if (odd < signs.size()) {
    tell_odd(robot, odd, joint);
  } else if (std::abs(sum) < static_cast<double>(signs.size())) {
    tell_pairs(robot, signs, joint);
  }
}

/// Of a knee that hardly bends: were radians read as degrees?
std::string remedy_of_stiff(const Diagnosis& robot, const model::UrdfJoint& knee) {
  constexpr double kPerDegree = kPi / 180.0;
  const double most = std::max(std::abs(knee.lower), std::abs(knee.upper));
  const bool is_mjcf = !robot.urdf.text.empty();
  if (is_mjcf && most > 0.0 && most < kPi * kPerDegree)
    return formatted(
        "is range=\"%.3g %.3g\" in radians? Then add <compiler angle=\"radian\"/>; "
        "without it an MJCF has degrees",
        knee.lower / kPerDegree, knee.upper / kPerDegree);
  return "correct <limit> lower and upper of KFE, rad";
}

/// Legs whose knees bend to one side only, told together.
void tell_knees(Diagnosis& robot, const char* side, const std::string& legs) {
  if (legs.empty()) return;
  const model::UrdfJoint& knee = (*robot.anatomy.legs)[0].joints[2];
  const bool never = std::string_view(side) == name(KneeSides{});
  robot.findings.push_back({never ? Severity::error : Severity::note, Confidence::certain, "knees",
                            knee.line,
                            "by their limits the knees of" + legs +
                                (never ? " bend by less than 0.5 rad to either side"
                                       : " bend " + std::string(side) + " only"),
                            never ? remedy_of_stiff(robot, knee) : ""});
}

/// A left and a right knee that bend to no side in common can't stand alike. Told of the one that
/// fewer legs are like, else of the right one, unless it is the axis that turns the other way.
void check_pair(Diagnosis& robot, Leg left, Leg right) {
  const PerLeg<FoundLeg>& legs = *robot.anatomy.legs;
  const auto sides_of = [&](Leg leg) { return knee_sides(legs[index(leg)]); };
  const KneeSides a = sides_of(left), b = sides_of(right);
  const bool is_one_sided = a.backward != a.forward && b.backward != b.forward;
  if (!is_one_sided || a.backward == b.backward) return;
  const auto num_like = [&](Leg leg) {
    return std::ranges::count_if(legs.legs(), [&](Leg each) {
      return std::string_view(name(sides_of(each))) == name(sides_of(leg));
    });
  };
  const bool is_left_odd = num_like(left) < num_like(right);
  const Leg odd = is_left_odd ? left : right, other = is_left_odd ? right : left;
  const model::UrdfJoint& knee = legs[index(odd)].joints[2];
  const std::string subject = "joint \"" + knee.name + "\"";
  if (std::ranges::count(robot.findings, subject, &Finding::subject) > 0) return;
  const auto leg_of = [&](Leg leg) {
    return std::string(leg_name(leg, static_cast<int>(legs.size())));
  };
  robot.findings.push_back({Severity::error, Confidence::likely, subject, knee.line,
                            "by their limits the knee of " + leg_of(odd) + " bends " +
                                name(sides_of(odd)) + " only, that of " + leg_of(other) + " " +
                                name(sides_of(other)) + " only",
                            "exchange and negate lower and upper of the one that is wrong", true});
}

/// The leg whose knee alone bends to other sides than all others, which agree; legs.size(): none.
std::size_t odd_knee(const PerLeg<FoundLeg>& legs) {
  const auto side_of = [&](Leg leg) {
    return std::string_view(name(knee_sides(legs[index(leg)])));
  };
  for (const Leg leg : legs.legs()) {
    const Leg other{leg == Leg{0} ? 1 : 0};
    const bool others_agree = std::ranges::all_of(
        legs.legs(), [&](Leg each) { return each == leg || side_of(each) == side_of(other); });
    const bool is_odd = others_agree && side_of(leg) != side_of(other);
    const bool both_bend = side_of(leg) != name(KneeSides{}) && side_of(other) != name(KneeSides{});
    if (is_odd && both_bend) return index(leg);
  }
  return legs.size();
}

/// Some sides are the same, so that the robot stands; `check_pair` tells where none are.
void tell_odd_knee(Diagnosis& robot, Leg leg) {
  const PerLeg<FoundLeg>& legs = *robot.anatomy.legs;
  const model::UrdfJoint& knee = legs[index(leg)].joints[2];
  const Leg other{leg == Leg{0} ? 1 : 0};
  robot.findings.push_back(
      {Severity::warning, Confidence::likely, "joint \"" + knee.name + "\"", knee.line,
       formatted("by their limits, %.3g to %.3g rad, the knee of ", knee.lower, knee.upper) +
           std::string(leg_name(leg, static_cast<int>(legs.size()))) + " bends " +
           name(knee_sides(legs[index(leg)])) + ", those of the other legs " +
           name(knee_sides(legs[index(other)])),
       "correct its lower and upper limit, unless the robot is built so"});
}

}  // namespace

void check_signs(Diagnosis& robot) {
  if (!robot.anatomy.legs) return;
  for (std::size_t joint = 0; joint < kJointsPerLeg; ++joint) check_joint(robot, joint);
  const int num_legs = static_cast<int>(robot.anatomy.legs->size());
  for (int left = 0; left < num_legs; left += 2) check_pair(robot, Leg{left}, Leg{left + 1});
  const std::size_t none = robot.anatomy.legs->size();
  const std::size_t odd = has_cause(robot.findings) ? none : odd_knee(*robot.anatomy.legs);
  if (odd < none) tell_odd_knee(robot, Leg{static_cast<int>(odd)});
  for (const KneeSides& sides : {KneeSides{true, false}, KneeSides{false, true}, KneeSides{}}) {
    std::string legs;
    for (const Leg leg : first_legs(num_legs)) {
      if (index(leg) == odd) continue;
      if (name(knee_sides((*robot.anatomy.legs)[index(leg)])) == std::string_view(name(sides)))
        legs += " " + std::string(leg_name(leg, num_legs));
    }
    tell_knees(robot, name(sides), legs);
  }
}

}  // namespace surefoot::doctor
