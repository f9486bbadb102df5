#include "surefoot/model/physics_urdf.hpp"

#include "surefoot/base/formatted.hpp"
#include "surefoot/math/rotation.hpp"
#include "surefoot/model/urdf_reader.hpp"

#include <tinyxml2.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace surefoot::model {
namespace {

using tinyxml2::XMLElement;

/// A collision shape and its size attributes, all above 0.
struct Shape {
  const char* tag;
  std::array<const char*, 2> numbers;
};
constexpr std::array<Shape, 3> kRound{{{"cylinder", {"radius", "length"}},
                                       {"capsule", {"radius", "length"}},
                                       {"sphere", {"radius"}}}};

void copy_attributes(const XMLElement& from, XMLElement& to,
                     std::initializer_list<const char*> names) {
  for (const char* name : names) {
    if (const char* value = from.Attribute(name)) to.SetAttribute(name, value);
  }
}

void copy_child(const XMLElement& from, XMLElement& to, const char* tag,
                std::initializer_list<const char*> attributes) {
  if (const XMLElement* child = from.FirstChildElement(tag))
    copy_attributes(*child, *to.InsertNewChildElement(tag), attributes);
}

std::string exact(double value) { return formatted("%.17g", value); }

/// Does MuJoCo accept it? Either zero, or a physical body's beyond rounding.
bool is_sound(const Inertia& inertia) {
  if (inertia.about_com.isZero(0.0)) return true;
  const Vec3 moment = principal_moments(inertia);
  return moment[0] > kInertiaRounding * moment[2] &&
         moment[0] + moment[1] > (1.0 + kInertiaRounding) * moment[2];
}

void write_inertia(Inertia inertia, XMLElement& link) {
  const double largest = principal_moments(inertia)[2];
  if (!is_sound(inertia)) inertia.about_com += 2.0 * kInertiaRounding * largest * Mat3::Identity();
  XMLElement& inertial = *link.InsertNewChildElement("inertial");
  const Vec3& com = inertia.com;
  inertial.InsertNewChildElement("origin")->SetAttribute(
      "xyz", (exact(com.x()) + " " + exact(com.y()) + " " + exact(com.z())).c_str());
  inertial.InsertNewChildElement("mass")->SetAttribute("value", exact(inertia.mass).c_str());
  XMLElement& tensor = *inertial.InsertNewChildElement("inertia");
  constexpr const char* kAxes = "xyz";
  for (int i = 0; i < 3; ++i) {
    for (int j = i; j < 3; ++j) {
      const std::string name{'i', kAxes[i], kAxes[j]};
      tensor.SetAttribute(name.c_str(), exact(inertia.about_com(i, j)).c_str());
    }
  }
}

/// Bodies with a link whose own inertia is impossible, and the inertia of each whole body.
class UnsoundBodies {
 public:
  UnsoundBodies(const Urdf& urdf, const std::map<std::string, Weld>& welds) {
    for (const UrdfLink& link : urdf.links) {
      if (is_sound(link.inertia)) continue;
      names_ += " " + link.name;
      whole_[welds.at(link.name).body];
    }
    for (const UrdfLink& link : urdf.links) {
      const Weld& weld = welds.at(link.name);
      const auto body = whole_.find(weld.body);
      if (body != whole_.end()) body->second = body->second + link.inertia.placed(weld.R, weld.p);
    }
  }
  /// nullptr: all links of the body are sound.
  [[nodiscard]] const Inertia* find(const std::string& body) const {
    const auto found = whole_.find(body);
    return found == whole_.end() ? nullptr : &found->second;
  }
  /// The unsound links, a space before each.
  [[nodiscard]] const std::string& names() const { return names_; }

 private:
  std::map<std::string, Inertia> whole_;
  std::string names_;
};

class Writer {
 public:
  Writer(const Urdf& urdf, const MeshFolders& folders)
      : urdf_(urdf),
        folders_(folders),
        reader_(urdf.path, urdf.text),
        welds_(welds(urdf)),
        unsound_(urdf, welds_),
        to_(*document_.InsertEndChild(document_.NewElement("robot"))->ToElement()) {
    XMLElement& settings = *to_.InsertNewChildElement("mujoco")->InsertNewChildElement("compiler");
    for (const char* off : {"fusestatic", "strippath", "inertiafromgeom"})
      settings.SetAttribute(off, "false");
  }

