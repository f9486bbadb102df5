#include "surefoot/simulation/mjcf_robot.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/base/nearest_name.hpp"
#include "surefoot/model/urdf_reader.hpp"
#include "surefoot/simulation/mjcf_effort.hpp"
#include "surefoot/simulation/text.hpp"
#include "surefoot/simulation/urdf_spec.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <utility>

namespace surefoot::simulation {
namespace {

std::string string_of(const mjString* string) { return mjs_getString(string); }

/// Elements of a body, or of the spec, of one kind.
std::vector<mjsElement*> children(const mjsBody& body, mjtObj type) {
  std::vector<mjsElement*> elements;
  for (mjsElement* child = mjs_firstChild(&body, type, 0); child != nullptr;
       child = mjs_nextChild(&body, child, 0))
    elements.push_back(child);
  return elements;
}

std::vector<mjsElement*> elements(const mjSpec& spec, mjtObj type) {
  std::vector<mjsElement*> result;
  for (mjsElement* element = mjs_firstElement(&spec, type); element != nullptr;
       element = mjs_nextElement(&spec, element))
    result.push_back(element);
  return result;
}

class MjcfReader {
 public:
  explicit MjcfReader(const std::string& path) : path_(path) {}

  MjcfRobot read() {
    const std::string root = model::root_of_xml(path_, "MJCF");
    if (root != "mujoco") {
      fail(1, text("not an MJCF: the file has no <mujoco>",
                   root == "robot" ? "; a URDF stands under `urdf:`" : ""));
    }
    const MessageCatcher messages(warnings_);
    parse();
    find_base();
    refuse_constraints();
    name_all();
    for (mjsBody* body : subtree(*robot_.base)) check_body(*body);
    robot_.effort = effort_limits(*robot_.spec);
    leave_out_world();
    leave_out_files();
    compile();
    note_what_is_left_out();
    return std::move(robot_);
  }

 private:
  [[noreturn]] void fail(int line, const std::string& what) const {
    throw FileError(text(path_, ":", line, ": ", what));
  }

  void parse() {
    std::array<char, 1024> error{};
    robot_.spec.reset(
        mj_parseXML(path_.c_str(), nullptr, error.data(), static_cast<int>(error.size())));
    if (!robot_.spec) fail_as_mujoco(one_line(error.data()));
  }

  /// Its message, with the line of the element that it speaks of.
  [[noreturn]] void fail_as_mujoco(std::string message) const {
    const std::string_view opening = "Error opening file '";
    const std::size_t file = message.find(opening);
    const auto meshes = robot_.spec && file != std::string::npos
                            ? elements(*robot_.spec, mjOBJ_MESH)
                            : std::vector<mjsElement*>();
    for (mjsElement* element : meshes) {
      const mjsMesh& mesh = *mjs_asMesh(element);
      const std::string name = string_of(mesh.file);
      if (name.empty() || message.find(name) == std::string::npos) continue;
      const auto folder =
          std::filesystem::absolute(path_).parent_path() / string_of(robot_.spec->compiler.meshdir);
      fail(line_of(mesh.info), text("<mesh>: there is no \"", name, "\"; looked for in ",
                                    folder.lexically_normal().string()));
    }
    const std::size_t place = message.rfind(", line ");
    const int line = place == std::string::npos ? 1 : std::atoi(message.c_str() + place + 7);
    message.resize(std::min(place, message.size()));
    if (message.starts_with("XML Error: ")) message.erase(0, 11);
    if (message.starts_with("Error: ")) message.erase(0, 7);
    fail(std::max(1, line), in_our_words(std::move(message)));
  }

