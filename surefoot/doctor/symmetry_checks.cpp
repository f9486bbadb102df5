#include "surefoot/base/formatted.hpp"
#include "surefoot/doctor/checks.hpp"
#include "surefoot/doctor/knees.hpp"
#include "surefoot/doctor/limit_guesses.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace surefoot::doctor {
namespace {

constexpr double kTolerance = 0.02;  // of the larger, and of the leg's length for places
constexpr double kMostAngle = 0.05;  // between axes, and between links at q = 0 [rad]
// CAD's left and right are never quite alike in what moves with them.
constexpr double kOtherLimit = 0.1;    // of a position [rad], and of the larger effort or velocity
constexpr double kOtherCom = 0.06;     // of the leg's length
constexpr double kOtherInertia = 0.5;  // of the larger, as matrices' norms

/// Something of a leg that its mirror image has, too.
struct Trait {
  std::string what;
  std::size_t joint;           // whose line is told
  std::vector<double> left;    // as of a left leg
  std::vector<double> turned;  // the same with x mirrored, as of a leg at the other end
  double tolerance;            // of the distance between two legs' numbers
  std::string text;            // as the file has it; empty: told as an angle between two lines
  const char* unit = "";       // behind it
  bool of_all_legs = false;    // do front and hind legs have it alike, as a rule?
  bool may_follow = false;     // from another fault of its joint?
};

double distance(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum);
}

/// What is not known differs from nothing.
bool differ(const Trait& a, const Trait& b) {
  return distance(a.left, b.left) > std::max(a.tolerance, b.tolerance);
}

bool are_alike(const Trait& a, const Trait& b) {
  return !differ(a, b) || distance(a.left, b.turned) <= std::max(a.tolerance, b.tolerance);
}

