#include "surefoot/simulation/mjcf_urdf.hpp"

#include "surefoot/base/formatted.hpp"
#include "surefoot/math/rotation.hpp"
#include "surefoot/simulation/mjcf_robot.hpp"
#include "surefoot/simulation/text.hpp"
#include "surefoot/simulation/urdf_spec.hpp"

#include <cmath>
#include <filesystem>
#include <set>
#include <sstream>

namespace surefoot::simulation {
namespace {

constexpr int kLastVisibleGroup = 2;  // of geoms, in MuJoCo's viewers

struct Pose {
  Mat3 R = Mat3::Identity();
  Vec3 p = Vec3::Zero();
  [[nodiscard]] Pose operator*(const Pose& other) const { return {R * other.R, R * other.p + p}; }
  [[nodiscard]] Pose inverse() const { return {R.transpose(), -(R.transpose() * p)}; }
};

Mat3 rotation(const double* quat) {
  return Quat(quat[0], quat[1], quat[2], quat[3]).normalized().toRotationMatrix();
}

Pose pose(const double* pos, const double* quat) { return {rotation(quat), Vec3(pos)}; }

/// Roll, pitch and yaw that give R to rounding also where the pitch is ±90°.
Vec3 exact_roll_pitch_yaw(const Mat3& R) {
  const double yaw = std::atan2(R(1, 0), R(0, 0)), c = std::cos(yaw), s = std::sin(yaw);
  return {std::atan2(s * R(0, 2) - c * R(1, 2), c * R(1, 1) - s * R(0, 1)),
          std::atan2(-R(2, 0), c * R(0, 0) + s * R(1, 0)), yaw};
}

std::string exact(double value) { return formatted("%.17g", value); }

std::string exact(const Vec3& v) { return exact(v.x()) + " " + exact(v.y()) + " " + exact(v.z()); }

/// In XML, between quotes.
std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '&') {
      result += "&amp;";
    } else if (c == '<') {
      result += "&lt;";
    } else if (c == '"') {
      result += "&quot;";
    } else {
      result += c;
    }
  }
  return result + "\"";
}

std::string origin(const Pose& pose) {
  return "<origin xyz=\"" + exact(pose.p) + "\" rpy=\"" + exact(exact_roll_pitch_yaw(pose.R)) +
         "\"/>";
}

class MjcfWriter {
 public:
  MjcfWriter(const MjcfRobot& robot, const std::string& folder)
      : robot_(robot), model_(*robot.model), folder_(folder) {}

  std::string write() {
    out_ << "<robot name=" << quoted(mjs_getString(robot_.spec->modelname)) << ">\n";
    for (const std::string& note : robot_.notes) out_ << "<note text=" << quoted(note) << "/>\n";
    for (const mjsBody* body : subtree(*robot_.base)) links_.insert(name_of(body->element));
    for (const mjsBody* body : subtree(*robot_.base)) write_body(*body);
    out_ << "</robot>\n";
    return out_.str();
  }

 private:
  void write_body(const mjsBody& body) {
    const int id = mjs_getId(body.element);
    // The link's frame has the joint at its origin.
    const Pose in_link = &body == robot_.base ? Pose() : write_joint(body, id);
    offsets_[id] = in_link;
    out_ << "<link name=" << quoted(name_of(body.element)) << " line=\"" << line_of(body.info)
         << "\">\n";
    write_inertia(id, in_link);
    each<mjsGeom>(body, mjOBJ_GEOM, mjs_asGeom,
                  [&](const mjsGeom& geom) { write_geom(geom, in_link); });
    out_ << "</link>\n";
    each<mjsGeom>(body, mjOBJ_GEOM, mjs_asGeom, [&](const mjsGeom& geom) {
      const bool is_sphere = geom.type == mjGEOM_SPHERE && !robot_.looks.at(&geom).is_mesh;
      if (is_sphere) write_frame(geom, body, in_link, model_.geom_pos, model_.geom_quat);
    });
    each<mjsSite>(body, mjOBJ_SITE, mjs_asSite, [&](const mjsSite& site) {
      write_frame(site, body, in_link, model_.site_pos, model_.site_quat);
    });
  }

