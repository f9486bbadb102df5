#pragma once

#include "surefoot/model/inertia.hpp"

#include <map>
#include <string>
#include <vector>

namespace surefoot {

struct UrdfLink {
  std::string name;
  Inertia inertia;
  int line = 0;  ///< where its inertia stands in the file, or the link if it has none
};

struct UrdfJoint {
  std::string name;
  std::string type;  ///< fixed, revolute, continuous, prismatic …
  std::string parent;
  std::string child;
  Mat3 R = Mat3::Identity();  ///< orientation and
  Vec3 p = Vec3::Zero();  ///< position of the child's frame in the parent's, at joint position 0
  Vec3 axis = Vec3::UnitX();  ///< unit vector in the child's frame; of a fixed joint: as it is here
  std::string mimics;         ///< the joint that it follows; empty: none
  int line = 0;               ///< where it stands in the file
};

/// The kinematic and inertial content of a URDF file, as written there.
struct Urdf {
  std::string path;
  std::string root;             ///< the link that no joint moves
  std::vector<UrdfLink> links;  ///< in the order of the file
  std::vector<UrdfJoint> joints;
  std::vector<std::string> notes;  ///< what was left out, a line each

  /// The link of that name, or nullptr.
  [[nodiscard]] const UrdfLink* find_link(const std::string& name) const;
};

/// Reads a URDF. An inertia of the root link that is a placeholder is left out, with a note. Throws
/// FileError, with file and line, if the file is missing, is not XML or not a robot, if its links
/// do not form one tree, a joint's name stands twice, a mass is negative, an inertia has a negative
/// eigenvalue beyond rounding or a number is not finite. What is not kept here can't be wrong.
[[nodiscard]] Urdf read_urdf(const std::string& path);

/// Where a link is fixed: the link that its body moves with, and its frame in that one's.
struct Weld {
  std::string body;  ///< the link behind a joint that moves, or the root
  Mat3 R = Mat3::Identity();
  Vec3 p = Vec3::Zero();
};

/// Of all links of the tree, by their names.
[[nodiscard]] std::map<std::string, Weld> welds(const Urdf& urdf);

}  // namespace surefoot
