#include "surefoot/simulation/starting_posture.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/base/formatted.hpp"
#include "surefoot/simulation/text.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

namespace surefoot::simulation {
namespace {

constexpr double kMinOverlap = 1e-4;     // [m]
constexpr double kAngleRounding = 1e-6;  // [rad]

std::string link_of(const mjModel& model, int geom) {
  return mj_id2name(&model, mjOBJ_BODY, model.geom_bodyid[geom]);
}

std::string millimetres(double length) { return formatted("%.1f mm", 1e3 * length); }

void check_stops(const mjModel& model, const mjData& data, const RobotParts& parts,
                 const std::string& urdf) {
  for (const int dof : parts.dof) {
    const int joint = model.dof_jntid[dof];
    const double* range = model.jnt_range + 2 * joint;
    const double q = data.qpos[model.jnt_qposadr[joint]];
    const bool beyond = q < range[0] - kAngleRounding || q > range[1] + kAngleRounding;
    if (model.jnt_limited[joint] == 0 || !beyond) continue;
    throw Error(urdf + formatted(": joint \"%s\" would begin at %.3f rad, beyond its stops in the "
                                 "URDF, %.3f to %.3f rad",
                                 mj_id2name(&model, mjOBJ_JOINT, joint), q, range[0], range[1]));
  }
}

bool is_of_robot(const RobotParts& parts, int geom) {
  return parts.owner[static_cast<std::size_t>(geom)].part != Part::terrain;
}

/// Finds shapes of the robot inside each other.
void check_overlap(const mjModel& model, const mjData& data, const RobotParts& parts,
                   const std::string& urdf) {
  const mjContact* deepest = nullptr;
  std::set<std::pair<int, int>> pairs;
  for (int id = 0; id < data.ncon; ++id) {
    const mjContact& contact = data.contact[id];
    if (!is_of_robot(parts, contact.geom[0]) || !is_of_robot(parts, contact.geom[1])) continue;
    if (contact.dist > -kMinOverlap) continue;
    pairs.insert(
        std::minmax(model.geom_bodyid[contact.geom[0]], model.geom_bodyid[contact.geom[1]]));
    if (deepest == nullptr || contact.dist < deepest->dist) deepest = &contact;
  }
  if (deepest == nullptr) return;
  const std::string others =
      pairs.size() == 1 ? "" : text(" (and ", pairs.size() - 1, " more pairs of links)");
  throw Error(
      text(urdf, ": in the starting posture the collision shapes of links \"",
           link_of(model, deepest->geom[0]), "\" and \"", link_of(model, deepest->geom[1]),
           "\" overlap by ", millimetres(-deepest->dist), others,
           "; make them smaller, leave one out, or change the stance, or the posture of the "
           "arm they belong to"));
}

/// Lowest z of a mesh's vertices relative to its position; `up` is e_z in the mesh's frame.
double lowest_vertex(const mjModel& model, int mesh, const Vec3& up) {
  double lowest = std::numeric_limits<double>::infinity();
  const float* vertices = model.mesh_vert + 3 * model.mesh_vertadr[mesh];
  for (int i = 0; i < model.mesh_vertnum[mesh]; ++i) {
    const Vec3 vertex(vertices[3 * i], vertices[3 * i + 1], vertices[3 * i + 2]);
    lowest = std::min(lowest, up.dot(vertex));
  }
  return lowest;
}

/// z of a shape's lowest point in S; NaN for shapes that a URDF can't have.
double lowest_point(const mjModel& model, const mjData& data, int geom) {
  const Vec3 up(data.geom_xmat + 9 * geom + 6);  // e_z of S in the shape's frame
  const Vec3 size(model.geom_size + 3 * geom);
  const double center = data.geom_xpos[3 * geom + 2];
  switch (model.geom_type[geom]) {
    case mjGEOM_SPHERE:
      return center - size.x();
    case mjGEOM_CAPSULE:
      return center - size.x() - std::abs(up.z()) * size.y();
    case mjGEOM_CYLINDER:
      return center - size.x() * up.head<2>().norm() - std::abs(up.z()) * size.y();
    case mjGEOM_BOX:
      return center - up.cwiseAbs().dot(size);
    case mjGEOM_MESH:
      return center + lowest_vertex(model, model.geom_dataid[geom], up);
    default:
      return std::numeric_limits<double>::quiet_NaN();
  }
}

/// Is the torso above the feet? Otherwise the robot lies, and its feet need not be lowest.
bool stands(const mjModel& model, const mjData& data, const RobotParts& parts) {
  double torso = std::numeric_limits<double>::infinity(), feet = -torso, radius = 0.0;
  for (int geom = 0; geom < model.ngeom; ++geom) {
    const Part part = parts.owner[static_cast<std::size_t>(geom)].part;
    if (part == Part::torso) torso = std::min(torso, lowest_point(model, data, geom));
  }
  for (const int geom : parts.foot_geom) {
    feet = std::max(feet, lowest_point(model, data, geom));
    radius = model.geom_size[3 * geom];
  }
  return torso > feet + radius;
}

/// A shape below the foot sphere would stand on the ground in its place, without a foot contact.
void check_feet(const mjModel& model, const mjData& data, const RobotParts& parts,
                const std::string& urdf) {
  if (!stands(model, data, parts)) return;
  for (int geom = 0; geom < model.ngeom; ++geom) {
    const GeomOwner& owner = parts.owner[static_cast<std::size_t>(geom)];
    if (owner.part != Part::leg) continue;
    const int sphere = parts.foot_geom[static_cast<std::size_t>(owner.leg)];
    const double depth = lowest_point(model, data, sphere) - lowest_point(model, data, geom);
    if (depth < kMinOverlap) continue;
    throw Error(text(
        urdf, ": in the starting posture a collision shape of link \"", link_of(model, geom),
        "\" reaches ", millimetres(depth), " below the foot sphere of ",
        leg_names(static_cast<int>(parts.foot_geom.size()))[static_cast<std::size_t>(owner.leg)],
        ", which would never touch the ground; foot.radius and foot.center must "
        "enclose what the foot stands on"));
  }
}

}  // namespace

void check_starting_posture(const mjModel& model, const mjData& data, const RobotParts& parts,
                            const std::string& urdf) {
  check_stops(model, data, parts, urdf);
  check_overlap(model, data, parts, urdf);
  check_feet(model, data, parts, urdf);
}

}  // namespace surefoot::simulation
