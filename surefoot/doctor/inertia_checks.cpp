#include "surefoot/base/formatted.hpp"
#include "surefoot/doctor/checks.hpp"
#include "surefoot/doctor/part_list.hpp"
#include "surefoot/model/point_mass.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace surefoot::doctor {
namespace {

// A body's radius of gyration against how far its joints and links reach.
constexpr double kMostGyration = 4.0, kLeastGyration = 0.04;
// Against its reach, or a share of the leg's length if that is more: shapes may reach farther.
constexpr double kFewGyrations = 1.4, kStubReach = 0.25;
constexpr double kLeastReach = 0.02;  // of a body whose joints lie at one place [m]
constexpr double kFarCom = 5.0;       // of its reach, and at least
constexpr double kFarAway = 0.5;      // [m]: an offset of 1 mm is 1 m in the wrong unit
constexpr double kOtherUnit = 20.0;   // times the most gyration: an error, for the robot falls

Finding of_link(const model::UrdfLink& link, Severity severity, Confidence confidence,
                std::string what, std::string remedy) {
  return {severity,  confidence,      "link \"" + link.name + "\"",
          link.line, std::move(what), std::move(remedy)};
}

bool has_negative_moment(const model::Inertia& inertia) {
  const Vec3 moments = principal_moments(inertia);
  return moments[0] < -model::kInertiaRounding * moments.cwiseAbs().maxCoeff();
}

/// No body has an inertia without a mass.
bool is_massless(const model::UrdfLink& link, bool is_root) {
  const bool is_left_out = is_root && model::is_placeholder(link.inertia);
  return !is_left_out && link.inertia.mass == 0.0 && !link.inertia.about_com.isZero(0.0);
}

void check_link(const model::UrdfLink& link, bool is_root, PartList& impossible,
                Findings& findings) {
  const Vec3 moments = principal_moments(link.inertia);
  if (link.inertia.mass < 0.0) {
    findings.push_back(of_link(link, Severity::error, Confidence::certain,
                               formatted("its mass is negative, %g kg", link.inertia.mass),
                               "correct <mass value>"));
  }
  if (is_massless(link, is_root)) {
    findings.push_back(of_link(link, Severity::error, Confidence::certain,
                               "its mass is 0, and its inertia is not",
                               "correct <mass value>: a number above 0 is valid"));
  }
  if (is_root && model::is_placeholder(link.inertia)) {
    findings.push_back(of_link(link, Severity::note, Confidence::certain,
                               "the root's inertia is a placeholder and is left out", ""));
  } else if (has_negative_moment(link.inertia)) {
    findings.push_back(of_link(
        link, Severity::error, Confidence::certain,
        formatted("its inertia has a negative principal moment, %.3g kg·m²", moments[0]),
        "correct the signs in <inertia>: ixx, iyy and izz are positive, and each of ixy, ixz, iyz "
        "is smaller"));
  } else if (!model::obeys_triangle_inequality(moments)) {
    impossible.add(link,
                   formatted("alone no body can have its moments of inertia, %.3g, %.3g, %.3g "
                             "kg·m²: the largest is above the sum of the others",
                             moments[0], moments[1], moments[2]));
  }
}

/// A link after a moving joint, with all that is fixed to it.
struct Body {
  const model::UrdfLink* link;
  model::Inertia inertia;
  bool is_told;  // a link of it has a mass or an inertia that none has
  double reach;  // from its origin to the farthest of its joints and links [m]
};

Body body_of(const Diagnosis& robot, const model::UrdfLink& first) {
  const std::map<std::string, model::Weld>& welds = robot.anatomy.welds;
  Body body{&first, {}, false, kLeastReach};
  for (const model::UrdfLink& link : robot.urdf.links) {
    const model::Weld& weld = welds.at(link.name);
    if (weld.body != first.name) continue;
    body.inertia = body.inertia + link.inertia.placed(weld.R, weld.p);
    body.is_told |= link.inertia.mass < 0.0 || has_negative_moment(link.inertia) ||
                    is_massless(link, link.name == robot.urdf.root);
  }
  const auto add = [&](const Vec3& point) { body.reach = std::max(body.reach, point.norm()); };
  for (const auto& [name, weld] : welds) {
    if (weld.body == first.name) add(weld.p);
  }
  for (const model::UrdfJoint& joint : robot.urdf.joints) {
    const model::Weld& weld = welds.at(joint.parent);
    if (joint.type != "fixed" && weld.body == first.name) add(weld.p + weld.R * joint.p);
  }
  return body;
}

/// Moments that the whole body can't have are refused by the program.
void check_moments(const Body& body, Findings& findings) {
  const Vec3 moments = principal_moments(body.inertia);
  if (moments[0] > 0.0 && model::obeys_triangle_inequality(moments)) return;
  findings.push_back(of_link(
      *body.link, Severity::error, Confidence::certain,
      formatted("with all that is fixed to it, it has moments of inertia that no body has: %.3g, "
                "%.3g, %.3g kg·m²; all must be above 0, and none above the sum of the others",
                moments[0], moments[1], moments[2]),
      "correct <inertia> of this link and of those fixed to it"));
}

/// What speaks of other units, or of a mass that is forgotten.
class UnitCheck {
 public:
  explicit UnitCheck(const Anatomy& anatomy) {
    if (!anatomy.legs) return;
    least_reach_ = kInfinity;
    for (const FoundLeg& leg : *anatomy.legs)
      least_reach_ = std::min(least_reach_, kStubReach * (leg.thigh + leg.shank));
  }

