#include "surefoot/config/terrain_fields.hpp"

#include "surefoot/math/rotation.hpp"
#include "surefoot/simulation/plant_elements.hpp"
#include "surefoot/simulation/random.hpp"
#include "surefoot/simulation/terrain_generators.hpp"

#include <algorithm>

namespace surefoot::config {
namespace {

constexpr double kFloorDepth = 1.0;  // of boxes below the lowest ground [m]
constexpr double kPlatform = 20.0;   // length of the level ground at both ends, and width [m]
constexpr double kMostTiles = 2000.0;
constexpr NumberRange kAngle{.min = -1.2, .max = 1.2, .words = "an angle from -1.2 to 1.2 rad"};

using Elements = std::vector<simulation::TerrainElement>;

Field friction_of(double& friction) {
  return {"friction", &friction, kNotNegative, "", "coefficient; without it that of the terrain"};
}

/// A height field has either heights or the amplitude of generated ones.
void check_heights(const simulation::TerrainHeightField& field, const Given& given) {
  const bool has_heights = given.has("heights");
  if (has_heights == given.has("amplitude")) {
    given.fail("heights",
               "a height field has either heights, with columns and rows, or the "
               "amplitude of generated ones");
  }
  const long points = long{field.columns} * field.rows;
  if (has_heights && static_cast<long>(field.heights.size()) != points) {
    given.fail("heights", std::to_string(field.heights.size()) +
                              " numbers are not columns × rows = " + std::to_string(points));
  }
  for (const char* key : {"columns", "rows"}) {
    if (has_heights && !given.has(key)) given.fail(key, "this key is missing");
  }
}

struct FrictionTiles {
  Vec3 position = Vec3::Zero();
  double size_x = 2.0, size_y = 2.0, tile = 0.5;
  double friction_min = 0.4, friction_max = 1.0;
  std::uint64_t seed = 0;
};

Group fields(FrictionTiles& o) {
  return Group{
      {"position", Numbers{o.position.data(), simulation::axis_elements()}, kAnyNumber, "m",
       "centre of the field, at the height of its top"},
      Field{"size_x", &o.size_x, kPositive, "m", "extent"}.required(),
      Field{"size_y", &o.size_y, kPositive, "m", "extent"}.required(),
      {"tile", &o.tile, kPositive, "m", "edge of a tile"},
      Field{"friction_min", &o.friction_min, kNotNegative, "", "lowest of a tile"}.required(),
      Field{"friction_max", &o.friction_max, kNotNegative, "", "highest of a tile"}.required(),
      {"seed", &o.seed, "of the tiles' frictions"}}
      .with([&o](const Given& given) {
        given.require_order("friction_min", o.friction_min, "friction_max", o.friction_max);
        if (o.size_x / o.tile * (o.size_y / o.tile) > kMostTiles)
          given.fail("tile",
                     "makes more than 2000 tiles of this field; larger ones would be valid");
      });
}

/// Level tiles, each with a random friction, uniform in the range and determined by the seed.
void add_friction_tiles(const FrictionTiles& field, Elements& elements) {
  const simulation::TerrainRandomBoxes level{.position = field.position,
                                             .size_x = field.size_x,
                                             .size_y = field.size_y,
                                             .cell = field.tile,
                                             .max_height = 0.0};
  simulation::Random random(field.seed);
  for (simulation::TerrainBox box : simulation::random_boxes(level)) {
    box.friction =
        field.friction_min + (field.friction_max - field.friction_min) * random.uniform();
    elements.push_back(box);
  }
}

struct Steps {
  double edge = 0.5, height = -0.14, tread = 0.35;
  int count = 1;
  double friction = -1.0;
};

Group fields(Steps& o) {
  return {{"edge", &o.edge, kAnyNumber, "m", "x of the first edge"},
          Field{"height", &o.height, kAnyNumber, "m", "of one step; below 0 down, above 0 up"}
              .required(),
          {"count", &o.count, {.min = 1, .max = 1000}, "", "number of steps"},
          {"tread", &o.tread, kPositive, "m", "length of one step"},
          friction_of(o.friction)};
}

/// Level ground z = 0 up to the edge, then the steps, then level ground again, all as boxes.
void add_steps(const Steps& steps, Elements& elements) {
  const double bottom = std::min(0.0, steps.height * steps.count) - kFloorDepth;
  for (int i = 0; i <= steps.count; ++i) {
    const double begin = i == 0 ? steps.edge - kPlatform : steps.edge + (i - 1) * steps.tread;
    const double end = i == steps.count ? begin + kPlatform : steps.edge + i * steps.tread;
    const double top = steps.height * i;
    elements.push_back(
        simulation::TerrainBox{.position = {(begin + end) / 2.0, 0.0, (bottom + top) / 2.0},
                               .size = {end - begin, kPlatform, top - bottom},
                               .rpy = Vec3::Zero(),
                               .friction = steps.friction});
  }
}

struct Slope {
  double start = 0.5, pitch = 0.0, roll = 0.0, incline = 0.0, uphill = 0.0;
  double friction = -1.0;