  template <typename Element, typename As, typename Do>
  static void each(const mjsBody& body, mjtObj type, const As& as, const Do& act) {
    for (mjsElement* child = mjs_firstChild(&body, type, 0); child != nullptr;
         child = mjs_nextChild(&body, child, 0))
      act(static_cast<const Element&>(*as(child)));
  }

  /// An empty link at a named geom or site.
  template <typename Element>
  void write_frame(const Element& element, const mjsBody& body, const Pose& in_link,
                   const double* positions, const double* quaternions) {
    const std::string frame = name_of(element.element);
    if (frame.empty() || !links_.insert(frame).second) return;
    const int id = mjs_getId(element.element);
    const std::string line = text(" line=\"", line_of(element.info), "\"");
    out_ << "<link name=" << quoted(frame) << line << "/>\n<joint name=" << quoted(frame + "_fixed")
         << " type=\"fixed\"" << line << "><parent link=" << quoted(name_of(body.element))
         << "/><child link=" << quoted(frame) << "/>"
         << origin(in_link * pose(positions + 3 * id, quaternions + 4 * id)) << "</joint>\n";
  }

  /// Returns the body's frame in the link's.
  Pose write_joint(const mjsBody& body, int id) {
    const mjsBody& parent = *mjs_getParent(body.element);
    Pose in_parent = offsets_.at(mjs_getId(parent.element)) *
                     pose(model_.body_pos + 3 * id, model_.body_quat + 4 * id);
    Pose in_link;
    const int joint = model_.body_jntnum[id] == 0 ? -1 : model_.body_jntadr[id];
    if (joint >= 0 && model_.jnt_type[joint] == mjJNT_HINGE) {
      const Vec3 anchor(model_.jnt_pos + 3 * joint), axis(model_.jnt_axis + 3 * joint);
      const double reference = model_.qpos0[model_.jnt_qposadr[joint]];
      const Mat3 turned = exp_rotation(-reference * axis).toRotationMatrix();
      in_parent = in_parent * Pose{.R = turned, .p = anchor};
      in_link.p = -anchor;
    }
    const mjsElement* element = mjs_firstChild(&body, mjOBJ_JOINT, 0);
    const std::string joint_name =
        joint < 0 ? name_of(body.element) + "_fixed" : name_of(const_cast<mjsElement*>(element));
    const int line =
        line_of(joint < 0 ? body.info : mjs_asJoint(const_cast<mjsElement*>(element))->info);
    out_ << "<joint name=" << quoted(joint_name) << " type=\"" << type_of(joint) << "\" line=\""
         << line << "\"><parent link=" << quoted(name_of(parent.element))
         << "/><child link=" << quoted(name_of(body.element)) << "/>" << origin(in_parent);
    if (joint >= 0) write_limits(joint, joint_name);
    out_ << "</joint>\n";
    return in_link;
  }

  [[nodiscard]] const char* type_of(int joint) const {
    if (joint < 0) return "fixed";
    if (model_.jnt_type[joint] == mjJNT_SLIDE) return "prismatic";
    if (model_.jnt_type[joint] == mjJNT_BALL) return "ball";
    return model_.jnt_limited[joint] != 0 ? "revolute" : "continuous";
  }

  void write_limits(int joint, const std::string& joint_name) {
    out_ << "<axis xyz=\"" << exact(Vec3(model_.jnt_axis + 3 * joint)) << "\"/><limit";
    if (model_.jnt_limited[joint] != 0) {
      out_ << " lower=\"" << exact(model_.jnt_range[2 * joint]) << "\" upper=\""
           << exact(model_.jnt_range[2 * joint + 1]) << "\"";
    }
    const auto effort = robot_.effort.find(joint_name);
    if (effort != robot_.effort.end()) out_ << " effort=\"" << exact(effort->second) << "\"";
    out_ << "/>";
  }

