#include "surefoot/config/terrain_section.hpp"

#include "surefoot/config/nearest_name.hpp"
#include "surefoot/math/rotation.hpp"
#include "surefoot/simulation/random.hpp"
#include "surefoot/simulation/terrain_generators.hpp"

#include <algorithm>

namespace surefoot {
namespace {

constexpr double kFloorDepth = 1.0;  // of the boxes that make steps, below the lowest ground [m]
constexpr double kPlatform = 20.0;   // length of the level ground at both ends, and width [m]

using Elements = std::vector<TerrainElement>;

void read_friction(Section& section, double& friction) {
  section.number("friction", friction, kNotNegative);
}

void read_plane(Section& section, Elements& elements) {
  TerrainLevel plane;
  section.vector("position", plane.position);
  section.vector("rpy", plane.rpy);
  read_friction(section, plane.friction);
  elements.push_back(plane);
}

void read_size(Section& section, Vec3& size) {
  section.vector("size", size);
  if (size.minCoeff() <= 0.0) section.fail("size", "must be above 0 along every axis");
}

void read_box(Section& section, Elements& elements) {
  TerrainBox box;
  section.require("size");
  section.vector("position", box.position);
  read_size(section, box.size);
  section.vector("rpy", box.rpy);
  read_friction(section, box.friction);
  elements.push_back(box);
}

/// Heights of its own, or the amplitude of generated ones.
void check_heights(Section& section, const TerrainHeightField& field) {
  const bool has_heights = section.node("heights") != nullptr;
  if (has_heights == (section.node("amplitude") != nullptr)) {
    section.fail("heights",
                 "a height field has either heights, with columns and rows, or the "
                 "amplitude of generated ones");
  }
  if (!has_heights) return;
  for (const char* key : {"columns", "rows"}) section.require(key);
  const long points = long{field.columns} * field.rows;
  if (static_cast<long>(field.heights.size()) == points) return;
  section.fail("heights", std::to_string(field.heights.size()) +
                              " numbers are not columns × rows = " + std::to_string(points));
}

void read_field(Section& section, Elements& elements) {
  TerrainHeightField field;
  section.require("size_x");
  section.require("size_y");
  section.vector("position", field.position);
  section.number("size_x", field.size_x, kPositive);
  section.number("size_y", field.size_y, kPositive);
  section.integer("columns", field.columns, 0);
  section.integer("rows", field.rows, 0);
  section.numbers("heights", field.heights);
  section.number("amplitude", field.amplitude, kNotNegative);
  section.number("wavelength", field.wavelength, kPositive);
  section.integer("seed", field.seed);
  read_friction(section, field.friction);
  check_heights(section, field);
  elements.push_back(field);
}

void read_random_boxes(Section& section, Elements& elements) {
  TerrainRandomBoxes boxes;
  for (const char* key : {"size_x", "size_y", "max_height"}) section.require(key);
  section.vector("position", boxes.position);
  section.number("size_x", boxes.size_x, kPositive);
  section.number("size_y", boxes.size_y, kPositive);
  section.number("cell", boxes.cell, kPositive);
  section.number("max_height", boxes.max_height, kNotNegative);
  section.integer("seed", boxes.seed);
  read_friction(section, boxes.friction);
  elements.push_back(boxes);
}

struct FrictionTiles {
  Vec3 position = Vec3::Zero();       ///< centre of the field, at the height of its top [m]
  double size_x = 2.0, size_y = 2.0;  ///< [m]
  double tile = 0.5;                  ///< edge of a tile [m]
  double friction_min = 0.4, friction_max = 1.0;
  std::uint64_t seed = 0;
};

/// Level tiles, each with a friction of its own, uniform in its range and the same for a seed.
void add_friction_tiles(const FrictionTiles& field, Elements& elements) {
  const TerrainRandomBoxes level{.position = field.position,
                                 .size_x = field.size_x,
                                 .size_y = field.size_y,
                                 .cell = field.tile,
                                 .max_height = 0.0};
  simulation::Random random(field.seed);
  for (TerrainBox box : simulation::random_boxes(level)) {
    box.friction =
        field.friction_min + (field.friction_max - field.friction_min) * random.uniform();
    elements.push_back(box);
  }
}

void read_friction_tiles(Section& section, Elements& elements) {
  constexpr double kMostTiles = 2000.0;
  FrictionTiles tiles;
  for (const char* key : {"size_x", "size_y", "friction_min", "friction_max"}) section.require(key);
  section.vector("position", tiles.position);
  section.number("size_x", tiles.size_x, kPositive);
  section.number("size_y", tiles.size_y, kPositive);
  section.number("tile", tiles.tile, kPositive);
  section.number("friction_min", tiles.friction_min, kNotNegative);
  section.number("friction_max", tiles.friction_max, kNotNegative);
  section.integer("seed", tiles.seed);
  section.require_order("friction_min", tiles.friction_min, "friction_max", tiles.friction_max);
  if (tiles.size_x / tiles.tile * (tiles.size_y / tiles.tile) > kMostTiles)
    section.fail("tile", "makes more than 2000 tiles of this field; larger ones would be valid");
  add_friction_tiles(tiles, elements);
}

struct Steps {
  double edge = 0.5;      ///< x of the first edge [m]
  double height = -0.14;  ///< of one step: below 0 down, above 0 up [m]
  int count = 1;
  double tread = 0.35;  ///< length of one step [m]
  double friction = -1.0;
};

/// Level ground z = 0 up to the edge, then the steps, then level ground again, all as boxes.
void add_steps(const Steps& steps, Elements& elements) {
  const double bottom = std::min(0.0, steps.height * steps.count) - kFloorDepth;
  for (int i = 0; i <= steps.count; ++i) {
    const double begin = i == 0 ? steps.edge - kPlatform : steps.edge + (i - 1) * steps.tread;
    const double end = i == steps.count ? begin + kPlatform : steps.edge + i * steps.tread;
    const double top = steps.height * i;
    elements.push_back(TerrainBox{.position = {(begin + end) / 2.0, 0.0, (bottom + top) / 2.0},
                                  .size = {end - begin, kPlatform, top - bottom},
                                  .rpy = Vec3::Zero(),
                                  .friction = steps.friction});
  }
}

constexpr int kMostSteps = 1000;

void read_steps(Section& section, Elements& elements) {
  Steps steps;
  section.require("height");
  section.number("edge", steps.edge);
  section.number("height", steps.height);
  section.integer("count", steps.count, 1, kMostSteps);
  section.number("tread", steps.tread, kPositive);
  read_friction(section, steps.friction);
  add_steps(steps, elements);
}

struct Slope {
  double start = 0.5;    ///< x where it begins [m]
  double pitch = 0.0;    ///< rises ahead where above 0 [rad]
  double roll = 0.0;     ///< rises to the left where above 0 [rad]
  double incline = 0.0;  ///< instead of both: the slope's angle …
  double uphill = 0.0;   ///< … and where it rises to, from x to the left [rad]
  double friction = -1.0;

