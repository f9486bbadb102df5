#include "surefoot/base/formatted.hpp"
#include "surefoot/doctor/checks.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::doctor {
namespace {

constexpr double kTolerance = 0.02;  // of the larger, and of the leg's length for places

/// Two legs that mirror each other.
struct Pair {
  Leg first, second;
  Vec3 mirror;  // of a place, in B
  Severity severity;
  const char* sides;
};

/// Mass of a joint's body, with all that is fixed to it [kg].
double mass_behind(const Diagnosis& robot, const model::UrdfJoint& joint) {
  double mass = 0.0;
  for (const model::UrdfLink& link : robot.urdf.links) {
    if (robot.anatomy.welds.at(link.name).body == joint.child) mass += link.inertia.mass;
  }
  return mass;
}

bool differ(double a, double b) {
  return std::abs(a - b) > kTolerance * std::max(std::abs(a), std::abs(b));
}

/// Compares two legs and tells each difference.
class Comparison {
 public:
  Comparison(Diagnosis& robot, const Pair& pair)
      : robot_(robot),
        pair_(pair),
        a_((*robot.anatomy.legs)[index(pair.first)]),
        b_((*robot.anatomy.legs)[index(pair.second)]) {}

  void run() const {
    compare("thigh, HFE axis to KFE axis", "m", a_.thigh, b_.thigh, b_.joints[2]);
    compare("shank, KFE axis to foot", "m", a_.shank, b_.shank, b_.joints[2]);
    for (std::size_t j = 0; j < kJointsPerLeg; ++j) {
      const std::string what = "mass that " + std::string(kJointNames[j]) + " moves";
      compare(what.c_str(), "kg", mass_behind(robot_, a_.joints[j]),
              mass_behind(robot_, b_.joints[j]), b_.joints[j]);
    }
    compare_hips();
    compare_axes();
  }

 private:
  void compare(const char* what, const char* unit, double a, double b,
               const model::UrdfJoint& joint) const {
    if (differ(a, b)) tell(joint, formatted("%s: %.4g against %.4g %s", what, a, b, unit));
  }

  void compare_hips() const {
    const Vec3 mirrored = a_.hip.cwiseProduct(pair_.mirror);
    if ((mirrored - b_.hip).norm() <= kTolerance * (a_.thigh + a_.shank)) return;
    tell(b_.joints[1],
         formatted("place of the hip: (%.4g, %.4g, %.4g) against (%.4g, %.4g, %.4g) "
                   "m, which is no mirror image",
                   a_.hip.x(), a_.hip.y(), a_.hip.z(), b_.hip.x(), b_.hip.y(), b_.hip.z()));
  }

  /// As lines: which way a joint turns is another question.
  void compare_axes() const {
    constexpr double kMostAngle = 0.05;  // [rad]
    Mat3 R_a = Mat3::Identity(), R_b = Mat3::Identity();
    for (std::size_t j = 0; j < kJointsPerLeg; ++j) {
      R_a = R_a * a_.chain.hinges[j].R;
      R_b = R_b * b_.chain.hinges[j].R;
      const Vec3 mirrored = (R_a * a_.chain.hinges[j].axis).cwiseProduct(pair_.mirror);
      const double share = std::abs(mirrored.dot(R_b * b_.chain.hinges[j].axis));
      const double angle = std::acos(std::min(1.0, share));
      if (angle > kMostAngle)
        tell(b_.joints[j],
             formatted("axis of %s: one is turned by %.3g rad against the other's mirror image",
                       kJointNames[j].data(), angle));
    }
  }

  void tell(const model::UrdfJoint& joint, const std::string& difference) const {
    robot_.findings.push_back(
        {pair_.severity, Confidence::likely, "joint \"" + joint.name + "\"", joint.line,
         std::string(pair_.sides) + " differ, " +
             formatted("%s and %s, ", name_of(pair_.first), name_of(pair_.second)) + difference,
         pair_.severity == Severity::note ? "fine if the robot is built so"
                                          : "correct the leg that is wrong, unless the robot is "
                                            "built so"});
  }

  [[nodiscard]] const char* name_of(Leg leg) const {
    return leg_name(leg, static_cast<int>(robot_.anatomy.legs->size())).data();
  }

  Diagnosis& robot_;
  const Pair pair_;
  const FoundLeg& a_;
  const FoundLeg& b_;
};

}  // namespace

void check_symmetry(Diagnosis& robot) {
  if (!robot.anatomy.legs) return;
  const Vec3 sideways(1.0, -1.0, 1.0), endways(-1.0, 1.0, 1.0);
  const int num_legs = static_cast<int>(robot.anatomy.legs->size());
  for (int k = 0; k < num_legs; k += 2)
    Comparison(robot, {Leg{k}, Leg{k + 1}, sideways, Severity::warning, "left and right"}).run();
  for (const Leg leg : {Leg::LF, Leg::RF})
    Comparison(robot, {leg, same_side(leg, num_legs), endways, Severity::note, "front and hind"})
        .run();
}

}  // namespace surefoot::doctor
