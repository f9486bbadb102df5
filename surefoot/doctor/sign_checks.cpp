#include "surefoot/doctor/checks.hpp"
#include "surefoot/doctor/knees.hpp"

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
                            never ? "correct <limit> lower and upper of KFE, rad" : ""});
}

/// A left and a right knee that bend to no side in common can't stand alike.
void check_pair(Diagnosis& robot, Leg left, Leg right) {
  const PerLeg<FoundLeg>& legs = *robot.anatomy.legs;
  const KneeSides a = knee_sides(legs[index(left)]), b = knee_sides(legs[index(right)]);
  const bool is_one_sided = a.backward != a.forward && b.backward != b.forward;
  if (!is_one_sided || a.backward == b.backward) return;
  const model::UrdfJoint& knee = legs[index(right)].joints[2];
  robot.findings.push_back(
      {Severity::error, Confidence::likely, "joint \"" + knee.name + "\"", knee.line,
       "by their limits the knee of " +
           std::string(leg_name(right, static_cast<int>(legs.size()))) + " bends " + name(b) +
           " only, that of " + std::string(leg_name(left, static_cast<int>(legs.size()))) + " " +
           name(a) + " only",
       "exchange and negate lower and upper of the one that is wrong", true});
}

}  // namespace

void check_signs(Diagnosis& robot) {
  if (!robot.anatomy.legs) return;
  for (std::size_t joint = 0; joint < kJointsPerLeg; ++joint) check_joint(robot, joint);
  const int num_legs = static_cast<int>(robot.anatomy.legs->size());
  for (int left = 0; left < num_legs; left += 2) check_pair(robot, Leg{left}, Leg{left + 1});
  for (const KneeSides& sides : {KneeSides{true, false}, KneeSides{false, true}, KneeSides{}}) {
    std::string legs;
    for (const Leg leg : first_legs(num_legs)) {
      if (name(knee_sides((*robot.anatomy.legs)[index(leg)])) == std::string_view(name(sides)))
        legs += " " + std::string(leg_name(leg, num_legs));
    }
    tell_knees(robot, name(sides), legs);
  }
}

}  // namespace surefoot::doctor
