#include "surefoot/model/joints_as_written.hpp"

#include "surefoot/model/urdf_reader.hpp"

#include <tinyxml2.h>

#include <algorithm>

namespace surefoot::model {

std::vector<std::string> joints_without_axis(const Urdf& urdf) {
  const UrdfReader reader(urdf.path, urdf.text);
  tinyxml2::XMLDocument xml;
  const tinyxml2::XMLElement& robot = reader.robot(xml);
  std::vector<std::string> names;
  for (const tinyxml2::XMLElement* joint = robot.FirstChildElement("joint"); joint != nullptr;
       joint = joint->NextSiblingElement("joint")) {
    const auto read = std::ranges::find(urdf.joints, reader.name(*joint), &UrdfJoint::name);
    const bool moves = read != urdf.joints.end() && read->type != "fixed";
    if (moves && joint->FirstChildElement("axis") == nullptr) names.push_back(read->name);
  }
  return names;
}

std::string written_limit(const Urdf& urdf, const std::string& joint, const char* attribute) {
  const UrdfReader reader(urdf.path, urdf.text);
  tinyxml2::XMLDocument xml;
  const tinyxml2::XMLElement& robot = reader.robot(xml);
  for (const tinyxml2::XMLElement* each = robot.FirstChildElement("joint"); each != nullptr;
       each = each->NextSiblingElement("joint")) {
    const tinyxml2::XMLElement* limit = each->FirstChildElement("limit");
    if (limit == nullptr || reader.name(*each) != joint) continue;
    const char* text = limit->Attribute(attribute);
    return text == nullptr ? "" : text;
  }
  return "";
}

}  // namespace surefoot::model
