#pragma once

#include "surefoot/doctor/diagnosis.hpp"

#include <optional>
#include <string>
#include <vector>

namespace surefoot::doctor {

/// A moving joint at its place.
struct JointPlace {
  std::string name;
  Vec3 p, axis;  ///< in the frame of the root [m]
};

/// The joints of a leg or another limb, from the base outward.
struct DrawnLimb {
  std::optional<Leg> leg;  ///< none: not one of the legs
  std::string name;        ///< of the leg; empty: none
  std::vector<JointPlace> joints;
  std::string foot;  ///< its link; empty: no foot was found
  Vec3 tip;          ///< centre of the foot sphere, else the last joint [m]
  double radius = 0.0;
};

/// A robot as lines between its joints, in the nominal posture if that is known, else all at 0.
struct Skeleton {
  std::vector<DrawnLimb> limbs;
  Vec3 com = Vec3::Zero();
  double mass = 0.0;
};

[[nodiscard]] Skeleton skeleton_of(const Diagnosis& robot);

}  // namespace surefoot::doctor
