#include "surefoot/base/formatted.hpp"
#include "surefoot/doctor/checks.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::doctor {
namespace {

constexpr double kLeastMass = 0.5, kMostMass = 500.0;  // of a robot that walks [kg]
constexpr double kShortLeg = 0.05, kLongLeg = 2.0;     // [m]
constexpr double kStub = 0.5;                          // of the usual shank: its end is missing

double usual_shank(const PerLeg<FoundLeg>& legs) {
  std::array<double, kNumLegs> shanks{};
  std::ranges::transform(legs, shanks.begin(), &FoundLeg::shank);
  std::ranges::sort(shanks);
  return shanks[2];
}

void check_mass(Diagnosis& robot) {
  double mass = 0.0;
  for (const model::UrdfLink& link : robot.urdf.links) mass += link.inertia.mass;
  if (mass >= kLeastMass && mass <= kMostMass) return;
  robot.findings.push_back(
      {Severity::error, Confidence::likely, "robot", 0,
       formatted("all links together have %.4g kg; a robot that walks has 0.5 to 500 kg", mass),
       mass > kMostMass ? "are the masses in g? Divide masses and inertias by 1000"
                        : "are the masses in t, or missing? Expected are kg"});
}

void check_length(Diagnosis& robot) {
  double leg = 0.0;
  for (const FoundLeg& found : *robot.anatomy.legs) leg = std::max(leg, found.thigh + found.shank);
  if (leg >= kShortLeg && leg <= kLongLeg) return;
  robot.findings.push_back(
      {Severity::error, Confidence::likely, "legs", 0,
       formatted("thigh and shank have %.4g m together; legs of robots have 0.05 to 2 m", leg),
       leg > kLongLeg ? "are the origins in mm? Divide them by 1000, and inertias by 1e6"
                      : "are the origins of HFE, KFE and foot missing? Expected are m"});
}

void tell_stub(const Foot& foot, Leg leg, Findings& findings) {
  findings.push_back({Severity::error, Confidence::likely, "link \"" + foot.link + "\"", foot.line,
                      "this is the farthest link behind the knee of " +
                          std::string(kLegNames[index(leg)]) +
                          ", far nearer than the feet of the other legs: its foot is missing",
                      "add a link with a collision sphere at the end of the shank, by a fixed "
                      "joint"});
}

void tell_other_sphere(const Foot& foot, Leg leg, Findings& findings) {
  findings.push_back({Severity::error, Confidence::certain, "link \"" + foot.link + "\"", foot.line,
                      "the sphere of " + std::string(kLegNames[index(leg)]) +
                          " differs from that of LF in radius or in its place in the foot's frame; "
                          "a robot file has one for all",
                      "give all feet the same sphere in their frames"});
}

bool is_same_sphere(const Foot& a, const Foot& b) {
  return std::abs(a.radius - b.radius) <= 1e-6 && (a.center - b.center).norm() <= 1e-6;
}

/// Feet without a sphere, all in one finding.
void tell_guesses(const PerLeg<FoundLeg>& legs, Findings& findings) {
  std::string links;
  const Foot* first = nullptr;
  for (const FoundLeg& leg : legs) {
    if (leg.foot.guessed_from.empty()) continue;
    if (first == nullptr) first = &leg.foot;
    links += " " + leg.foot.link;
  }
  if (first == nullptr) return;
  const bool has_none = first->guessed_from == kNoShape;
  findings.push_back({has_none ? Severity::error : Severity::warning, Confidence::certain,
                      "link \"" + first->link + "\"", first->line,
                      "these feet have no collision sphere but " + first->guessed_from +
                          formatted(", so foot.radius is a guess, %.3g m:", first->radius) + links,
                      "measure the foot and correct foot.radius and foot.center; the sphere must "
                      "enclose what the foot stands on"});
}

}  // namespace

void check_size(Diagnosis& robot) {
  check_mass(robot);
  if (robot.anatomy.legs) check_length(robot);
}

void check_feet(Diagnosis& robot) {
  if (!robot.anatomy.legs) return;
  const PerLeg<FoundLeg>& legs = *robot.anatomy.legs;
  const double usual = usual_shank(legs);
  for (const Leg leg : kLegs) {
    const Foot& foot = legs[index(leg)].foot;
    if (legs[index(leg)].shank < kStub * usual) {
      tell_stub(foot, leg, robot.findings);
    } else if (foot.guessed_from.empty() && !is_same_sphere(foot, legs[0].foot)) {
      tell_other_sphere(foot, leg, robot.findings);
    }
  }
  tell_guesses(legs, robot.findings);
}

}  // namespace surefoot::doctor