  [[nodiscard]] Vec3 rpy() const {
    if (incline == 0.0) return {roll, -pitch, 0.0};
    const Mat3 R_uphill = rotation_about_z(uphill);
    const Mat3 R_incline = Eigen::AngleAxisd(-incline, Vec3::UnitY()).toRotationMatrix();
    return roll_pitch_yaw(R_uphill * R_incline * R_uphill.transpose());
  }
};

/// Level ground z = 0 up to the start, then a plane through (start, 0, 0), both as boxes.
void add_slope(const Slope& slope, Elements& elements) {
  const Vec3 size(kPlatform, kPlatform, kFloorDepth);
  const Vec3 rpy = slope.rpy();
  const Vec3 level(slope.start - kPlatform / 2.0, 0.0, -kFloorDepth / 2.0);
  const Vec3 tilted = Vec3(slope.start, 0.0, 0.0) +
                      from_roll_pitch_yaw(rpy) * Vec3(kPlatform / 2.0, 0.0, -kFloorDepth / 2.0);
  elements.push_back(TerrainBox{level, size, Vec3::Zero(), slope.friction});
  elements.push_back(TerrainBox{tilted, size, rpy, slope.friction});
}

void read_slope(Section& section, Elements& elements) {
  constexpr NumberRange kAngle{.min = -1.2, .max = 1.2, .words = "an angle from -1.2 to 1.2 rad"};
  Slope slope;
  section.number("start", slope.start);
  section.number("pitch", slope.pitch, kAngle);
  section.number("roll", slope.roll, kAngle);
  section.number("incline", slope.incline, kAngle);
  section.number("uphill", slope.uphill);
  const bool by_axes = section.node("pitch") != nullptr || section.node("roll") != nullptr;
  const bool by_direction = section.node("incline") != nullptr;
  if (by_axes == by_direction)
    section.fail("pitch", "a slope has a pitch, a roll or both; or instead of them an incline");
  read_friction(section, slope.friction);
  add_slope(slope, elements);
}

/// An element without a shape is one that `elements` does not have: a new one, or one misspelt.
void require_shape(const std::string& name, Section& elements, Section& element) {
  if (element.node("shape") != nullptr) return;
  std::vector<std::string> others = elements.keys();
  std::erase_if(others, [&](const std::string& one) {
    return one == name || elements.node(one.c_str())->kind == ConfigNode::Kind::null;
  });
  const std::string new_one = "this key is missing, and \"" + name + "\" is a new element";
  element.fail("shape", others.empty() ? new_one : new_one + "; " + valid_names(name, others));
}

void read_element(Section& section, Elements& elements) {
  using Reader = void (*)(Section&, Elements&);
  Reader reader = [](Section&, Elements&) {};
  section.choice<Reader>("shape", reader,
                         {{"plane", read_plane},
                          {"box", read_box},
                          {"height_field", read_field},
                          {"random_boxes", read_random_boxes},
                          {"friction_tiles", read_friction_tiles},
                          {"steps", read_steps},
                          {"slope", read_slope}});
  reader(section, elements);
}

}  // namespace

void read_terrain(Section& section, TerrainOptions& terrain) {
  section.number("friction", terrain.friction, kNotNegative);
  section.section("elements", [&](Section& elements) {
    for (const std::string& name : elements.keys()) {
      // An element of the base file is taken away by `name:` with nothing behind it.
      if (elements.node(name.c_str())->kind == ConfigNode::Kind::null) continue;
      elements.section(name.c_str(), [&](Section& s) {
        require_shape(name, elements, s);
        read_element(s, terrain.elements);
      });
    }
  });
  if (terrain.elements.empty()) terrain.elements.emplace_back(TerrainLevel{});
}

}  // namespace surefoot