  void add(const Body& body) {
    const double gyration = std::sqrt(principal_moments(body.inertia)[2] / body.inertia.mass);
    const std::string within = formatted(" but its joints and links lie within %.3g m", body.reach);
    const std::string seen =
        formatted("its radius of gyration, √(I/m), is %.3g m,", gyration) + within;
    if (gyration >
        std::min(kMostGyration * body.reach, kFewGyrations * std::max(body.reach, least_reach_))) {
      PartList& list = gyration > kOtherUnit * kMostGyration * body.reach ? huge_ : large_;
      list.add(*body.link, seen + ": the inertia is too large for the mass");
    }
    if (gyration < kLeastGyration * body.reach)
      small_.add(*body.link, seen + ": the inertia is too small for the mass");
    if (body.inertia.com.norm() > std::max(kFarAway, kFarCom * body.reach)) {
      PartList& list = body.inertia.com.norm() > kOtherUnit * body.reach ? farther_ : far_;
      list.add(*body.link,
               formatted("its centre of mass is %.3g m from its joint,", body.inertia.com.norm()) +
                   within);
    }
  }
  /// Moments about places in another unit are in another unit, too: places come first.
  /// `is_filled_in`: do the moments come from somewhere?
  void tell(Findings& findings, bool is_filled_in) const {
    farther_.tell(Severity::error, Confidence::likely,
                  "is <inertial><origin> in mm? Expected are m", findings, true);
    if (has_cause(findings)) return;
    if (is_filled_in) tell_moments(findings);
    far_.tell(Severity::warning, Confidence::likely, "is <inertial><origin> in mm? Expected are m",
              findings);
  }

 private:
  void tell_moments(Findings& findings) const {
    for (const auto& [list, severity] :
         {std::pair{&huge_, Severity::error}, std::pair{&large_, Severity::warning}}) {
      list->tell(severity, Confidence::likely,
                 "is <inertia> in kg·mm² (divide by 1e6) or g·mm² (by 1e9), or the mass too small? "
                 "Expected are kg and kg·m²",
                 findings, severity == Severity::error);
    }
    small_.tell(Severity::warning, Confidence::likely,
                "is the mass in g (divide by 1000), or <inertia> a placeholder? Expected are kg "
                "and kg·m²",
                findings);
  }

