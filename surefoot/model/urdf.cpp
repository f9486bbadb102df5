#include "surefoot/model/urdf.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/base/formatted.hpp"
#include "surefoot/math/rotation.hpp"
#include "surefoot/model/point_mass.hpp"
#include "surefoot/model/urdf_reader.hpp"

#include <tinyxml2.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <fstream>
#include <set>
#include <sstream>
#include <string_view>

namespace surefoot::model {
namespace {

using tinyxml2::XMLElement;

/// Reads links and joints.
class Reader : public UrdfReader {
 public:
  Reader(const std::string& path, const std::string& text, ImpossibleInertia impossible)
      : UrdfReader(path, text), impossible_(impossible) {}

  UrdfLink link(const XMLElement& element) const {
    check_once(element, "link \"" + name(element) + "\"");
    const XMLElement* inertial = element.FirstChildElement("inertial");
    if (inertial == nullptr) return {name(element), Inertia(), line(element)};
    return {name(element), inertia(*inertial, name(element)), line(*inertial)};
  }

  UrdfJoint joint(const XMLElement& element) const {
    UrdfJoint result;
    result.name = name(element);
    result.line = line(element);
    check_once(element, "joint \"" + result.name + "\"");
    const char* type = element.Attribute("type");
    if (type == nullptr) fail(result.line, "joint \"" + result.name + "\" has no type");
    result.type = type;
    result.parent = end(element, "parent", result.name);
    result.child = end(element, "child", result.name);
    read_origin(element, result.R, result.p);
    if (result.type != "fixed" && result.type != "floating") read_axis(element, result);
    if (result.type != "fixed") read_limits(element, result);
    if (const XMLElement* mimic = element.FirstChildElement("mimic")) {
      read_mimic(*mimic, result);
    }
    if (const XMLElement* origin = element.FirstChildElement("origin"))
      if (origin->Attribute("rpy") != nullptr) result.rpy = vector(*origin, "rpy");
    return result;
  }

