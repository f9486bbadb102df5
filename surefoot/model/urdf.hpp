#pragma once

#include "surefoot/math/types.hpp"

#include <string>
#include <vector>

namespace surefoot {

/// Mass, centre of mass and rotational inertia about it, in the axes of the body's frame.
struct Inertia {
  double mass = 0.0;              ///< [kg]
  Vec3 com = Vec3::Zero();        ///< [m]
  Mat3 about_com = Mat3::Zero();  ///< [kg·m²]

  /// The inertia of this body in a frame that it is placed in by x ↦ R x + p.
  [[nodiscard]] Inertia placed(const Mat3& R, const Vec3& p) const;
  /// Both bodies, welded together. Massless bodies are legal.
  [[nodiscard]] Inertia operator+(const Inertia& other) const;
};

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
  Vec3 axis = Vec3::UnitX();  ///< unit vector in the child's frame
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
/// do not form one tree, a mass is negative, an inertia has a negative eigenvalue or a number is
/// not finite.
[[nodiscard]] Urdf read_urdf(const std::string& path);

/// Is the inertia of a root link none of a body, but there for a tool that wants one? At most 1 g,
/// and massless or not positive definite. Controller and plant leave out the same.
[[nodiscard]] bool is_placeholder(const Inertia& inertia);

/// The note on a root link's inertia that was left out: controller and plant say it in the same
/// words, so that a run tells it once.
[[nodiscard]] std::string placeholder_note(const std::string& link, double mass);

}  // namespace surefoot
