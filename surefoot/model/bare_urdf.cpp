#include "surefoot/model/bare_urdf.hpp"

#include "surefoot/model/urdf_reader.hpp"

#include <tinyxml2.h>

#include <algorithm>
#include <string_view>

namespace surefoot::model {
namespace {

using tinyxml2::XMLElement;

/// Takes out the children that are not of these names.
void keep_only(XMLElement& element, std::initializer_list<std::string_view> names) {
  for (XMLElement* child = element.FirstChildElement(); child != nullptr;) {
    XMLElement* const next = child->NextSiblingElement();
    if (std::ranges::find(names, child->Name()) == names.end()) element.DeleteChild(child);
    child = next;
  }
}

}  // namespace

std::string bare_urdf(const Urdf& urdf) {
  const auto is_held = [](const UrdfJoint& joint) { return !joint.held_type.empty(); };
  if (!urdf.text.empty() || std::ranges::any_of(urdf.joints, is_held)) return "";
  tinyxml2::XMLDocument document;
  (void)UrdfReader(urdf.path).robot(document);
  XMLElement& robot = *document.FirstChildElement("robot");
  keep_only(robot, {"link", "joint"});
  for (XMLElement* part = robot.FirstChildElement(); part != nullptr;
       part = part->NextSiblingElement()) {
    const bool is_link = std::string_view(part->Name()) == "link";
    const UrdfLink* link = is_link ? urdf.find_link(part->Attribute("name")) : nullptr;
    const bool is_left_out = is_link && link->inertia.mass == 0.0;
    is_left_out ? keep_only(*part, {})
    : is_link   ? keep_only(*part, {"inertial"})
                : keep_only(*part, {"origin", "parent", "child", "axis", "limit"});
    if (!is_link && part->Attribute("type", "fixed") != nullptr)
      keep_only(*part, {"origin", "parent", "child"});
  }
  XMLElement& settings = *robot.InsertNewChildElement("mujoco")->InsertNewChildElement("compiler");
  for (const char* off : {"fusestatic", "inertiafromgeom", "balanceinertia"})
    settings.SetAttribute(off, "false");
  tinyxml2::XMLPrinter printer;
  document.Print(&printer);
  return printer.CStr();
}

}  // namespace surefoot::model
