#include "surefoot/simulation/urdf_spec.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/model/bare_urdf.hpp"
#include "surefoot/model/physics_urdf.hpp"
#include "surefoot/simulation/text.hpp"

#include <array>

namespace surefoot::simulation {

namespace {

SpecHandle parse(const model::PhysicsUrdf& urdf, const std::string& path) {
  std::array<char, 1024> error{};
  SpecHandle spec(
      mj_parseXMLString(urdf.xml.c_str(), nullptr, error.data(), static_cast<int>(error.size())));
  if (!spec) throw FileError(text(path, ": ", one_line(error.data())));
  return spec;
}

std::vector<std::string> body_names(mjSpec& spec) {
  std::vector<std::string> result;
  for (mjsBody* body : subtree(*mjs_findBody(&spec, "world"))) {
    result.push_back(name_of(body->element));
  }
  result.erase(result.begin());  // the world
  return result;
}

void free_the_base(mjsBody& base) {
  mjsJoint* joint = mjs_addFreeJoint(&base);
  mjs_setName(joint->element, "base_free");
  joint->align = mjALIGNFREE_FALSE;  // qpos and qvel are those of the base link's frame
}

}  // namespace

std::vector<mjsBody*> subtree(mjsBody& body) {
  std::vector<mjsBody*> bodies{&body};
  for (mjsElement* child = mjs_firstChild(&body, mjOBJ_BODY, 0); child != nullptr;
       child = mjs_nextChild(&body, child, 0)) {
    const std::vector<mjsBody*> below = subtree(*mjs_asBody(child));
    bodies.insert(bodies.end(), below.begin(), below.end());
  }
  return bodies;
}

mjsBody& find_body(mjSpec& spec, const std::string& name, const std::string& role) {
  mjsBody* body = mjs_findBody(&spec, name.c_str());
  if (body == nullptr || name == "world") {
    throw UnknownNameError(
        text("unknown ", role, " \"", name, "\"; the robot has: ", listed(body_names(spec))));
  }
  return *body;
}

SpecHandle read_bare_spec(const model::RobotDescription& description) {
  const std::string urdf = model::bare_urdf(model::read_urdf(description));
  std::array<char, 1024> error{};
  SpecHandle spec(urdf.empty() ? nullptr
                               : mj_parseXMLString(urdf.c_str(), nullptr, error.data(),
                                                   static_cast<int>(error.size())));
  mjsBody* const base = spec ? mjs_findBody(spec.get(), description.base_link.c_str()) : nullptr;
  if (base == nullptr) return nullptr;
  free_the_base(*base);
  return spec;
}

SpecHandle read_spec(const model::RobotDescription& description, std::vector<std::string>& notes) {
  const model::Urdf urdf = model::read_urdf(description);
  const model::PhysicsUrdf physics = model::physics_urdf(urdf, model::mesh_folders(description));
  notes.insert(notes.end(), urdf.notes.begin(), urdf.notes.end());
  notes.insert(notes.end(), physics.notes.begin(), physics.notes.end());
  SpecHandle spec = parse(physics, description.urdf_path);
  mjsBody& base = find_body(*spec, description.base_link, "base link");
  if (name_of(mjs_getParent(base.element)->element) != "world") {
    throw Error(text("base link \"", description.base_link, "\" is not the root of ",
                     description.urdf_path));
  }
  free_the_base(base);
  return spec;
}

}  // namespace surefoot::simulation
