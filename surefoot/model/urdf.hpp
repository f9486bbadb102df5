#pragma once

#include "surefoot/math/numbers.hpp"
#include "surefoot/model/description.hpp"
#include "surefoot/model/inertia.hpp"

#include <map>
#include <string>
#include <vector>

namespace surefoot::model {

struct UrdfLink {
  std::string name;
  Inertia inertia;
  int line = 0;  ///< of its inertia in the file, or of the link without one
};

struct UrdfJoint {
  std::string name;
  std::string type;  ///< fixed, revolute, continuous, prismatic …
  std::string parent;
  std::string child;
  Mat3 R = Mat3::Identity();  ///< orientation of the child's frame in the parent's at position 0
  Vec3 p = Vec3::Zero();      ///< position of it [m]
  Vec3 axis =
      Vec3::UnitX();        ///< unit vector in the child's frame; a fixed joint keeps this default
  Vec3 rpy = Vec3::Zero();  ///< of R, as written [rad]
  std::string mimics;       ///< the joint that it follows; empty: none
  double multiplier = 1.0, offset = 0.0;  ///< of the position that it follows
  /// Its type in the file, if it is fixed only because it follows another joint or slides.
  std::string held_type;
  /// Of its position [rad] or [m], effort and velocity; NaN: no finite number is given.
  double lower = kNaN, upper = kNaN, effort = kNaN, velocity = kNaN;
  int line = 0;  ///< in the file
};

/// Kinematics and inertias of a URDF file, as written.
struct Urdf {
  std::string path;             ///< of the file, also if it is an MJCF
  std::string text;             ///< of the URDF made from an MJCF; else empty
  std::string root;             ///< the link that no joint moves
  std::vector<UrdfLink> links;  ///< in the order of the file
  std::vector<UrdfJoint> joints;
  std::vector<std::string> notes;  ///< what was ignored, a line each

  /// The link of that name, or nullptr.
  [[nodiscard]] const UrdfLink* find_link(const std::string& name) const;
  /// How messages call the file: URDF or MJCF.
  [[nodiscard]] const char* format() const { return text.empty() ? "URDF" : "MJCF"; }
};

/// What reading a URDF does with masses and inertias that no body can have.
enum class ImpossibleInertia { refused, kept };

/// Reads a URDF. Ignores a placeholder inertia of the root link, with a note. A joint that follows
/// another or slides has no drive of a limb: it becomes fixed where it is with all joints at 0, as
/// its limits allow, with a note. Throws FileError, with file and line, if the file is missing, not
/// XML or no robot, if the links do not form one tree, a joint's name or an element that stands
/// once repeats, a joint follows none or itself, a mass is negative, an inertia has a negative
/// eigenvalue beyond rounding or a number is not finite. Ignores faults in parts that are not kept.
/// With `kept`, masses and inertias stay as written, whatever they are. `text`: of the URDF, if it
/// was made from the MJCF at `path`; its attributes `line` are lines of that.
[[nodiscard]] Urdf read_urdf(const std::string& path,
                             ImpossibleInertia impossible = ImpossibleInertia::refused,
                             const std::string& text = "");
[[nodiscard]] Urdf read_urdf(const RobotDescription& robot);

/// A robot's URDF as text: its file's, or the one made from its MJCF. Throws FileError.
[[nodiscard]] std::string urdf_text(const RobotDescription& robot);

/// The body that a link is fixed to, and its frame in the body's.
struct Weld {
  std::string body;  ///< the link right after a moving joint, or the root
  Mat3 R = Mat3::Identity();
  Vec3 p = Vec3::Zero();
};

/// The welds of all links, by name.
[[nodiscard]] std::map<std::string, Weld> welds(const Urdf& urdf);

}  // namespace surefoot::model