  /// What MuJoCo says of a body's mass and inertia, and the end of any message of an element.
  static std::string in_our_words(std::string message) {
    constexpr std::string_view kElement = ", Element name '";
    const std::size_t end = message.find(kElement);
    if (end == std::string::npos) return message;
    std::string name = message.substr(end + kElement.size());
    name.resize(std::min(name.find('\''), name.size()));
    message.resize(end);
    if (message.find("mjMINVAL") != std::string::npos)
      return "body \"" + name +
             "\" moves, but has no mass or no inertia about some axis; all must be above 0";
    if (message.find("A + B >= C") != std::string::npos)
      return "body \"" + name +
             "\": of its principal moments of inertia one is larger than the sum of the two "
             "others, as in no body";
    return name.empty() ? message : message + ": \"" + name + "\"";
  }

  void find_base() {
    std::vector<mjsBody*> free;
    for (mjsElement* element : elements(*robot_.spec, mjOBJ_JOINT)) {
      if (mjs_asJoint(element)->type == mjJNT_FREE) free.push_back(mjs_getParent(element));
    }
    if (free.empty()) {
      fail(1, "no body has a free joint; the robot's base needs one, <freejoint/>");
    }
    if (free.size() > 1) {
      std::string names;
      for (const mjsBody* body : free) names += " \"" + name_of(body->element) + "\"";
      fail(line_of(free[1]->info),
           "several bodies have a free joint:" + names + "; only one may, the robot's base");
    }
    robot_.base = free.front();
  }

  /// Of what changes the mechanics of a tree of bodies nothing is left out silently.
  void refuse_constraints() const {
    for (mjsElement* element : elements(*robot_.spec, mjOBJ_EQUALITY)) {
      const mjsEquality& equality = *mjs_asEquality(element);
      if (equality.active == 0) continue;
      fail(line_of(equality.info),
           text("an equality constraint ties \"", string_of(equality.name1), "\" to \"",
                string_of(equality.name2), "\"; the model has no such constraints"));
    }
    for (mjsElement* element : elements(*robot_.spec, mjOBJ_TENDON)) {
      const mjsTendon& tendon = *mjs_asTendon(element);
      if (!acts(tendon)) continue;
      fail(line_of(tendon.info), "tendon \"" + name_of(element) +
                                     "\" has stiffness, damping, friction, inertia or a limit; the "
                                     "model has no tendons");
    }
    for (mjsElement* element : elements(*robot_.spec, mjOBJ_ACTUATOR)) {
      const mjsActuator& actuator = *mjs_asActuator(element);
      check_joint_of(actuator);
      if (actuator.trntype != mjTRN_TENDON && actuator.trntype != mjTRN_SLIDERCRANK) continue;
      fail(line_of(actuator.info),
           "actuator \"" + name_of(element) +
               "\" pulls a tendon or a crank; each joint of a leg needs a drive of its own");
    }
  }

  /// A drive that has no joint would leave the joint that is meant without an effort.
  void check_joint_of(const mjsActuator& actuator) const {
    if (actuator.trntype != mjTRN_JOINT && actuator.trntype != mjTRN_JOINTINPARENT) return;
    const std::string joint = string_of(actuator.target);
    std::vector<std::string> known;
    for (mjsElement* element : elements(*robot_.spec, mjOBJ_JOINT))
      if (mjs_asJoint(element)->type != mjJNT_FREE && !name_of(element).empty())
        known.push_back(name_of(element));
    if (std::ranges::find(known, joint) != known.end()) return;
    fail(line_of(actuator.info),
         text("actuator \"", name_of(actuator.element), "\" drives an unknown joint, \"", joint,
              "\"; ", valid_names(joint, known)));
  }

