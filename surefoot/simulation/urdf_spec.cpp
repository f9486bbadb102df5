#include "surefoot/simulation/urdf_spec.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/model/urdf.hpp"
#include "surefoot/simulation/text.hpp"

#include <array>
#include <cmath>
#include <fstream>
#include <iterator>

namespace surefoot::simulation {

namespace {

std::string file_content(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw FileError(text(path, ": the URDF can't be read"));
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// The URDF with MuJoCo's compiler settings inside, as MuJoCo expects them.
std::string with_compiler_settings(const std::string& urdf, const RobotDescription& description) {
  const std::size_t robot = urdf.find("<robot");
  const std::size_t end = robot == std::string::npos ? robot : urdf.find('>', robot);
  if (end == std::string::npos) {
    throw FileError(text(description.urdf_path, ": not a URDF, it has no <robot> element"));
  }
  const std::string settings =
      text("<mujoco><compiler discardvisual=\"true\" fusestatic=\"false\" strippath=\"false\" ",
           "inertiafromgeom=\"false\" meshdir=\"", description.mesh_root, "\"/></mujoco>");
  return urdf.substr(0, end + 1) + settings + urdf.substr(end + 1);
}

SpecHandle parse(const RobotDescription& description) {
  const std::string urdf = with_compiler_settings(file_content(description.urdf_path), description);
  std::array<char, 1024> error{};
  SpecHandle spec(
      mj_parseXMLString(urdf.c_str(), nullptr, error.data(), static_cast<int>(error.size())));
  if (!spec) throw FileError(text(description.urdf_path, ": ", one_line(error.data())));
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

Mat3 full_inertia(const mjsBody& body) {
  if (std::isnan(body.fullinertia[0])) {
    return Vec3(body.inertia[0], body.inertia[1], body.inertia[2]).asDiagonal();
  }
  const double* i = body.fullinertia;
  Mat3 result;
  result << i[0], i[3], i[4], i[3], i[1], i[5], i[4], i[5], i[2];
  return result;
}

void check_masses(mjsBody& base, const std::string& path) {
  for (mjsBody* body : subtree(base)) {
    if (std::isfinite(body->mass) && body->mass >= 0.0) continue;
    throw Error(text(path, ": link \"", name_of(body->element), "\" has the mass ", body->mass,
                     " kg; it must be 0 or above"));
  }
}

void drop_dummy_inertia(mjsBody& base, std::vector<std::string>& notes) {
  if (base.explicitinertial == 0) return;
  if (!is_placeholder({.mass = base.mass, .about_com = full_inertia(base)})) return;
  notes.push_back(placeholder_note(name_of(base.element), base.mass));
  base.explicitinertial = 0;
  base.mass = 0.0;
  for (double& value : base.inertia) value = 0.0;
  base.fullinertia[0] = NAN;
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

SpecHandle read_urdf(const RobotDescription& description, std::vector<std::string>& notes) {
  SpecHandle spec = parse(description);
  mjsBody& base = find_body(*spec, description.base_link, "base link");
  if (name_of(mjs_getParent(base.element)->element) != "world") {
    throw Error(text("base link \"", description.base_link, "\" is not the root of ",
                     description.urdf_path));
  }
  check_masses(base, description.urdf_path);
  drop_dummy_inertia(base, notes);
  free_the_base(base);
  if (mjs_firstElement(spec.get(), mjOBJ_MESH) == nullptr)
    mjs_setString(spec->compiler.meshdir, "");
  return spec;
}

}  // namespace surefoot::simulation