  PhysicsUrdf write() {
    tinyxml2::XMLDocument original;
    const XMLElement& robot = reader_.robot(original);
    copy_attributes(robot, to_, {"name"});
    for (const XMLElement* element = robot.FirstChildElement(); element != nullptr;
         element = element->NextSiblingElement()) {
      const std::string_view tag = element->Name();
      if (tag == "link") write_link(*element);
      if (tag == "joint") write_joint(*element);
    }
    tinyxml2::XMLPrinter printer;
    document_.Print(&printer);
    result_.xml = printer.CStr();
    note_what_is_ignored();
    return std::move(result_);
  }

 private:
  void write_link(const XMLElement& from) {
    const std::string name = reader_.name(from);
    XMLElement& to = *to_.InsertNewChildElement("link");
    to.SetAttribute("name", name.c_str());
    write_inertial(from, name, to);
    for (const XMLElement* shape = from.FirstChildElement("collision"); shape != nullptr;
         shape = shape->NextSiblingElement("collision")) {
      write_collision(*shape, name, to);
    }
  }

  void write_inertial(const XMLElement& from, const std::string& name, XMLElement& to) {
    const std::string& body = welds_.at(name).body;
    if (const Inertia* whole = unsound_.find(body)) {
      if (name == body) write_inertia(*whole, to);
      return;
    }
    const Inertia& inertia = urdf_.find_link(name)->inertia;
    const XMLElement* inertial = from.FirstChildElement("inertial");
    const bool is_left_out = inertia.mass == 0.0 && inertia.about_com.isZero(0.0);
    if (inertial == nullptr || is_left_out) return;
    XMLElement& copy = *to.InsertNewChildElement("inertial");
    copy_child(*inertial, copy, "origin", {"xyz", "rpy"});
    copy_child(*inertial, copy, "mass", {"value"});
    copy_child(*inertial, copy, "inertia", {"ixx", "ixy", "ixz", "iyy", "iyz", "izz"});
  }

  void write_collision(const XMLElement& from, const std::string& link, XMLElement& to) {
    const XMLElement* geometry = from.FirstChildElement("geometry");
    const XMLElement* shape = geometry == nullptr ? nullptr : geometry->FirstChildElement();
    if (shape == nullptr) return;
    const bool is_mesh = std::string_view(shape->Name()) == "mesh";
    const std::string file = is_mesh ? mesh_file(*shape, link) : "";
    if (is_mesh && file.empty()) return;
    if (!is_mesh) check_size(*shape, link);
    check_origin(from);
    XMLElement& copy = *to.InsertNewChildElement("collision");
    copy_child(from, copy, "origin", {"xyz", "rpy"});
    XMLElement& copied =
        *copy.InsertNewChildElement("geometry")->InsertNewChildElement(shape->Name());
    copy_attributes(*shape, copied, {"radius", "length", "size", "scale"});
    if (is_mesh) copied.SetAttribute("filename", file.c_str());
  }

  void check_origin(const XMLElement& element) const {
    Mat3 R;
    Vec3 p;
    reader_.read_origin(element, R, p);
  }

  void check_size(const XMLElement& shape, const std::string& link) const {
    const std::string_view tag = shape.Name();
    if (tag == "box") return check_positive(shape, link, reader_.vector(shape, "size").minCoeff());
    const auto* round = std::ranges::find(kRound, tag, &Shape::tag);
    if (round == kRound.end()) {
      reader_.fail(reader_.line(shape), "link \"" + link + "\": <" + shape.Name() +
                                            "> is no collision shape; valid: box, capsule, "
                                            "cylinder, mesh, sphere");
    }
    for (const char* number : round->numbers) {
      if (number != nullptr) check_positive(shape, link, reader_.number(shape, number));
    }
  }

  void check_positive(const XMLElement& shape, const std::string& link, double size) const {
    if (size > 0.0) return;
    reader_.fail(reader_.line(shape), "link \"" + link + "\": the <" + shape.Name() +
                                          "> that it collides with has a size of " +
                                          formatted("%g", size) + " m; it must be above 0");
  }

  /// Empty for a mesh format that MuJoCo can't read, which is ignored.
  std::string mesh_file(const XMLElement& shape, const std::string& link) {
    const char* uri = shape.Attribute("filename");
    if (uri == nullptr) reader_.fail(reader_.line(shape), "<mesh> has no filename");
    if (!can_be_read(uri)) {
      unread_ += " " + link;
      return "";
    }
    const std::filesystem::path file = find_mesh(uri, folders_);
    if (file.empty())
      reader_.fail(reader_.line(shape), "link \"" + link + "\": " + missing_text(uri, folders_));
    if (shape.Attribute("scale") != nullptr) (void)reader_.vector(shape, "scale");
    return file.string();
  }