std::vector<double> numbers_of(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
std::vector<double> numbers_of(const Mat3& m) { return {m.data(), m.data() + 9}; }

/// The traits of one leg, in an order that all legs share.
class Traits {
 public:
  Traits(const Diagnosis& robot, Leg leg)
      : robot_(robot),
        leg_((*robot.anatomy.legs)[index(leg)]),
        to_left_(1.0, is_left(leg) ? 1.0 : -1.0, 1.0),
        length_(leg_.thigh + leg_.shank) {}

  std::vector<Trait> all() {
    add_size("thigh, HFE axis to KFE axis", " m", 2, leg_.thigh);
    add_size("shank, KFE axis to foot", " m", 2, leg_.shank);
    for (std::size_t j = 0; j < kJointsPerLeg; ++j) {
      // Of a mass of 0 more is told than that it differs, and so below.
      const double mass = body_of(j).mass;
      add_size("mass that " + std::string(kJointNames[j]) + " moves", " kg", j,
               mass > 0.0 ? mass : kNaN);
    }
    add_vector("place of the hip", 1, leg_.hip, kTolerance * length_, true);
    Mat3 R = Mat3::Identity();
    for (std::size_t j = 0; j < kJointsPerLeg; ++j) {
      R = R * leg_.chain.hinges[j].R;
      add_axis(j, R * leg_.chain.hinges[j].axis);
    }
    add_zeros();
    R.setIdentity();
    for (std::size_t j = 0; j < kJointsPerLeg; ++j) {
      R = R * leg_.chain.hinges[j].R;
      add_body(j, R);
      add_limits(j);
    }
    return std::move(traits_);
  }

 private:
  /// Of a joint's body, with all that is fixed to it, in the frame of the joint's child.
  [[nodiscard]] model::Inertia body_of(std::size_t joint) const {
    model::Inertia sum;
    for (const model::UrdfLink& link : robot_.urdf.links) {
      const model::Weld& weld = robot_.anatomy.welds.at(link.name);
      if (weld.body == leg_.joints[joint].child) sum = sum + link.inertia.placed(weld.R, weld.p);
    }
    return sum;
  }

  void add_size(const std::string& what, const char* unit, std::size_t joint, double size) {
    traits_.push_back(
        {what, joint, {size}, {size}, kTolerance * size, formatted("%.4g", size), unit, true});
  }

  void add_vector(const std::string& what, std::size_t joint, const Vec3& v, double tolerance,
                  bool of_all_legs) {
    const Vec3 left = v.cwiseProduct(to_left_);
    traits_.push_back({what, joint, numbers_of(left), numbers_of(turned(left)), tolerance,
                       formatted("(%.4g, %.4g, %.4g)", v.x(), v.y(), v.z()), " m", of_all_legs,
                       !of_all_legs});
  }

  /// As lines: which way a joint turns is another question.
  void add_axis(std::size_t joint, const Vec3& axis) {
    const Vec3 left = axis.cwiseProduct(to_left_), at_end = turned(left);
    traits_.push_back({"axis of " + std::string(kJointNames[joint]), joint,
                       numbers_of(Mat3(left * left.transpose())),
                       numbers_of(Mat3(at_end * at_end.transpose())),
                       std::sqrt(2.0) * std::sin(kMostAngle), "", "", true});
  }

  /// Where thigh and shank point at q = 0, in the plane of x and z: forward from straight down.
  void add_zeros() {
    const model::LegChain& chain = leg_.chain;
    const Mat3 R_haa = chain.hinges[0].R, R_hfe = R_haa * chain.hinges[1].R;
    const auto forward = [](const Vec3& v) { return std::atan2(v.x(), -v.z()); };
    const double thigh = forward(R_hfe * chain.hinges[2].p);
    const double shank = forward(R_hfe * chain.hinges[2].R * chain.foot);
    add_zero(1, "thigh at the joints' 0, forward from straight down", thigh);
    add_zero(2, "shank at the joints' 0, forward from the thigh",
             std::remainder(shank - thigh, 2.0 * kPi));
  }
  void add_zero(std::size_t joint, const char* what, double angle) {
    traits_.push_back({what,
                       joint,
                       {std::cos(angle), std::sin(angle)},
                       {std::cos(angle), -std::sin(angle)},
                       kMostAngle,
                       formatted("%.3g", angle),
                       " rad",
                       false,
                       true});
  }

  void add_body(std::size_t joint, const Mat3& R) {
    const model::Inertia body = body_of(joint);
    const std::string what = " of what " + std::string(kJointNames[joint]) + " moves";
    add_vector("centre of mass" + what + ", from the joint", joint,
               body.mass > 0.0 ? Vec3(R * body.com) : Vec3(Vec3::Constant(kNaN)),
               kOtherCom * length_, false);
    const Mat3 left =
        to_left_.asDiagonal() * R * body.about_com * R.transpose() * to_left_.asDiagonal();
    const Vec3 x_turned(-1.0, 1.0, 1.0), moments = principal_moments(body);
    traits_.push_back({"inertia" + what, joint, numbers_of(left),
                       numbers_of(Mat3(x_turned.asDiagonal() * left * x_turned.asDiagonal())),
                       kOtherInertia * left.norm(),
                       formatted("%.3g, %.3g, %.3g", moments.x(), moments.y(), moments.z()),
                       " kg·m²", false, true});
  }

  void add_limits(std::size_t joint) {
    const model::UrdfJoint& limits = leg_.joints[joint];
    const auto add_limit = [&](const char* what, double limit, const char* unit) {
      if (is_missing(limit)) limit = kNaN;
      traits_.push_back({what + (" of " + std::string(kJointNames[joint])),
                         joint,
                         {limit},
                         {limit},
                         kOtherLimit * limit,
                         formatted("%.4g", limit),
                         unit});
    };
    add_limit("effort limit", limits.effort, " N·m");
    add_limit("velocity limit", limits.velocity, " rad/s");
    const double outward = joint == 0 ? to_left_.y() : 1.0;
    const double sign = outward * turning_signs(leg_)[static_cast<Eigen::Index>(joint)];
    double lower = sign > 0.0 ? limits.lower : -limits.upper;
    const double upper = sign > 0.0 ? limits.upper : -limits.lower;
    if (lower > upper) lower = kNaN;  // told as such
    const std::vector<double> here{lower, upper}, there{-upper, -lower};
    traits_.push_back({"position limits of " + std::string(kJointNames[joint]), joint, here,
                       joint == 0 ? here : there, kOtherLimit,
                       formatted("%.4g to %.4g", limits.lower, limits.upper), " rad", false, true});
  }

  static Vec3 turned(const Vec3& v) { return {-v.x(), v.y(), v.z()}; }

  const Diagnosis& robot_;
  const FoundLeg& leg_;
  const Vec3 to_left_;
  const double length_;
  std::vector<Trait> traits_;
};

std::string subject(const model::UrdfJoint& joint) { return "joint \"" + joint.name + "\""; }

std::string difference(const Trait& a, const Trait& b) {
  if (!a.text.empty()) {
    return a.text + " against " + b.text + a.unit +
           (a.text == b.text || a.left.size() == 3 ? ", which is no mirror image" : "");
  }
  const double sine = distance(a.left, b.left) / std::sqrt(2.0);
  return formatted("one is turned by %.3g rad against the other's mirror image",
                   std::asin(std::min(1.0, sine)));
}

/// Compares legs with their mirror images.
class Comparison {
 public:
  explicit Comparison(Diagnosis& robot)
      : robot_(robot),
        legs_(*robot.anatomy.legs),
        traits_(static_cast<int>(legs_.size()), std::vector<Trait>()) {
    for (const Leg leg : legs_.legs()) traits_[index(leg)] = Traits(robot, leg).all();
    for (const Finding& finding : robot.findings)
      if (finding.severity != Severity::note) told_.insert(finding.subject);
  }

  void run() {
    const int num_legs = static_cast<int>(legs_.size());
    for (int k = 0; k < num_legs; k += 2) compare_sides(Leg{k}, Leg{k + 1});
    for (const Leg leg : {Leg::LF, Leg::RF}) compare_ends(leg, same_side(leg, num_legs));
  }

 private:
  void compare_sides(Leg left, Leg right) {
    for (std::size_t i = 0; i < traits_[index(left)].size(); ++i) {
      const Trait &a = trait(left, i), &b = trait(right, i);
      const auto is_told = [&](Leg leg) { return told_.contains(subject(joint_of(leg, i))); };
      if (!differ(a, b) || (a.may_follow && (is_told(left) || is_told(right)))) continue;
      const auto [odd, is_sure] = odd_one(left, right, i);
      if (is_sure) odd_.emplace(odd, i);
      tell(Severity::warning, "left and right", left, right, odd, i);
      // Turned links are elsewhere, and so is all that they move.
      if (a.may_follow)
        for (std::size_t j = a.joint; j < kJointsPerLeg; ++j)
          told_.insert(subject(legs_[index(odd)].joints[j]));
    }
  }

  void compare_ends(Leg front, Leg hind) {
    for (std::size_t i = 0; i < traits_[index(front)].size(); ++i) {
      const Trait &a = trait(front, i), b = turned(trait(hind, i));
      if (!a.of_all_legs || !differ(a, b)) continue;
      if (odd_.contains({front, i}) || odd_.contains({hind, i})) continue;
      tell(Severity::note, "front and hind", front, hind, hind, i);
    }
  }

  /// Of two legs that differ, the one that fewer others are like, else the right one; sure where
  /// none are like it, and all like the other.
  [[nodiscard]] std::pair<Leg, bool> odd_one(Leg left, Leg right, std::size_t i) const {
    int like_left = 0, like_right = 0;
    for (const Leg other : legs_.legs()) {
      if (other == left || other == right) continue;
      like_left += int{are_alike(trait(left, i), trait(other, i))};
      like_right += int{are_alike(trait(right, i), trait(other, i))};
    }
    const auto others = static_cast<int>(legs_.size()) - 2;
    const bool is_sure = std::min(like_left, like_right) == 0 &&
                         std::max(like_left, like_right) == others && others > 0;
    return {like_left < like_right ? left : right, is_sure};
  }

  void tell(Severity severity, const char* sides, Leg first, Leg second, Leg odd,
            std::size_t i) const {
    const model::UrdfJoint& joint = joint_of(odd, i);
    const Trait &a = trait(first, i), &b = trait(second, i);
    std::string what = std::string(sides) + " differ, " + name_of(first) + " and " +
                       name_of(second) + ", " + a.what + ": " +
                       difference(a, severity == Severity::note ? turned(b) : b);
    if (odd_.contains({odd, i}))
      what += "; the other legs are as " + name_of(odd == first ? second : first);
    robot_.findings.push_back(
        {severity, Confidence::likely, subject(joint), joint.line, std::move(what),
         severity == Severity::note ? "fine if the robot is built so"
                                    : "correct the leg that is wrong, unless the robot is "
                                      "built so"});
  }

  /// As of a leg at the robot's other end.
  static Trait turned(Trait trait) {
    std::swap(trait.left, trait.turned);
    return trait;
  }
  [[nodiscard]] const Trait& trait(Leg leg, std::size_t i) const { return traits_[index(leg)][i]; }
  [[nodiscard]] const model::UrdfJoint& joint_of(Leg leg, std::size_t i) const {
    return legs_[index(leg)].joints[trait(leg, i).joint];
  }
  [[nodiscard]] std::string name_of(Leg leg) const {
    return std::string(leg_name(leg, static_cast<int>(legs_.size())));
  }

  Diagnosis& robot_;
  const PerLeg<FoundLeg>& legs_;
  PerLeg<std::vector<Trait>> traits_;
  std::set<std::string> told_;                 // joints of which more would only follow
  std::set<std::pair<Leg, std::size_t>> odd_;  // legs that differ from all others, by trait
};

}  // namespace

void check_symmetry(Diagnosis& robot) {
  if (robot.anatomy.legs) Comparison(robot).run();
}

}  // namespace surefoot::doctor
