#include "surefoot/model/collision_shapes.hpp"

#include "surefoot/math/numbers.hpp"
#include "surefoot/model/urdf_reader.hpp"

#include <tinyxml2.h>

#include <algorithm>
#include <cmath>

namespace surefoot::model {
namespace {

using tinyxml2::XMLElement;

/// 0 if it is not given.
double length_of(const UrdfReader& reader, const XMLElement& shape, const char* attribute,
                 const std::string& link) {
  const char* given = shape.Attribute(attribute);
  if (given == nullptr) return 0.0;
  const double length = shape.DoubleAttribute(attribute, kNaN);
  if (std::isfinite(length) && length >= 0.0) return length;
  reader.fail(reader.line(shape), "link \"" + link + "\": the <" + shape.Name() +
                                      "> that it collides with has a size of " + given +
                                      " m; it must be above 0");
}

double radius_of(const UrdfReader& reader, const XMLElement& shape, const std::string& link) {
  if (shape.Attribute("size") != nullptr) return 0.5 * reader.vector(shape, "size").minCoeff();
  return length_of(reader, shape, "radius", link);
}

void add_shapes(const UrdfReader& reader, const XMLElement& link,
                std::vector<CollisionShape>& shapes) {
  for (const XMLElement* element = link.FirstChildElement("collision"); element != nullptr;
       element = element->NextSiblingElement("collision")) {
    const XMLElement* geometry = element->FirstChildElement("geometry");
    const XMLElement* shape = geometry == nullptr ? nullptr : geometry->FirstChildElement();
    if (shape == nullptr) continue;
    CollisionShape& added = shapes.emplace_back();
    added.link = reader.name(link);
    added.kind = shape->Name();
    added.radius = radius_of(reader, *shape, added.link);
    added.length = length_of(reader, *shape, "length", added.link);
    if (shape->Attribute("size") != nullptr) added.size = reader.vector(*shape, "size");
    if (const char* file = shape->Attribute("filename")) added.mesh = file;
    if (shape->Attribute("scale") != nullptr) added.scale = reader.vector(*shape, "scale");
    added.line = reader.line(*shape);
    reader.read_origin(*element, added.R, added.center);
  }
}

}  // namespace

std::vector<CollisionShape> collision_shapes(const Urdf& urdf) {
  const UrdfReader reader(urdf.path, urdf.text);
  tinyxml2::XMLDocument xml;
  std::vector<CollisionShape> shapes;
  const XMLElement& robot = reader.robot(xml);
  for (const XMLElement* link = robot.FirstChildElement("link"); link != nullptr;
       link = link->NextSiblingElement("link")) {
    add_shapes(reader, *link, shapes);
  }
  return shapes;
}

}  // namespace surefoot::model