  void write_inertia(int id, const Pose& in_link) {
    if (model_.body_mass[id] == 0.0) return;
    const Pose principal = in_link * pose(model_.body_ipos + 3 * id, model_.body_iquat + 4 * id);
    const Mat3 tensor =
        principal.R * Vec3(model_.body_inertia + 3 * id).asDiagonal() * principal.R.transpose();
    out_ << "<inertial><origin xyz=\"" << exact(principal.p) << "\"/><mass value=\""
         << exact(model_.body_mass[id]) << "\"/><inertia";
    constexpr const char* kAxes = "xyz";
    for (int i = 0; i < 3; ++i) {
      for (int j = i; j < 3; ++j)
        out_ << " i" << kAxes[i] << kAxes[j] << "=\"" << exact(tensor(i, j)) << "\"";
    }
    out_ << "/></inertial>\n";
  }

  void write_geom(const mjsGeom& geom, const Pose& in_link) {
    const std::string shape = shape_of(geom);
    if (shape.empty()) return;
    const std::string body = origin(in_link * pose_of(geom)) + "<geometry>" + shape + "</geometry>";
    if (geom.contype != 0 || geom.conaffinity != 0)
      out_ << "<collision line=\"" << line_of(geom.info) << "\">" << body << "</collision>\n";
    if (geom.group > kLastVisibleGroup) return;
    const std::array<float, 4>& c = robot_.looks.at(&geom).rgba;
    const std::string rgba =
        formatted("%g %g %g %g", double{c[0]}, double{c[1]}, double{c[2]}, double{c[3]});
    out_ << "<visual>" << body << "<material name=\"" << rgba << "\"><color rgba=\"" << rgba
         << "\"/></material></visual>\n";
  }

  /// MuJoCo moves the frame of a mesh that it has read to the mesh's principal axes.
  [[nodiscard]] Pose pose_of(const mjsGeom& geom) const {
    const int id = mjs_getId(geom.element);
    const Pose compiled = pose(model_.geom_pos + 3 * id, model_.geom_quat + 4 * id);
    const int mesh = model_.geom_dataid[id];
    if (model_.geom_type[id] != mjGEOM_MESH) return compiled;
    return compiled * pose(model_.mesh_pos + 3 * mesh, model_.mesh_quat + 4 * mesh).inverse();
  }

  [[nodiscard]] std::string shape_of(const mjsGeom& geom) const {
    const MjcfLook& look = robot_.looks.at(&geom);
    if (look.is_mesh && look.mesh.empty()) return "";
    if (look.is_mesh)
      return "<mesh filename=" + quoted(uri(look.mesh)) + " scale=\"" + exact(look.scale) + "\"/>";
    const int id = mjs_getId(geom.element);
    const double* size = model_.geom_size + 3 * id;
    const std::string radius = " radius=\"" + exact(size[0]) + "\"";
    const std::string length = " length=\"" + exact(2.0 * size[1]) + "\"";
    switch (model_.geom_type[id]) {
      case mjGEOM_SPHERE:
        return "<sphere" + radius + "/>";
      case mjGEOM_CAPSULE:
        return "<capsule" + radius + length + "/>";
      case mjGEOM_CYLINDER:
        return "<cylinder" + radius + length + "/>";
      case mjGEOM_BOX:
        return "<box size=\"" + exact(2.0 * Vec3(size)) + "\"/>";
      default:
        return "";
    }
  }

  [[nodiscard]] std::string uri(const std::string& mesh) const {
    if (folder_.empty() || std::filesystem::path(mesh).is_absolute()) return mesh;
    const std::size_t behind = folder_.find("://") + 3;
    return folder_.substr(0, behind) +
           (std::filesystem::path(folder_.substr(behind)) / mesh).lexically_normal().string();
  }

  const MjcfRobot& robot_;
  const mjModel& model_;
  const std::string& folder_;
  std::ostringstream out_;
  std::set<std::string> links_;  // names so far
  std::map<int, Pose> offsets_;  // of bodies in their links, by id
};

}  // namespace

std::string urdf_of_mjcf(const std::string& path, const std::string& folder) {
  const MjcfRobot robot = read_mjcf(path);
  return MjcfWriter(robot, folder).write();
}

}  // namespace surefoot::simulation