  [[nodiscard]] Vec3 rpy() const {
    if (incline == 0.0) return {roll, -pitch, 0.0};
    const Mat3 R_uphill = rotation_about_z(uphill);
    const Mat3 R_incline = Eigen::AngleAxisd(-incline, Vec3::UnitY()).toRotationMatrix();
    return roll_pitch_yaw(R_uphill * R_incline * R_uphill.transpose());
  }
};

Group fields(Slope& o) {
  return Group{
      {"start", &o.start, kAnyNumber, "m", "x where it begins"},
      {"pitch", &o.pitch, kAngle, "rad", "rises ahead where above 0"},
      {"roll", &o.roll, kAngle, "rad", "rises to the left where above 0"},
      {"incline", &o.incline, kAngle, "rad", "instead of both: the slope's angle"},
      {"uphill", &o.uphill, kAnyNumber, "rad", "and where it rises to, from x to the left"},
      friction_of(o.friction)}
      .with([](const Given& given) {
        if ((given.has("pitch") || given.has("roll")) != given.has("incline")) return;
        given.fail("pitch", "a slope has a pitch, a roll or both; or instead of them an incline");
      });
}

/// Level ground z = 0 up to the start, then a plane through (start, 0, 0), both as boxes.
void add_slope(const Slope& slope, Elements& elements) {
  const Vec3 size(kPlatform, kPlatform, kFloorDepth);
  const Vec3 rpy = slope.rpy();
  const Vec3 level(slope.start - kPlatform / 2.0, 0.0, -kFloorDepth / 2.0);
  const Vec3 tilted = Vec3(slope.start, 0.0, 0.0) +
                      from_roll_pitch_yaw(rpy) * Vec3(kPlatform / 2.0, 0.0, -kFloorDepth / 2.0);
  elements.push_back(simulation::TerrainBox{level, size, Vec3::Zero(), slope.friction});
  elements.push_back(simulation::TerrainBox{tilted, size, rpy, slope.friction});
}

}  // namespace

Group terrain_fields(simulation::TerrainOptions& terrain) {
  Elements& elements = terrain.elements;
  const auto keep = [&elements](const auto& element, const Given&) { elements.push_back(element); };
  const Entries shapes{
      {shape_of<simulation::TerrainLevel>("plane", keep),
       shape_of<simulation::TerrainBox>("box", keep),
       shape_of<simulation::TerrainHeightField>("height_field",
                                                [&elements](const auto& field, const Given& given) {
                                                  check_heights(field, given);
                                                  elements.emplace_back(field);
                                                }),
       shape_of<simulation::TerrainRandomBoxes>("random_boxes", keep),
       shape_of<FrictionTiles>(
           "friction_tiles",
           [&](const auto& tiles, const Given&) { add_friction_tiles(tiles, elements); }),
       shape_of<Steps>("steps",
                       [&](const auto& steps, const Given&) { add_steps(steps, elements); }),
       shape_of<Slope>("slope",
                       [&](const auto& slope, const Given&) { add_slope(slope, elements); })}};
  return Group{{"friction", &terrain.friction, kNotNegative, "", "coefficient of all elements"},
               {"elements", shapes, "by names of their own; without any the plane z = 0"}}
      .with([&elements](const Given&) {
        if (elements.empty()) elements.emplace_back(simulation::TerrainLevel{});
      });
}

}  // namespace surefoot::config
