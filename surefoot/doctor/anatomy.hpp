#pragma once

#include "surefoot/doctor/finding.hpp"
#include "surefoot/model/description.hpp"
#include "surefoot/model/leg_chain.hpp"
#include "surefoot/model/urdf.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace surefoot::doctor {

/// The moving joints behind one joint that leaves the base.
struct Limb {
  std::vector<model::UrdfJoint> joints;   ///< from the base outward
  std::vector<model::UrdfJoint> placing;  ///< of a leg: HAA, HFE, KFE; the others are held
  std::string no_leg;                     ///< why it is none; empty: it may be one
  bool is_chain = false;                  ///< hinges, one behind the other
  bool is_arm = false;                    ///< a chain that is no leg
};

/// What a foot's radius was guessed from where its link collides with nothing.
inline constexpr const char* kNoShape = "no shape";

/// The link that a leg stands on, and its sphere.
struct Foot {
  std::string link;
  int line = 0;                ///< of the link in the URDF
  double radius = 0.0;         ///< of the URDF's sphere, or a guess [m]
  Vec3 center = Vec3::Zero();  ///< of the sphere in the foot link's frame [m]
  /// What the radius was guessed from: "a mesh", kNoShape …; empty: the URDF has the sphere.
  std::string guessed_from;
};

/// The same radius, at the same place in its link's frame?
[[nodiscard]] inline bool is_same_sphere(const Foot& a, const Foot& b) {
  return std::abs(a.radius - b.radius) <= 1e-6 && (a.center - b.center).norm() <= 1e-6;
}

/// A leg and its measures.
struct FoundLeg {
  std::array<model::UrdfJoint, kJointsPerLeg> joints;  ///< HAA, HFE, KFE
  std::vector<model::UrdfJoint> all_joints;            ///< further ones, too; from the base outward
  Foot foot;
  model::LegChain chain;    ///< with the hip on the HFE axis
  Vec3 hip = Vec3::Zero();  ///< origin of the HFE joint in B at q = 0 [m]
  Vec3 tip = Vec3::Zero();  ///< centre of the foot sphere in B at q = 0 [m]
  double thigh = 0.0;       ///< HFE axis to KFE axis [m]
  double shank = 0.0;       ///< KFE axis to sphere centre [m]

  /// Those of all joints that do not place the foot, and are held.
  [[nodiscard]] std::vector<model::UrdfJoint> further() const {
    std::vector<model::UrdfJoint> held;
    for (const model::UrdfJoint& joint : all_joints)
      if (std::ranges::find(joints, joint.name, &model::UrdfJoint::name) == joints.end())
        held.push_back(joint);
    return held;
  }
};

/// One of two legs with flat feet.
struct FlatLeg {
  std::vector<model::UrdfJoint> joints;  ///< from the base to the foot
  std::string foot;                      ///< the last link
  int line = 0;                          ///< of it in the URDF
  std::vector<double> posture;           ///< a guess: knees bent, sole level [rad]
};

/// What a flat foot stands on.
struct Sole {
  Vec2 size;              ///< along x and y of the foot's frame [m]
  Vec3 center;            ///< in it [m]
  bool is_guess = false;  ///< as the foot has no shape
};

/// A robot on two legs: the left and the right one.
struct FlatLegs {
  std::array<FlatLeg, 2> legs;
  Sole sole{};
  double length = 0.0;  ///< of the right one [m]
};

/// The parts of a robot as its URDF connects them.
struct Anatomy {
  std::string root;             ///< of the URDF
  std::string base;             ///< the link that the limbs leave, with all fixed to it
  std::string torso;            ///< the heaviest link of it
  std::vector<Limb> others;     ///< limbs that are no legs
  std::vector<FoundLeg> loose;  ///< legs that could not be told apart; else empty
  std::optional<PerLeg<FoundLeg>> legs;
  std::optional<FlatLegs> flat_legs;         ///< else none
  std::map<std::string, model::Weld> welds;  ///< of all links
};

/// Four, six, or two with flat feet.
[[nodiscard]] inline bool has_legs(const Anatomy& anatomy) {
  return anatomy.legs || anatomy.flat_legs;
}

/// Finds base, limbs, legs and feet. What can't be found is an error in `findings`; arms are a
/// note, unless they are known. Throws FileError if the file can't be read.
[[nodiscard]] Anatomy find_anatomy(const model::Urdf& urdf, Findings& findings,
                                   const std::vector<model::ArmDescription>& known = {});

}  // namespace surefoot::doctor
