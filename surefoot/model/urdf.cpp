#include "surefoot/model/urdf.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/math/rotation.hpp"

#include <Eigen/Eigenvalues>
#include <tinyxml2.h>

#include <algorithm>
#include <fstream>
#include <locale>
#include <set>
#include <sstream>

namespace surefoot {
namespace {

using tinyxml2::XMLElement;

constexpr double kPlaceholderMass = 1e-3;  // [kg]
constexpr double kRounding = 1e-9;         // share of the largest moment that counts as none

/// Principal moments of inertia, the smallest first.
Vec3 moments(const Inertia& inertia) {
  return Eigen::SelfAdjointEigenSolver<Mat3>(inertia.about_com, Eigen::EigenvaluesOnly)
      .eigenvalues();
}

/// m (|r|² 1 − r rᵀ), the inertia of a point mass at r.
Mat3 point_inertia(double mass, const Vec3& r) {
  return mass * (r.squaredNorm() * Mat3::Identity() - r * r.transpose());
}

/// Reads the elements of one file and words its errors.
class Reader {
 public:
  explicit Reader(const std::string& path) : path_(path) {}

  [[noreturn]] void fail(int line, const std::string& what) const {
    throw FileError(path_ + ":" + std::to_string(line) + ": " + what);
  }

  std::string name(const XMLElement& element) const {
    const char* text = element.Attribute("name");
    if (text == nullptr) {
      fail(element.GetLineNum(), std::string("<") + element.Name() + "> has no name");
    }
    return text;
  }

  UrdfLink link(const XMLElement& element) const {
    const XMLElement* inertial = element.FirstChildElement("inertial");
    if (inertial == nullptr) return {name(element), Inertia(), element.GetLineNum()};
    return {name(element), inertia(*inertial, name(element)), inertial->GetLineNum()};
  }

  UrdfJoint joint(const XMLElement& element) const {
    UrdfJoint result;
    result.name = name(element);
    result.line = element.GetLineNum();
    const char* type = element.Attribute("type");
    if (type == nullptr) fail(result.line, "joint \"" + result.name + "\" has no type");
    result.type = type;
    result.parent = end(element, "parent", result.name);
    result.child = end(element, "child", result.name);
    read_origin(element, result.R, result.p);
    if (const XMLElement* axis = element.FirstChildElement("axis")) {
      result.axis = vector(*axis, "xyz");
      if (result.axis.norm() < 1e-6) fail(axis->GetLineNum(), "the axis has no direction");
      result.axis.normalize();
    }
    return result;
  }

 private:
  template <std::size_t N>
  std::array<double, N> numbers(const XMLElement& element, const char* attribute) const {
    const char* text = element.Attribute(attribute);
    std::istringstream stream(text == nullptr ? "" : text);
    stream.imbue(std::locale::classic());
    std::array<double, N> values{};
    for (double& value : values) stream >> value;  // reads neither "nan" nor "inf"
    std::string rest;
    if (stream.fail() || (stream >> rest)) {
      fail(element.GetLineNum(), std::string("<") + element.Name() + "> needs " + attribute +
                                     "=\"" + (N == 1 ? "a finite number" : "three finite numbers") +
                                     "\", not \"" + (text == nullptr ? "" : text) + "\"");
    }
    return values;
  }

  double number(const XMLElement& element, const char* attribute) const {
    return numbers<1>(element, attribute)[0];
  }

  Vec3 vector(const XMLElement& element, const char* attribute) const {
    const std::array<double, 3> values = numbers<3>(element, attribute);
    return {values[0], values[1], values[2]};
  }

  void read_origin(const XMLElement& parent, Mat3& R, Vec3& p) const {
    const XMLElement* origin = parent.FirstChildElement("origin");
    if (origin == nullptr) return;
    if (origin->Attribute("xyz") != nullptr) p = vector(*origin, "xyz");
    if (origin->Attribute("rpy") != nullptr) {
      R = from_roll_pitch_yaw(vector(*origin, "rpy")).toRotationMatrix();
    }
  }

  const XMLElement& child(const XMLElement& parent, const char* tag,
                          const std::string& link) const {
    const XMLElement* element = parent.FirstChildElement(tag);
    if (element == nullptr) {
      fail(parent.GetLineNum(), "link \"" + link + "\": <inertial> has no <" + tag + ">");
    }
    return *element;
  }

  Inertia inertia(const XMLElement& inertial, const std::string& link) const {
    Inertia result;
    const XMLElement& mass = child(inertial, "mass", link);
    result.mass = number(mass, "value");
    if (result.mass < 0.0) {
      fail(mass.GetLineNum(), "link \"" + link + "\": mass " + mass.Attribute("value") +
                                  " kg is negative; it must be 0 or more");
    }
    const XMLElement& tensor = child(inertial, "inertia", link);
    const auto entry = [&](const char* name) { return number(tensor, name); };
    result.about_com << entry("ixx"), entry("ixy"), entry("ixz"), entry("ixy"), entry("iyy"),
        entry("iyz"), entry("ixz"), entry("iyz"), entry("izz");
    Mat3 R = Mat3::Identity();
    read_origin(inertial, R, result.com);
    result.about_com = (R * result.about_com * R.transpose()).eval();
    return result;
  }