  /// Bodies and joints need no name in an MJCF, but in a URDF: a body gets "body1" and so on, a
  /// joint that of its body.
  void name_all() const {
    std::set<std::string> bodies, joints;
    for (mjsElement* element : elements(*robot_.spec, mjOBJ_BODY)) bodies.insert(name_of(element));
    for (mjsElement* element : elements(*robot_.spec, mjOBJ_JOINT)) joints.insert(name_of(element));
    int num_unnamed = 0;
    for (mjsBody* body : subtree(*robot_.base)) {
      std::string name = name_of(body->element);
      if (name.empty()) {
        while (!bodies.insert(name = text("body", ++num_unnamed)).second) continue;
        (void)mjs_setName(body->element, name.c_str());
      }
      for (mjsElement* joint : children(*body, mjOBJ_JOINT)) {
        if (!name_of(joint).empty()) continue;
        std::string joint_name = name + "_joint";
        while (!joints.insert(joint_name).second) joint_name += "_";
        (void)mjs_setName(joint, joint_name.c_str());
      }
    }
  }

  [[nodiscard]] bool acts(const mjsTendon& tendon) const {
    return tendon.stiffness[0] != 0.0 || tendon.damping[0] != 0.0 || tendon.frictionloss != 0.0 ||
           tendon.armature != 0.0 || is_limited(*robot_.spec, tendon.limited, tendon.range);
  }

  void check_body(const mjsBody& body) {
    const std::string name = "body \"" + name_of(body.element) + "\"";
    if (body.gravcomp != 0.0)
      fail(line_of(body.info), name + " has gravcomp; the model has no gravity compensation");
    if (!Vec3(body.pos).allFinite()) fail(line_of(body.info), name + ": its pos is not finite");
    if (body.explicitinertial != 0) check_inertial(body, name);
    const std::vector<mjsElement*> joints = children(body, mjOBJ_JOINT);
    if (joints.size() > 1) {
      fail(line_of(body.info), text(name, " has ", joints.size(),
                                    " joints; it may have one, so put a body between them"));
    }
    if (joints.empty()) return;
    const mjsJoint& joint = *mjs_asJoint(joints.front());
    check_joint(joint);
    if (joint.stiffness[0] != 0.0) {
      fail(line_of(joint.info), "joint \"" + name_of(joint.element) +
                                    "\" has stiffness; the model has no springs at joints");
    }
    if (joint.type == mjJNT_FREE) return;
    num_losses_ +=
        int{joint.damping[0] != 0.0 || joint.frictionloss != 0.0 || joint.armature != 0.0};
  }

  void check_inertial(const mjsBody& body, const std::string& name) const {
    const auto refuse = [&](const std::string& what) { fail(line_of(body.info), name + what); };
    if (!std::isfinite(body.mass)) refuse(": the mass of its <inertial> is not a finite number");
    if (body.mass < 0.0)
      refuse(text(": the mass of its <inertial> is ", body.mass, " kg; it must be 0 or more"));
    const Vec3 moments(body.inertia);
    if (std::isfinite(body.fullinertia[0])) return;
    if (!moments.allFinite()) refuse(": the diaginertia of its <inertial> is not finite");
    if (moments.minCoeff() < 0.0)
      refuse(text(": its inertia has a negative principal moment, ", moments.minCoeff(),
                  " kg·m²; all must be above 0"));
  }

  /// A range that is not in order is none for MuJoCo.
  void check_joint(const mjsJoint& joint) const {
    const std::string name = "joint \"" + name_of(joint.element) + "\"";
    const bool turns = joint.type == mjJNT_HINGE || joint.type == mjJNT_SLIDE;
    constexpr double kLeast = 1e-10;  // of an axis's length
    if (turns && !(Vec3(joint.axis).norm() > kLeast)) {
      fail(line_of(joint.info), text(name, ": its axis, ", Vec3(joint.axis).transpose(),
                                     ", has no direction; valid is axis=\"0 1 0\", for instance"));
    }
    const bool is_given = joint.range[0] != 0.0 || joint.range[1] != 0.0;
    if (!turns || !is_given || joint.range[0] < joint.range[1]) return;
    fail(line_of(joint.info), text(name, " has a range from ", joint.range[0], " to ",
                                   joint.range[1], "; the first must be the lower one"));
  }

  void remove(mjsElement* element) { (void)mjs_delete(robot_.spec.get(), element); }

