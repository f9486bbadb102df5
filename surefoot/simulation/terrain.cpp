#include "surefoot/simulation/terrain.hpp"

#include "surefoot/math/rotation.hpp"
#include "surefoot/simulation/terrain_generators.hpp"
#include "surefoot/simulation/text.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::simulation {

namespace {

constexpr double kRayStart = 1000.0;          // above any terrain [m]
constexpr double kFieldThickness = 0.5;       // of a height field below its lowest point [m]
constexpr double kFlatFieldElevation = 1e-3;  // MuJoCo needs a positive height range [m]
constexpr int kRings = 24;                    // samples of the terrain under a sphere
constexpr int kRays = 32;

class TerrainWriter {
 public:
  TerrainWriter(mjSpec& spec, const TerrainOptions& terrain, const ContactOptions& contact)
      : spec_(spec),
        world_(mjs_findBody(&spec, "world")),
        friction_(terrain.friction),
        contact_(contact) {}

  void operator()(const TerrainLevel& plane) {
    mjsGeom* geom = add_geom(mjGEOM_PLANE, plane.position, plane.rpy, plane.friction);
    geom->size[0] = geom->size[1] = 0.0;  // infinite
    geom->size[2] = 1.0;
  }

  void operator()(const TerrainBox& box) {
    mjsGeom* geom = add_geom(mjGEOM_BOX, box.position, box.rpy, box.friction);
    for (int i = 0; i < 3; ++i) geom->size[i] = 0.5 * box.size[i];
  }

  void operator()(const TerrainRandomBoxes& field) {
    for (const TerrainBox& box : random_boxes(field)) (*this)(box);
  }

  void operator()(const TerrainHeightField& given) {
    const TerrainHeightField field = with_heights(given);
    const auto [lowest, highest] = std::minmax_element(field.heights.begin(), field.heights.end());
    const double range = *highest - *lowest;
    std::vector<float> elevations;
    for (const double height : field.heights) {
      elevations.push_back(range > 0.0 ? static_cast<float>((height - *lowest) / range) : 0.0F);
    }
    const std::string name = text("height_field_", ++num_fields_);
    mjsHField* asset = mjs_addHField(&spec_);
    mjs_setName(asset->element, name.c_str());
    asset->nrow = field.rows;
    asset->ncol = field.columns;
    asset->size[0] = 0.5 * field.size_x;
    asset->size[1] = 0.5 * field.size_y;
    asset->size[2] = range > 0.0 ? range : kFlatFieldElevation;
    asset->size[3] = kFieldThickness;
    mjs_setFloat(asset->userdata, elevations.data(), static_cast<int>(elevations.size()));

    mjsGeom* geom = add_geom(mjGEOM_HFIELD, field.position + Vec3(0.0, 0.0, *lowest), Vec3::Zero(),
                             field.friction);
    mjs_setString(geom->hfieldname, name.c_str());
  }

 private:
  mjsGeom* add_geom(mjtGeom type, const Vec3& position, const Vec3& rpy, double friction) {
    mjsGeom* geom = mjs_addGeom(world_, nullptr);
    mjs_setName(geom->element, text("terrain_", ++num_geoms_).c_str());
    const Quat orientation = from_roll_pitch_yaw(rpy);
    geom->type = type;
    for (int i = 0; i < 3; ++i) geom->pos[i] = position[i];
    geom->quat[0] = orientation.w();
    geom->quat[1] = orientation.x();
    geom->quat[2] = orientation.y();
    geom->quat[3] = orientation.z();
    geom->group = kTerrainGroup;
    set_contact(*geom, friction);
    geom->rgba[0] = geom->rgba[1] = geom->rgba[2] = 0.55F;
    return geom;
  }

  void set_contact(mjsGeom& geom, double friction) const {
    geom.priority = 1;
    geom.condim = 3;
    geom.friction[0] = friction < 0.0 ? friction_ : friction;
    geom.solref[0] = contact_.solref_time;
    geom.solref[1] = contact_.solref_damping;
    geom.solimp[0] = contact_.solimp_min;
    geom.solimp[1] = contact_.solimp_max;
    geom.solimp[2] = contact_.solimp_width;
    // Only the robot's shapes test for collisions with the terrain.
    geom.contype = 1;
    geom.conaffinity = 0;
  }

  mjSpec& spec_;
  mjsBody* world_;
  double friction_;
  ContactOptions contact_;
  int num_geoms_ = 0;
  int num_fields_ = 0;
};

}  // namespace

void add_terrain(mjSpec& spec, const TerrainOptions& terrain, const ContactOptions& contact) {
  TerrainWriter writer(spec, terrain, contact);
  if (terrain.elements.empty()) writer(TerrainLevel{});
  for (const TerrainElement& element : terrain.elements) std::visit(writer, element);
}

double terrain_height(const mjModel& model, const mjData& data, double x, double y) {
  const mjtNum start[3] = {x, y, kRayStart};
  const mjtNum down[3] = {0.0, 0.0, -1.0};
  mjtByte groups[mjNGROUP] = {};
  groups[kTerrainGroup] = 1;
  int geom = -1;
  const double distance = mj_ray(&model, &data, start, down, groups, 1, -1, &geom, nullptr);
  return geom < 0 ? kNaN : kRayStart - distance;
}

double resting_height(const mjModel& model, const mjData& data, double x, double y, double radius) {
  double highest = -std::numeric_limits<double>::infinity();
  for (int ring = 0; ring <= kRings; ++ring) {
    const double distance = radius * ring / kRings;
    const double above = std::sqrt(std::max(0.0, radius * radius - distance * distance));
    for (int ray = 0; ray < (ring == 0 ? 1 : kRays); ++ray) {
      const double angle = 2.0 * kPi * ray / kRays;
      const double ground = terrain_height(model, data, x + distance * std::cos(angle),
                                           y + distance * std::sin(angle));
      if (!std::isnan(ground)) highest = std::max(highest, ground + above);
    }
  }
  return std::isinf(highest) ? kNaN : highest;
}

}  // namespace surefoot::simulation