  /// MuJoCo reads these three formats.
  static bool can_be_read(const std::string& uri) {
    std::string extension = std::filesystem::path(uri).extension().string();
    std::ranges::transform(extension, extension.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension == ".stl" || extension == ".obj" || extension == ".msh";
  }

  void write_joint(const XMLElement& from) {
    const std::string name = reader_.name(from);
    const std::string_view type = from.Attribute("type");
    XMLElement& to = *to_.InsertNewChildElement("joint");
    copy_attributes(from, to, {"name", "type"});
    const UrdfJoint& joint = *std::ranges::find(urdf_.joints, name, &UrdfJoint::name);
    const bool is_held = !joint.held_type.empty();
    is_held ? write_place(joint, to) : copy_child(from, to, "origin", {"xyz", "rpy"});
    copy_child(from, to, "parent", {"link"});
    copy_child(from, to, "child", {"link"});
    if (type == "fixed" || is_held) return;
    if (type != "floating") copy_child(from, to, "axis", {"xyz"});
    const XMLElement* limit = from.FirstChildElement("limit");
    if (type == "revolute" && limit != nullptr) write_stops(*limit, name, to);
    count_dynamics(from);
  }

  /// A joint that is held is fixed where it is.
  static void write_place(const UrdfJoint& joint, XMLElement& to) {
    to.SetAttribute("type", "fixed");
    const auto text = [](const Vec3& v) {
      return exact(v.x()) + " " + exact(v.y()) + " " + exact(v.z());
    };
    XMLElement& origin = *to.InsertNewChildElement("origin");
    origin.SetAttribute("xyz", text(joint.p).c_str());
    origin.SetAttribute("rpy", text(roll_pitch_yaw(joint.R)).c_str());
  }

  /// Position limits only: drive limits come from the robot's file.
  void write_stops(const XMLElement& limit, const std::string& joint, XMLElement& to) const {
    const auto stop = [&](const char* name) {
      return limit.Attribute(name) == nullptr ? 0.0 : reader_.number(limit, name);
    };
    if (stop("lower") > stop("upper")) {
      reader_.fail(reader_.line(limit),
                   "joint \"" + joint + "\": its lower limit, " + formatted("%g", stop("lower")) +
                       ", is above the upper, " + formatted("%g", stop("upper")));
    }
    copy_attributes(limit, *to.InsertNewChildElement("limit"), {"lower", "upper"});
  }

  void count_dynamics(const XMLElement& joint) {
    const XMLElement* dynamics = joint.FirstChildElement("dynamics");
    if (dynamics == nullptr) return;
    const auto is_set = [&](const char* name) { return dynamics->DoubleAttribute(name) != 0.0; };
    if (is_set("damping") || is_set("friction")) ++num_dynamics_;
  }

  void note_what_is_ignored() {
    std::vector<std::string>& notes = result_.notes;
    if (!unsound_.names().empty()) {
      notes.push_back(std::string(kUnsoundInertia) + unsound_.names() +
                      "; the physics has it as a part of what each is fixed to");
    }
    if (!unread_.empty()) {
      notes.push_back(
          "collision meshes that are neither .stl nor .obj were left out, so these "
          "links collide with less or nothing:" +
          unread_);
    }
    if (num_dynamics_ > 0) {
      notes.push_back("<dynamics> of " + std::to_string(num_dynamics_) +
                      " joints is ignored: the simulated drives have their own friction, "
                      "actuators.rotor");
    }
  }

  const Urdf& urdf_;
  const MeshFolders& folders_;
  const UrdfReader reader_;
  const std::map<std::string, Weld> welds_;
  const UnsoundBodies unsound_;
  tinyxml2::XMLDocument document_;
  XMLElement& to_;  // the new <robot>
  PhysicsUrdf result_;
  std::string unread_;  // links with unreadable meshes, a space before each
  int num_dynamics_ = 0;
};

}  // namespace

PhysicsUrdf physics_urdf(const Urdf& urdf, const MeshFolders& folders) {
  return Writer(urdf, folders).write();
}

}  // namespace surefoot::model