  double least_reach_ = kInfinity;  // [m]
  PartList huge_, large_, small_, far_, farther_;
};

/// Links of any mass that have one inertia: nobody filled it in. Tells whether there are such.
bool check_placeholders(const model::Urdf& urdf, Findings& findings) {
  constexpr double kAlike = 1e-6, kOtherMass = 3.0;
  std::vector<const model::UrdfLink*> links;
  for (const model::UrdfLink& link : urdf.links)
    if (link.inertia.mass > 0.0 && !model::is_point(link.inertia) &&
        !model::is_placeholder(link.inertia))
      links.push_back(&link);
  for (const model::UrdfLink* first : links) {
    const Vec3 moments = principal_moments(first->inertia);
    std::vector<double> masses;
    for (const model::UrdfLink* link : links)
      if (principal_moments(link->inertia).isApprox(moments, kAlike))
        masses.push_back(link->inertia.mass);
    if (2 * masses.size() <= links.size()) continue;
    const auto [least, most] = std::ranges::minmax(masses);
    if (most < kOtherMass * least) return false;
    findings.push_back(of_link(
        *first, Severity::warning, Confidence::likely,
        formatted("%zu links, of %.3g to %.3g kg, have the same inertia, %.3g, %.3g, %.3g kg·m²",
                  masses.size(), least, most, moments[0], moments[1], moments[2]),
        "a placeholder? Take each link's <inertia> from CAD"));
    return true;
  }
  return false;
}

/// The torso of a robot is often fixed to a base without mass; a leg's link has its own.
void check_own_mass(const Diagnosis& robot, const Body& body, Findings& findings) {
  if (body.link->inertia.mass != 0.0 || body.link->name == robot.anatomy.base) return;
  findings.push_back(of_link(
      *body.link, Severity::warning, Confidence::likely,
      formatted("it moves, but its <inertial> is missing or 0: its body has only the %.3g kg of "
                "what is fixed to it",
                body.inertia.mass),
      "add <inertial> with its mass, unless that is part of the other links'"));
}

/// Of a link that moves; with what is fixed to it, its body may still have an inertia.
void check_point(const Body& body, PartList& points) {
  if (!model::is_point(body.link->inertia)) return;
  points.add(*body.link,
             formatted("it moves, but its inertia is 0: its %.3g kg count as a point at "
                       "its centre of mass",
                       body.link->inertia.mass));
}

}  // namespace

void check_inertias(Diagnosis& robot) {
  UnitCheck units(robot.anatomy);
  PartList massless, impossible, points;
  for (const model::UrdfLink& link : robot.urdf.links)
    check_link(link, link.name == robot.urdf.root, impossible, robot.findings);
  for (const model::UrdfLink& link : robot.urdf.links) {
    const bool is_empty_root = link.name == robot.urdf.root && link.name != robot.anatomy.base;
    const bool is_first_of_body = robot.anatomy.welds.at(link.name).body == link.name;
    if (!is_first_of_body || is_empty_root) continue;
    const Body body = body_of(robot, link);
    if (body.is_told) continue;
    if (body.inertia.mass <= 0.0) {
      massless.add(link, "it moves, but has no mass, with all that is fixed to it");
      continue;
    }
    check_moments(body, robot.findings);
    check_own_mass(robot, body, robot.findings);
    check_point(body, points);
    units.add(body);
  }
  massless.tell(Severity::error, Confidence::certain,
                "add <inertial> with its mass, or make its joint fixed", robot.findings);
  points.tell(Severity::warning, Confidence::certain, "take its <inertia> from CAD",
              robot.findings);
  impossible.tell(
      Severity::note, Confidence::certain,
      "take the inertia from CAD anew; what counts is the body with all that is fixed to it",
      robot.findings);
  const bool is_filled_in = !check_placeholders(robot.urdf, robot.findings);
  if (!has_cause(robot.findings)) units.tell(robot.findings, is_filled_in);
}

}  // namespace surefoot::doctor