  void remove_all(mjtObj type) {
    for (mjsElement* element : elements(*robot_.spec, type)) remove(element);
  }

  void leave_out_world() {
    for (const mjtObj type :
         {mjOBJ_KEY, mjOBJ_SENSOR, mjOBJ_ACTUATOR, mjOBJ_EQUALITY, mjOBJ_TENDON, mjOBJ_PAIR,
          mjOBJ_EXCLUDE, mjOBJ_TUPLE, mjOBJ_SKIN, mjOBJ_FLEX, mjOBJ_CAMERA, mjOBJ_LIGHT})
      remove_all(type);
    mjsBody& world = *mjs_findBody(robot_.spec.get(), "world");
    for (const mjtObj type : {mjOBJ_BODY, mjOBJ_GEOM, mjOBJ_SITE}) {
      for (mjsElement* element : children(world, type)) {
        if (element != robot_.base->element) remove(element);
      }
    }
    remove_all(mjOBJ_HFIELD);
  }

  [[nodiscard]] mjsMesh* find_mesh(const std::string& name) const {
    for (mjsElement* element : elements(*robot_.spec, mjOBJ_MESH)) {
      mjsMesh& mesh = *mjs_asMesh(element);
      const std::string own = name_of(element);
      if (own == name ||
          (own.empty() && std::filesystem::path(string_of(mesh.file)).stem() == name))
        return &mesh;
    }
    return nullptr;
  }

  [[nodiscard]] MjcfLook look_of(const mjsGeom& geom) const {
    MjcfLook look;
    const mjsElement* material =
        mjs_findElement(robot_.spec.get(), mjOBJ_MATERIAL, string_of(geom.material).c_str());
    std::copy_n(geom.rgba, 4, look.rgba.begin());
    constexpr std::array<float, 4> kUnset{0.5F, 0.5F, 0.5F, 1.0F};
    if (material != nullptr && look.rgba == kUnset)
      std::copy_n(mjs_asMaterial(const_cast<mjsElement*>(material))->rgba, 4, look.rgba.begin());
    look.is_mesh = geom.type == mjGEOM_MESH;
    const std::string name = string_of(geom.meshname);
    const mjsMesh* mesh = find_mesh(name);
    if (mesh == nullptr && !name.empty()) {
      fail(line_of(geom.info),
           "unknown mesh \"" + name + "\"; valid is the name of a <mesh>, or of its file");
    }
    if (mesh == nullptr || !look.is_mesh) return look;
    const bool is_moved = !Vec3(mesh->refpos).isZero(0.0) || mesh->refquat[1] != 0.0 ||
                          mesh->refquat[2] != 0.0 || mesh->refquat[3] != 0.0;
    if (is_moved) {
      fail(line_of(mesh->info), "mesh \"" + name +
                                    "\" has refpos or refquat, which are not read; give the geom "
                                    "pos and quat");
    }
    const std::string file = string_of(mesh->file);
    if (!file.empty())
      look.mesh = (std::filesystem::path(string_of(robot_.spec->compiler.meshdir)) / file).string();
    look.scale = Vec3(mesh->scale);
    return look;
  }

  [[nodiscard]] static bool has_urdf_shape(const mjsGeom& geom, const MjcfLook& look) {
    if (look.is_mesh) return !look.mesh.empty();
    return geom.type == mjGEOM_SPHERE || geom.type == mjGEOM_CAPSULE ||
           geom.type == mjGEOM_CYLINDER || geom.type == mjGEOM_BOX;
  }

  /// Must the body's geoms stay as they are, as its inertia is theirs?
  [[nodiscard]] bool has_inertia_of_geoms(const mjsBody& body) const {
    const mjtInertiaFromGeom from = robot_.spec->compiler.inertiafromgeom;
    return from == mjINERTIAFROMGEOM_TRUE ||
           (from == mjINERTIAFROMGEOM_AUTO && body.explicitinertial == 0);
  }