  /// Letters in another case would be passed over.
  void check_tag(const XMLElement& element) const {
    std::string small = element.Name();
    std::ranges::transform(small, small.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if ((small != "link" && small != "joint") || small == element.Name()) return;
    fail(line(element), std::string("<") + element.Name() +
                            "> does not belong in a URDF; did you mean <" + small + ">?");
  }

 private:
  /// Of two inertias or limits the first would count.
  void check_once(const XMLElement& element, const std::string& owner) const {
    std::set<std::string_view> seen;
    for (const XMLElement* child = element.FirstChildElement(); child != nullptr;
         child = child->NextSiblingElement()) {
      const std::string_view tag = child->Name();
      if (tag == "inertial") check_once(*child, owner);
      const bool is_once = std::ranges::count(kOnce, tag) > 0;
      if (is_once && !seen.insert(tag).second)
        fail(line(*child), owner + " has a second <" + std::string(tag) + ">; one of them must go");
    }
  }

  void read_mimic(const XMLElement& mimic, UrdfJoint& joint) const {
    const char* followed = mimic.Attribute("joint");
    if (followed == nullptr)
      fail(line(mimic), "joint \"" + joint.name + "\": <mimic> names no joint");
    joint.mimics = followed;
    if (mimic.Attribute("multiplier") != nullptr) joint.multiplier = number(mimic, "multiplier");
    if (mimic.Attribute("offset") != nullptr) joint.offset = number(mimic, "offset");
  }

  static constexpr std::array<std::string_view, 9> kOnce{
      "inertial", "origin", "mass", "inertia", "parent", "child", "axis", "limit", "mimic"};

  static bool is_no_limit(std::string_view text) {
    return text == "nan" || text == "inf" || text == "-inf";
  }

  void read_limits(const XMLElement& element, UrdfJoint& joint) const {
    const XMLElement* limit = element.FirstChildElement("limit");
    if (limit == nullptr) return;
    for (const auto& [name, value] :
         {std::pair{"lower", &joint.lower}, std::pair{"upper", &joint.upper},
          std::pair{"effort", &joint.effort}, std::pair{"velocity", &joint.velocity}}) {
      const char* given = limit->Attribute(name);
      if (given == nullptr || is_no_limit(given)) continue;
      *value = number(*limit, name);
    }
  }

  void read_axis(const XMLElement& element, UrdfJoint& joint) const {
    const XMLElement* axis = element.FirstChildElement("axis");
    if (axis == nullptr) return;
    joint.axis = vector(*axis, "xyz");
    if (joint.axis.norm() < 1e-6) {
      fail(line(*axis), "joint \"" + joint.name +
                            "\": its axis has no direction; valid is <axis xyz=\"0 1 0\"/>, for "
                            "instance");
    }
    joint.axis.normalize();
  }

  const XMLElement& child(const XMLElement& parent, const char* tag,
                          const std::string& link) const {
    const XMLElement* element = parent.FirstChildElement(tag);
    if (element == nullptr) {
      fail(line(parent), "link \"" + link + "\": <inertial> has no <" + tag + ">");
    }
    return *element;
  }

  Inertia inertia(const XMLElement& inertial, const std::string& link) const {
    Inertia result;
    const XMLElement& mass = child(inertial, "mass", link);
    result.mass = number(mass, "value");
    if (result.mass < 0.0 && impossible_ == ImpossibleInertia::refused) {
      fail(line(mass), "link \"" + link + "\": mass " + mass.Attribute("value") +
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
      fail(line(joint), "joint \"" + name + "\" names no " + tag + " link");
    }
    return link;
  }

  ImpossibleInertia impossible_;
};

void check_link_names(const Reader& reader, const Urdf& urdf) {
  if (urdf.links.empty()) reader.fail(1, "the <robot> has no <link>");
  std::map<std::string, int> lines;
  for (const UrdfLink& link : urdf.links) {
    const auto [first, is_new] = lines.emplace(link.name, link.line);
    if (is_new) continue;
    reader.fail(link.line, "link \"" + link.name + "\" stands twice, first in line " +
                               std::to_string(first->second));
  }
}

void check_joint_names(const Reader& reader, const Urdf& urdf) {
  std::map<std::string, int> lines;
  for (const UrdfJoint& joint : urdf.joints) {
    const auto [first, is_new] = lines.emplace(joint.name, joint.line);
    if (is_new) continue;
    reader.fail(joint.line, "joint \"" + joint.name + "\" stands twice, first in line " +
                                std::to_string(first->second));
  }
}

std::string listed_links(const Urdf& urdf) {
  std::string names;
  for (const UrdfLink& link : urdf.links) names += " " + link.name;
  return names;
}

std::string find_root(const Reader& reader, const Urdf& urdf) {
  std::set<std::string> roots;
  for (const UrdfLink& link : urdf.links) roots.insert(link.name);
  for (const UrdfJoint& joint : urdf.joints) {
    for (const std::string& link : {joint.parent, joint.child}) {
      if (urdf.find_link(link) == nullptr) {
        reader.fail(joint.line, "joint \"" + joint.name + "\": unknown link \"" + link +
                                    "\"; there are:" + listed_links(urdf));
      }
    }
    if (roots.erase(joint.child) == 0) {
      const auto first = std::ranges::find(urdf.joints, joint.child, &UrdfJoint::child);
      reader.fail(joint.line, "link \"" + joint.child + "\" is the child of two joints; of \"" +
                                  first->name + "\" and \"" + joint.name +
                                  "\" one must go, as a URDF is a tree without loops");
    }
  }
  if (roots.empty()) {
    const UrdfJoint& last = urdf.joints.back();
    reader.fail(last.line,
                "every link is the child of a joint, so that they form a loop; joint \"" +
                    last.name + "\" is the last of them. A URDF is a tree with one root");
  }
  if (roots.size() > 1) {
    std::string names;
    for (const std::string& name : roots) names += " " + name;
    reader.fail(1, "the links must form one tree; links without a parent:" + names);
  }
  return *roots.begin();
}

/// Where a joint is while all that have a drive are at 0, as its limits allow.
double position_at_rest(const Reader& reader, const Urdf& urdf, const UrdfJoint& joint) {
  double position = 0.0, factor = 1.0;
  const UrdfJoint* leader = &joint;
  for (std::size_t i = 0; !leader->mimics.empty(); ++i) {
    const auto next = std::ranges::find(urdf.joints, leader->mimics, &UrdfJoint::name);
    if (next == urdf.joints.end())
      reader.fail(leader->line, "joint \"" + leader->name + "\" mimics \"" + leader->mimics +
                                    "\", and there is no joint of that name");
    if (i == urdf.joints.size())
      reader.fail(joint.line, "joint \"" + joint.name + "\" mimics \"" + joint.mimics +
                                  "\", which follows it in turn; one of them must have a drive");
    position += factor * leader->offset;
    factor *= leader->multiplier;
    leader = &*next;
  }
  const auto bound = [](double limit, double none) { return std::isnan(limit) ? none : limit; };
  const double lower = bound(joint.lower, -kInfinity), upper = bound(joint.upper, kInfinity);
  return lower > upper ? position : std::clamp(position, lower, upper);
}

/// A limb's joints are hinges with drives; others stay where they are.
void hold_others(const Reader& reader, Urdf& urdf) {
  for (UrdfJoint& joint : urdf.joints) {
    const bool slides = joint.type == "prismatic";
    const bool follows = !joint.mimics.empty() && joint.type != "fixed";
    if (!slides && !follows) continue;
    const double position = position_at_rest(reader, urdf, joint);
    urdf.notes.push_back(formatted("joint \"%s\" (line %d) ", joint.name.c_str(), joint.line) +
                         (follows ? "follows \"" + joint.mimics + "\"" : std::string("slides")) +
                         formatted(": it is held at %g %s", position, slides ? "m" : "rad"));
    if (slides) {
      joint.p += joint.R * joint.axis * position;
    } else {
      joint.R = (joint.R * exp_rotation(position * joint.axis).toRotationMatrix()).eval();
    }
    joint.held_type = joint.type;
    joint.type = "fixed";
  }
}

/// Joints that form a circle are not reachable from the root.
void check_connected(const Reader& reader, const Urdf& urdf) {
  const std::map<std::string, Weld> reached = welds(urdf);
  for (const UrdfLink& link : urdf.links) {
    if (reached.contains(link.name)) continue;
    reader.fail(link.line, "link \"" + link.name + "\" is not connected to the root, \"" +
                               urdf.root + "\"; the links must form one tree");
  }
}

/// Places a link and all that is below it.
void weld(const Urdf& urdf, const std::string& link, const Weld& at,
          std::map<std::string, Weld>& found) {
  found[link] = at;
  for (const UrdfJoint& joint : urdf.joints) {
    if (joint.parent != link) continue;
    const Weld fixed{at.body, at.R * joint.R, at.p + at.R * joint.p};
    weld(urdf, joint.child, joint.type == "fixed" ? fixed : Weld{.body = joint.child}, found);
  }
}

/// MuJoCo keeps this name for itself.
void check_world(const Reader& reader, const Urdf& urdf) {
  const UrdfLink* world = urdf.find_link("world");
  if (world == nullptr) return;
  reader.fail(
      world->line,
      "link \"world\": the physics calls its ground so; take the link and its joint out, or "
      "give it another name");
}

/// A link right behind a joint whose mass has no extent is rarely meant so.
void note_points(Urdf& urdf) {
  for (const UrdfJoint& joint : urdf.joints) {
    if (joint.type == "fixed") continue;
    const UrdfLink& link = *urdf.find_link(joint.child);
    if (!is_point(link.inertia)) continue;
    urdf.notes.push_back(
        formatted("link \"%s\" (line %d): its inertia is 0, so that its %.3g kg "
                  "count as a point at its centre of mass",
                  link.name.c_str(), link.line, link.inertia.mass));
  }
}

/// Ignores a placeholder inertia of the root, refuses any other impossible one.
void check_inertias(const Reader& reader, Urdf& urdf) {
  for (UrdfLink& link : urdf.links) {
    if (link.name == urdf.root && is_placeholder(link.inertia)) {
      urdf.notes.push_back(placeholder_note(link.name, link.inertia.mass));
      link.inertia = Inertia();
      continue;
    }
    if (link.inertia.mass == 0.0 && !link.inertia.about_com.isZero(0.0)) {
      reader.fail(link.line, "link \"" + link.name +
                                 "\": its mass is 0 and its inertia is not; a mass above 0 kg is "
                                 "valid, or an inertia of 0");
    }
    const Vec3 moment = principal_moments(link.inertia);
    if (moment[0] < -kInertiaRounding * moment.cwiseAbs().maxCoeff()) {
      reader.fail(link.line,
                  formatted("link \"%s\": its inertia has a negative principal moment, %.3g kg·m²; "
                            "all must be above 0",
                            link.name.c_str(), moment[0]));
    }
  }
}

}  // namespace

const UrdfLink* Urdf::find_link(const std::string& name) const {
  const auto found = std::find_if(links.begin(), links.end(),
                                  [&](const UrdfLink& link) { return link.name == name; });
  return found == links.end() ? nullptr : &*found;
}

std::map<std::string, Weld> welds(const Urdf& urdf) {
  std::map<std::string, Weld> found;
  weld(urdf, urdf.root, {.body = urdf.root}, found);
  return found;
}

Urdf read_urdf(const std::string& path, ImpossibleInertia impossible, const std::string& text) {
  const Reader reader(path, text, impossible);
  tinyxml2::XMLDocument xml;
  const XMLElement& robot = reader.robot(xml);

  Urdf urdf;
  urdf.path = path;
  urdf.text = text;
  for (const XMLElement* element = robot.FirstChildElement(); element != nullptr;
       element = element->NextSiblingElement()) {
    const std::string_view tag = element->Name();
    reader.check_tag(*element);
    if (tag == "link") urdf.links.push_back(reader.link(*element));
    if (tag == "joint") urdf.joints.push_back(reader.joint(*element));
    if (tag == "note" && !text.empty()) urdf.notes.emplace_back(element->Attribute("text"));
  }
  check_link_names(reader, urdf);
  check_joint_names(reader, urdf);
  urdf.root = find_root(reader, urdf);
  hold_others(reader, urdf);
  check_connected(reader, urdf);
  if (impossible == ImpossibleInertia::kept) return urdf;
  check_world(reader, urdf);
  check_inertias(reader, urdf);
  note_points(urdf);
  return urdf;
}

Urdf read_urdf(const RobotDescription& robot) {
  return read_urdf(robot.urdf_path, ImpossibleInertia::refused, robot.urdf_text);
}

std::string urdf_text(const RobotDescription& robot) {
  if (!robot.urdf_text.empty()) return robot.urdf_text;
  std::ostringstream text;
  if (!(text << std::ifstream(robot.urdf_path, std::ios::binary).rdbuf()))
    throw FileError(robot.urdf_path + ": can't be read");
  return text.str();
}

}  // namespace surefoot::model
