#include "surefoot/simulation/model_builder.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/model/urdf.hpp"
#include "surefoot/simulation/added_sphere.hpp"
#include "surefoot/simulation/disturbances.hpp"
#include "surefoot/simulation/link_lengths.hpp"
#include "surefoot/simulation/mesh_hulls.hpp"
#include "surefoot/simulation/robot_parts.hpp"
#include "surefoot/simulation/terrain.hpp"
#include "surefoot/simulation/text.hpp"
#include "surefoot/simulation/urdf_spec.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <mutex>

// MuJoCo writes six digits by default, too few to recompute contact forces; its own Python bindings
// set the precision by these functions.
extern "C" {
MJAPI int _mjPRIVATE__get_xml_precision();
MJAPI void _mjPRIVATE__set_xml_precision(int digits);
}

namespace surefoot::simulation {

namespace {

constexpr int kFullPrecision = 17;
constexpr std::size_t kNearLinks = 4;   // joints between links of a leg whose shapes overlap
constexpr double kSameSphere = 1e-4;    // sphere of the URDF and of the description agree [m]
constexpr double kNearbySphere = 5e-3;  // sphere of the URDF counts as the foot's, at scale 1 [m]
constexpr double kSoleThickness = 1.0 / 17.0;  // of a box, as a share of its length
constexpr double kPoint = 1e-4;  // radius of a foot that is a point: MuJoCo needs one [m]

void set_physics(mjSpec& spec, const PlantOptions& options) {
  spec.option.timestep = options.timestep;
  spec.option.gravity[2] = -kGravity;
  spec.option.integrator = mjINT_IMPLICITFAST;
  spec.option.cone = mjCONE_ELLIPTIC;
  spec.option.impratio = options.contact.impratio;
  // Report a diverged state instead of silently resetting it.
  spec.option.disableflags |= mjDSBL_AUTORESET;
  // One robot is one island: the search for more costs 4 % of a step.
  spec.option.disableflags |= mjDSBL_ISLAND;
}

bool is_hinge(mjsElement* element) { return mjs_asJoint(element)->type == mjJNT_HINGE; }

std::vector<std::string> hinge_names(mjSpec& spec) {
  std::vector<std::string> names;
  for (mjsElement* element = mjs_firstElement(&spec, mjOBJ_JOINT); element != nullptr;
       element = mjs_nextElement(&spec, element)) {
    if (is_hinge(element)) names.push_back(name_of(element));
  }
  return names;
}

mjsElement& find_hinge(mjSpec& spec, const std::string& joint) {
  mjsElement* element = mjs_findElement(&spec, mjOBJ_JOINT, joint.c_str());
  if (element != nullptr && is_hinge(element)) return *element;
  throw UnknownNameError(
      text("unknown joint \"", joint, "\"; the robot has: ", listed(hinge_names(spec))));
}

mjsBody& moved_by(mjSpec& spec, const std::string& joint) {
  return *mjs_getParent(&find_hinge(spec, joint));
}

void check_sphere(const mjsGeom& geom, const Vec3& center,
                  const model::RobotDescription& description, Leg leg) {
  const model::LegDescription& told = description.legs[index(leg)];
  const bool same = std::abs(geom.size[0] - told.foot_radius) < kSameSphere &&
                    (center - told.foot_center).norm() < kSameSphere;
  if (same) return;
  throw Error(text("the foot sphere of ", leg_name(leg, description.num_legs()), " has radius ",
                   geom.size[0], " m and centre (", center.transpose(), ") in ",
                   description.urdf_path,
                   ", but foot.radius and foot.center of the robot file say ", told.foot_radius,
                   " m and (", told.foot_center.transpose(), "); they must agree"));
}

mjsGeom& new_sphere(mjsBody& foot, const model::LegDescription& names) {
  mjsGeom* sphere = mjs_addGeom(&foot, nullptr);
  sphere->type = mjGEOM_SPHERE;
  sphere->size[0] = std::max(names.foot_radius, kPoint);
  for (int i = 0; i < 3; ++i) sphere->pos[i] = names.foot_center[i];
  sphere->density = 0.0;
  return *sphere;
}

/// The foot sphere of the foot link or of one that is fixed to it, or a new massless one.
mjsGeom& foot_sphere(mjSpec& spec, const model::RobotDescription& description, Leg leg,
                     const std::map<std::string, model::Weld>& welds,
                     std::vector<std::string>& notes) {
  const model::LegDescription& names = description.legs[index(leg)];
  const std::string& frame = names.foot_frame;
  mjsBody& foot = find_body(spec, frame, "foot frame");
  const model::Weld& of_foot = welds.at(frame);
  const double nearby = description.scale.length * kNearbySphere;
  for (mjsBody* body : subtree(moved_by(spec, names.joints[2]))) {
    const model::Weld& weld = welds.at(name_of(body->element));
    for (mjsElement* element = mjs_firstChild(body, mjOBJ_GEOM, 0); element != nullptr;
         element = mjs_nextChild(body, element, 0)) {
      mjsGeom& geom = *mjs_asGeom(element);
      Vec3 center(geom.pos[0], geom.pos[1], geom.pos[2]);
      if (body != &foot) center = of_foot.R.transpose() * (weld.p + weld.R * center - of_foot.p);
      if (geom.type != mjGEOM_SPHERE || (center - names.foot_center).norm() >= nearby) continue;
      check_sphere(geom, center, description, leg);
      return geom;
    }
  }
  if (names.foot_radius > 0.0) notes.push_back(text(kAddedSphere, "\"", frame, "\""));
  return new_sphere(foot, names);
}

/// A flat foot: a massless box whose lower face is the sole, instead of the shapes of the link.
mjsGeom& new_sole(mjSpec& spec, const model::RobotDescription& description, Leg leg,
                  std::vector<std::string>& notes) {
  const model::LegDescription& names = description.legs[index(leg)];
  mjsBody& foot = find_body(spec, names.foot_frame, "foot frame");
  int left_out = 0;
  for (mjsBody* body : subtree(moved_by(spec, names.joints.back()))) {
    while (mjsElement* shape = mjs_firstChild(body, mjOBJ_GEOM, 0)) {
      mjs_delete(&spec, shape);
      ++left_out;
    }
  }
  notes.push_back(text("a massless sole was added to \"", names.foot_frame, "\"",
                       left_out == 0 ? "" : text(", instead of ", left_out, " shapes there")));
  mjsGeom* sole = mjs_addGeom(&foot, nullptr);
  sole->type = mjGEOM_BOX;
  for (int i = 0; i < 2; ++i) sole->size[i] = 0.5 * description.sole[i];
  const double half_thickness = 0.5 * kSoleThickness * description.sole.x();
  sole->size[2] = half_thickness;
  for (int i = 0; i < 3; ++i) sole->pos[i] = names.foot_center[i];
  sole->pos[2] += half_thickness;
  sole->density = 0.0;
  return *sole;
}

void set_collision(mjsBody& base, const ContactOptions& contact) {
  for (mjsBody* body : subtree(base)) {
    for (mjsElement* element = mjs_firstChild(body, mjOBJ_GEOM, 0); element != nullptr;
         element = mjs_nextChild(body, element, 0)) {
      mjsGeom& geom = *mjs_asGeom(element);
      geom.group = kRobotGroup;
      std::fill_n(geom.rgba, 3, 0.7F);  // light grey in pictures without meshes
      geom.condim = 3;
      geom.friction[0] = 0.5;  // of the robot against itself
      geom.solref[0] = contact.solref_time;
      geom.solref[1] = contact.solref_damping;
      geom.contype = 2;      // the robot's other shapes collide with it
      geom.conaffinity = 3;  // it collides with those and the terrain
    }
  }
}

void exclude(mjSpec& spec, const std::string& first, const std::string& second) {
  mjsExclude* pair = mjs_addExclude(&spec);
  mjs_setString(pair->bodyname1, first.c_str());
  mjs_setString(pair->bodyname2, second.c_str());
}

/// Names of a body and all bodies with shapes that are fixed to it.
void collect_solid(mjsBody& body, std::vector<std::string>& names) {
  if (mjs_firstChild(&body, mjOBJ_GEOM, 0) != nullptr) names.push_back(name_of(body.element));
  for (mjsElement* child = mjs_firstChild(&body, mjOBJ_BODY, 0); child != nullptr;
       child = mjs_nextChild(&body, child, 0)) {
    mjsBody& below = *mjs_asBody(child);
    if (mjs_firstChild(&below, mjOBJ_JOINT, 0) == nullptr) collect_solid(below, names);
  }
}

std::vector<std::string> solid(mjsBody& body) {
  std::vector<std::string> names;
  collect_solid(body, names);
  return names;
}

void exclude_all(mjSpec& spec, const std::vector<std::string>& some,
                 const std::vector<std::string>& others) {
  for (const std::string& one : some)
    for (const std::string& other : others) exclude(spec, one, other);
}

/// MuJoCo excludes links with one joint between them. With two joints between them, shapes overlap
/// at the hip (base and thigh) or knee (hip and shank) in legal postures. Fixed bodies count as
/// their link. Hips and ankles of more joints have more such links.
void exclude_neighbours(mjSpec& spec, mjsBody& base, const model::RobotDescription& description) {
  for (const model::LegDescription& leg : description.legs) {
    std::vector<mjsBody*> moved;
    for (const auto* joints : {&leg.joints, &leg.further})
      for (const std::string& joint : *joints) moved.push_back(&moved_by(spec, joint));
    std::ranges::sort(moved, std::greater(), [](mjsBody* body) { return subtree(*body).size(); });
    std::vector<std::vector<std::string>> links{solid(base)};
    for (mjsBody* body : moved) links.push_back(solid(*body));
    const std::size_t near = moved.size() == kJointsPerLeg ? 2 : kNearLinks;
    for (std::size_t i = 0; i < links.size(); ++i) {
      for (std::size_t j = i + 2; j < links.size() && j <= i + near; ++j)
        exclude_all(spec, links[i], links[j]);
    }
  }
}

void add_motor(mjSpec& spec, const std::string& joint) {
  mjsActuator* motor = mjs_addActuator(&spec, nullptr);
  mjs_setName(motor->element, joint.c_str());
  mjs_setToMotor(motor);
  motor->trntype = mjTRN_JOINT;
  mjs_setString(motor->target, joint.c_str());
}

ModelHandle compile(mjSpec& spec, const std::string& urdf) {
  ModelHandle model(mj_compile(&spec, nullptr));
  if (!model) {
    throw FileError(text(urdf, ": the physics model of this robot and its terrain can't be made: ",
                         one_line(mjs_getError(&spec))));
  }
  return model;
}

std::string saved_with_full_precision(const mjSpec& spec) {
  static std::mutex precision_is_global;
  const std::lock_guard lock(precision_is_global);
  const int usual = _mjPRIVATE__get_xml_precision();
  _mjPRIVATE__set_xml_precision(kFullPrecision);
  std::string xml(1 << 16, '\0');
  std::array<char, 1024> error{};
  int needed = 1;
  while (needed > 0) {
    needed = mj_saveXMLString(&spec, xml.data(), static_cast<int>(xml.size()), error.data(),
                              static_cast<int>(error.size()));
    if (needed > 0) xml.resize(static_cast<std::size_t>(needed) + 1);
  }
  _mjPRIVATE__set_xml_precision(usual);
  if (needed < 0) throw Error(text("the physics model can't be written: ", error.data()));
  xml.resize(xml.find('\0'));
  return xml;
}

SpecHandle parsed_back(const std::string& xml) {
  std::array<char, 1024> error{};
  SpecHandle spec(
      mj_parseXMLString(xml.c_str(), nullptr, error.data(), static_cast<int>(error.size())));
  if (!spec) throw Error(text("the physics model can't be read back: ", error.data()));
  return spec;
}

}  // namespace

BuiltModel build_model(const model::RobotDescription& description, const PlantOptions& options,
                       std::vector<std::string>& notes) {
  const SpecHandle spec = read_spec(description, notes);
  mjsBody& base = find_body(*spec, description.base_link, "base link");
  set_physics(*spec, options);
  const std::map<std::string, model::Weld> welds = model::welds(model::read_urdf(description));
  for (const Leg leg : description.legs.legs()) {
    mjsGeom& foot = description.can_walk() ? foot_sphere(*spec, description, leg, welds, notes)
                                           : new_sole(*spec, description, leg, notes);
    mjs_setName(foot.element, foot_geom_name(leg, description.num_legs()).c_str());
  }
  set_collision(base, options.contact);
  exclude_neighbours(*spec, base, description);
  for (const std::string& joint : description.joint_names()) add_motor(*spec, joint);
  disturb_masses(base, description, options.disturbances);
  change_link_lengths(*spec, description, options.disturbances);
  add_terrain(*spec, options.terrain, options.contact);
  const ModelHandle compiled = compile(*spec, description.urdf_path);

  // The running model is compiled from the logged text.
  std::string xml = saved_with_full_precision(*spec);
  SpecHandle saved = parsed_back(xml);
  if (compiled->nmesh > 0) {
    embed_hulls(*saved, *compiled);
    (void)compile(*saved, description.urdf_path);
    xml = saved_with_full_precision(*saved);
    saved = parsed_back(xml);
  }
  return {compile(*saved, description.urdf_path), std::move(xml)};
}

}  // namespace surefoot::simulation