  /// Takes out meshes, unless a body has their inertia, and materials with their textures.
  void leave_out_files() {
    std::set<std::string> kept;
    for (mjsBody* body : subtree(*robot_.base)) {
      const bool keeps = has_inertia_of_geoms(*body);
      for (mjsElement* element : children(*body, mjOBJ_GEOM)) {
        mjsGeom& geom = *mjs_asGeom(element);
        const MjcfLook& look = robot_.looks[&geom] = look_of(geom);
        if (!has_urdf_shape(geom, look) && (geom.contype != 0 || geom.conaffinity != 0))
          no_shapes_ += " " + name_of(body->element);
        mjs_setString(geom.material, "");
        if (string_of(geom.meshname).empty()) continue;
        if (keeps || geom.type != mjGEOM_MESH) {
          kept.insert(string_of(geom.meshname));
          continue;
        }
        mjs_setString(geom.meshname, "");
        geom.type = mjGEOM_SPHERE;
        geom.size[0] = 1.0;
      }
      for (mjsElement* element : children(*body, mjOBJ_SITE)) {
        mjs_setString(mjs_asSite(element)->material, "");
        mjs_setString(mjs_asSite(element)->meshname, "");
        mjs_asSite(element)->type = mjGEOM_SPHERE;
      }
    }
    for (mjsElement* element : elements(*robot_.spec, mjOBJ_MESH)) {
      mjs_setString(mjs_asMesh(element)->material, "");
      const std::string name = name_of(element);
      const std::string stem =
          std::filesystem::path(string_of(mjs_asMesh(element)->file)).stem().string();
      if (!kept.contains(name.empty() ? stem : name)) remove(element);
    }
    remove_all(mjOBJ_MATERIAL);
    remove_all(mjOBJ_TEXTURE);
  }

  /// Bodies stay as they are written, and the base's frame too.
  void compile() {
    mjSpec& spec = *robot_.spec;
    spec.compiler.fusestatic = 0;
    spec.compiler.alignfree = 0;
    spec.option.gravity[0] = spec.option.gravity[1] = 0.0;
    spec.option.gravity[2] = -kGravity;
    for (mjsElement* element : children(*robot_.base, mjOBJ_JOINT))
      mjs_asJoint(element)->align = mjALIGNFREE_FALSE;
    for (mjsElement* element : elements(spec, mjOBJ_JOINT)) {
      mjsJoint& joint = *mjs_asJoint(element);
      joint.armature = joint.frictionloss = joint.damping[0] = 0.0;
    }
    robot_.model.reset(mj_compile(&spec, nullptr));
    if (!robot_.model) fail_as_mujoco(one_line(mjs_getError(&spec)));
  }

  void note_what_is_left_out() {
    robot_.notes = warnings_;
    if (!no_shapes_.empty()) {
      robot_.notes.push_back(
          "collision shapes that are no box, capsule, cylinder, sphere or file of "
          "a mesh were left out, so these bodies collide with less or nothing:" +
          no_shapes_);
    }
    if (num_losses_ == 0) return;
    robot_.notes.push_back(text("damping, frictionloss and armature of ", num_losses_,
                                " joints are ignored: the simulated drives have their own, "
                                "actuators.rotor"));
  }

  const std::string& path_;
  MjcfRobot robot_;
  std::vector<std::string> warnings_;  // MuJoCo's
  std::string no_shapes_;              // bodies that lost one, a space before each
  int num_losses_ = 0;
};

}  // namespace

int line_of(const mjString* info) {
  const std::string_view words = mjs_getString(info);
  constexpr std::string_view kLine = "line ";
  const std::size_t found = words.find(kLine);
  if (found == std::string_view::npos) return 1;
  return std::atoi(words.data() + found + kLine.size());
}

MjcfRobot read_mjcf(const std::string& path) { return MjcfReader(path).read(); }

}  // namespace surefoot::simulation
