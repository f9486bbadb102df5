#include "surefoot/base/formatted.hpp"
#include "surefoot/doctor/checks.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace surefoot::doctor {
namespace {

constexpr double kLeastMass = 0.5, kMostMass = 500.0;   // of a robot that walks [kg]
constexpr double kNoMass = 0.05;                        // less is another unit [kg]
constexpr double kShortLeg = 0.05, kLongLeg = 2.0;      // [m]
constexpr double kNoLeg = 0.02;                         // shorter is another unit, or none [m]
constexpr double kLeastUsual = 0.15, kMostUsual = 1.2;  // of legs, to tell their unit [m]
constexpr double kMostRadius = 0.25;                    // of a foot, as a share of its leg
constexpr double kStub = 0.5;                           // of the usual shank, and of the thigh
constexpr double kMostInBase = 0.9, kMostInLimb = 0.5;  // of the robot's mass, in one link

bool is_mass(double mass) { return mass >= kLeastMass && mass <= kMostMass; }

/// The link that has nearly all mass, so that it must be in other units; nullptr: none.
const model::UrdfLink* giant(const Diagnosis& robot, double mass) {
  const model::UrdfLink& heaviest = *std::ranges::max_element(
      robot.urdf.links, {}, [](const model::UrdfLink& link) { return link.inertia.mass; });
  const bool is_of_base = robot.anatomy.welds.at(heaviest.name).body == robot.anatomy.base;
  const double most = (is_of_base ? kMostInBase : kMostInLimb) * mass;
  const bool is_wrong = !is_of_base || !is_mass(mass);
  return is_wrong && heaviest.inertia.mass > most ? &heaviest : nullptr;
}

void check_mass(Diagnosis& robot) {
  double mass = 0.0;
  for (const model::UrdfLink& link : robot.urdf.links) mass += link.inertia.mass;
  if (const model::UrdfLink* link = giant(robot, mass)) {
    robot.findings.push_back(
        {Severity::error, Confidence::likely, "link \"" + link->name + "\"", link->line,
         formatted("it has %.4g of the %.4g kg of all links", link->inertia.mass, mass),
         "is its mass in g? Divide it by 1000, and look at its inertia, in kg·m²", true});
  } else if (!is_mass(mass)) {
    const bool is_small = mass >= kNoMass && mass < kLeastMass;
    robot.findings.push_back(
        {is_small ? Severity::warning : Severity::error,
         is_small ? Confidence::guess : Confidence::likely, "robot", 0,
         formatted("all links together have %.4g kg; robots that walk have 0.5 to 500 kg", mass),
         mass > kMostMass ? "are the masses in g? Divide masses and inertias by 1000"
                          : "are the masses in t, or missing? Expected are kg",
         !is_small});
  }
}

std::string names_of(const std::vector<Leg>& legs, std::size_t num_legs) {
  std::string names;
  for (const Leg leg : legs) names += " " + std::string(leg_name(leg, static_cast<int>(num_legs)));
  return names;
}

/// The units in which a leg would have a usual length, with what to do.
std::string unit_of(double length) {
  struct Unit {
    const char* name;
    double metres;
  };
  std::string units;
  for (const auto& [name, metres] : {Unit{"mm", 0.001}, {"cm", 0.01}, {"inches", 0.0254}}) {
    if (length * metres < kLeastUsual || length * metres > kMostUsual) continue;
    units += (units.empty() ? "" : ", or in ") + std::string(name) +
             formatted("? Divide them by %.4g, and inertias by %.4g", 1.0 / metres,
                       1.0 / (metres * metres));
  }
  return "are the origins in " + (units.empty() ? "mm? Expected are m" : units);
}

void check_length(Diagnosis& robot) {
  std::vector<Leg> wrong;
  double length = 0.0;
  for (const Leg leg : robot.anatomy.legs->legs()) {
    const FoundLeg& found = (*robot.anatomy.legs)[index(leg)];
    if (found.thigh + found.shank >= kShortLeg && found.thigh + found.shank <= kLongLeg) continue;
    wrong.push_back(leg);
    length = found.thigh + found.shank;
  }
  if (wrong.empty()) return;
  const model::UrdfJoint& knee = (*robot.anatomy.legs)[index(wrong.front())].joints[2];
  const bool is_small = length >= kNoLeg && length < kShortLeg;
  robot.findings.push_back(
      {is_small ? Severity::warning : Severity::error, Confidence::likely,
       "joint \"" + knee.name + "\"", knee.line,
       formatted("thigh and shank have %.4g m together in", length) +
           names_of(wrong, robot.anatomy.legs->size()) + "; legs of robots have 0.05 to 2 m",
       length > kLongLeg ? unit_of(length)
                         : "are the origins of HFE, KFE and foot missing? Expected are m",
       !is_small});
}

double usual_shank(const PerLeg<FoundLeg>& legs) {
  std::vector<double> shanks;
  for (const FoundLeg& leg : legs) shanks.push_back(leg.shank);
  std::ranges::sort(shanks);
  return shanks[shanks.size() / 2];
}

/// Legs that end far nearer to the knee than the others, or than a thigh lets expect.
std::vector<Leg> stubs(const PerLeg<FoundLeg>& legs) {
  const double usual = usual_shank(legs);
  std::vector<Leg> result;
  for (const Leg leg : legs.legs()) {
    const FoundLeg& found = legs[index(leg)];
    if (found.shank < kStub * std::max(usual, found.thigh)) result.push_back(leg);
  }
  return result;
}

void tell_stubs(const PerLeg<FoundLeg>& legs, const std::vector<Leg>& stubs, Findings& findings) {
  const Foot& foot = legs[index(stubs.front())].foot;
  findings.push_back({Severity::error, Confidence::likely, "link \"" + foot.link + "\"", foot.line,
                      "the shank seems to end here, near the knee: the foot is missing of" +
                          names_of(stubs, legs.size()),
                      "add a link with a collision sphere at the end of the shank, by a fixed "
                      "joint whose <origin> says how far it is",
                      true});
}

void tell_other_sphere(const Foot& foot, std::string_view leg, Findings& findings) {
  const std::string name(leg);
  findings.push_back(
      {Severity::note, Confidence::certain, "link \"" + foot.link + "\"", foot.line,
       "the sphere of " + name +
           " differs from that of LF in radius or in its place in the foot's frame",
       "fine if the robot is built so: legs." + name + ".foot_radius and foot_center tell it"});
}

/// Spheres that are no feet, all in one finding.
void check_radii(const PerLeg<FoundLeg>& legs, Findings& findings) {
  std::string links;
  const FoundLeg* first = nullptr;
  for (const FoundLeg& leg : legs) {
    const bool is_usual = leg.foot.radius <= kMostRadius * (leg.thigh + leg.shank);
    if (is_usual || !leg.foot.guessed_from.empty()) continue;
    if (first == nullptr) first = &leg;
    links += " " + leg.foot.link;
  }
  if (first == nullptr) return;
  const double length = first->thigh + first->shank;
  findings.push_back(
      {Severity::error, Confidence::likely, "link \"" + first->foot.link + "\"", first->foot.line,
       formatted(
           "its foot sphere has a radius of %.3g m, and the leg a length of %.3g m; feet have "
           "at most a quarter of that:",
           first->foot.radius, length) +
           links,
       first->foot.radius > length
           ? "is <sphere radius> in mm? Expected are m"
           : "correct <sphere radius>; it must enclose only what the foot stands on",
       true});
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
  findings.push_back(
      {has_none ? Severity::error : Severity::warning, Confidence::certain,
       "link \"" + first->link + "\"", first->line,
       (has_none ? std::string("these feet collide with nothing")
                 : "these feet have no collision sphere but " + first->guessed_from) +
           formatted(", so foot.radius is a guess, %.3g m:", first->radius) + links,
       "measure the foot and correct foot.radius and foot.center; the sphere must "
       "enclose what the foot stands on"});
}

}  // namespace