  std::string end(const XMLElement& joint, const char* tag, const std::string& name) const {
    const XMLElement* element = joint.FirstChildElement(tag);
    const char* link = element == nullptr ? nullptr : element->Attribute("link");
    if (link == nullptr) {
      fail(joint.GetLineNum(), "joint \"" + name + "\" names no " + tag + " link");
    }
    return link;
  }

  const std::string& path_;
};

std::string find_root(const Reader& reader, const Urdf& urdf) {
  std::set<std::string> roots;
  for (const UrdfLink& link : urdf.links) {
    if (!roots.insert(link.name).second)
      reader.fail(link.line, "link \"" + link.name + "\" stands twice");
  }
  for (const UrdfJoint& joint : urdf.joints) {
    for (const std::string& link : {joint.parent, joint.child}) {
      if (urdf.find_link(link) == nullptr) {
        reader.fail(joint.line,
                    "joint \"" + joint.name + "\": link \"" + link + "\" does not exist");
      }
    }
    if (roots.erase(joint.child) == 0) {
      reader.fail(joint.line, "link \"" + joint.child + "\" is the child of two joints");
    }
  }
  if (roots.size() != 1) {
    std::string names;
    for (const std::string& name : roots) names += " " + name;
    reader.fail(1, "the links must form one tree; links without a parent:" +
                       (names.empty() ? " none" : names));
  }
  return *roots.begin();
}

/// Drops the root's inertia if it is a placeholder, refuses any other that can't be one of a body.
void check_inertias(const Reader& reader, Urdf& urdf) {
  for (UrdfLink& link : urdf.links) {
    if (link.name == urdf.root && is_placeholder(link.inertia)) {
      urdf.notes.push_back(placeholder_note(link.name, link.inertia.mass));
      link.inertia = Inertia();
    } else if (moments(link.inertia)[0] < 0.0) {
      reader.fail(link.line, "link \"" + link.name + "\": its inertia has a negative eigenvalue");
    }
  }
}

}  // namespace

Inertia Inertia::placed(const Mat3& R, const Vec3& p) const {
  return {mass, R * com + p, R * about_com * R.transpose()};
}

Inertia Inertia::operator+(const Inertia& other) const {
  Inertia sum;
  sum.mass = mass + other.mass;
  if (sum.mass > 0.0) sum.com = (mass * com + other.mass * other.com) / sum.mass;
  sum.about_com = about_com + point_inertia(mass, com - sum.com) + other.about_com +
                  point_inertia(other.mass, other.com - sum.com);
  return sum;
}

const UrdfLink* Urdf::find_link(const std::string& name) const {
  const auto found = std::find_if(links.begin(), links.end(),
                                  [&](const UrdfLink& link) { return link.name == name; });
  return found == links.end() ? nullptr : &*found;
}

bool is_placeholder(const Inertia& inertia) {
  const Vec3 moment = moments(inertia);
  const bool described = inertia.mass > 0.0 || !inertia.about_com.isZero(0.0);
  const bool positive_definite = moment[0] > kRounding * moment[2];
  return described && inertia.mass <= kPlaceholderMass &&
         (inertia.mass == 0.0 || !positive_definite);
}

std::string placeholder_note(const std::string& link, double mass) {
  std::ostringstream note;
  note << "root link \"" << link << "\": its inertia (" << mass
       << " kg, not positive definite) is a placeholder and was left out";
  return note.str();
}

Urdf read_urdf(const std::string& path) {
  if (!std::ifstream(path))
    throw FileError(path + ": the URDF can't be read; does the file exist?");
  const Reader reader(path);
  tinyxml2::XMLDocument xml;
  if (xml.LoadFile(path.c_str()) != tinyxml2::XML_SUCCESS) {
    reader.fail(xml.ErrorLineNum(), std::string("not well-formed XML: ") + xml.ErrorName());
  }
  const XMLElement* robot = xml.FirstChildElement("robot");
  if (robot == nullptr) reader.fail(1, "not a URDF: the file has no <robot>");

  Urdf urdf;
  urdf.path = path;
  for (const XMLElement* element = robot->FirstChildElement(); element != nullptr;
       element = element->NextSiblingElement()) {
    const std::string_view tag = element->Name();
    if (tag == "link") urdf.links.push_back(reader.link(*element));
    if (tag == "joint") urdf.joints.push_back(reader.joint(*element));
  }
  urdf.root = find_root(reader, urdf);
  check_inertias(reader, urdf);
  return urdf;
}

}  // namespace surefoot