void check_size(Diagnosis& robot) {
  check_mass(robot);
  if (robot.anatomy.legs) check_length(robot);
}

void check_flat_feet(Diagnosis& robot) {
  if (!robot.anatomy.flat_legs) return;
  const FlatLeg& left = robot.anatomy.flat_legs->legs[0];
  const std::string subject = "link \"" + left.foot + "\"";
  robot.findings.push_back({Severity::note, Confidence::likely, subject, left.line,
                            "the robot has two legs that end in flat feet, here and at \"" +
                                robot.anatomy.flat_legs->legs[1].foot +
                                "\": it stands, shifts its weight and squats (flat_feet), but does "
                                "not walk. Posture and sole are guesses from its shape",
                            "check legs.L.posture, in which the sole must be level, and foot.size "
                            "in the robot file"});
  if (!robot.anatomy.flat_legs->sole.is_guess) return;
  robot.findings.push_back({Severity::error, Confidence::certain, subject, left.line,
                            "the foot has no collision shape that tells its sole, so foot.size is "
                            "a guess by the leg's length",
                            "measure the sole and correct foot.size and foot.center"});
}

void check_feet(Diagnosis& robot) {
  if (!robot.anatomy.legs) return;
  const PerLeg<FoundLeg>& legs = *robot.anatomy.legs;
  const std::vector<Leg> without_foot = stubs(legs);
  if (!without_foot.empty()) return tell_stubs(legs, without_foot, robot.findings);
  for (const Leg leg : legs.legs()) {
    const Foot& foot = legs[index(leg)].foot;
    if (foot.guessed_from.empty() && !is_same_sphere(foot, legs[0].foot))
      tell_other_sphere(foot, leg_name(leg, static_cast<int>(legs.size())), robot.findings);
  }
  check_radii(legs, robot.findings);
  tell_guesses(legs, robot.findings);
}

}  // namespace surefoot::doctor
