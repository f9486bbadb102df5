#include "surefoot/closed_loop/log_terrain.hpp"

#include "surefoot/simulation/terrain_generators.hpp"

namespace surefoot::closed_loop {
namespace {

Quat orientation(const Vec3& rpy) {
  return Eigen::AngleAxisd(rpy.z(), Vec3::UnitZ()) * Eigen::AngleAxisd(rpy.y(), Vec3::UnitY()) *
         Eigen::AngleAxisd(rpy.x(), Vec3::UnitX());
}

struct Writer {
  std::vector<logging::LogTerrain> pieces;

  void operator()(const simulation::TerrainLevel& plane) {
    pieces.push_back(
        {.shape = "plane", .position = plane.position, .q_SG = orientation(plane.rpy)});
  }

  void operator()(const simulation::TerrainBox& box) {
    pieces.push_back(
        {.shape = "box", .position = box.position, .q_SG = orientation(box.rpy), .size = box.size});
  }

  void operator()(const simulation::TerrainRandomBoxes& field) {
    for (const simulation::TerrainBox& box : simulation::random_boxes(field)) (*this)(box);
  }

  void operator()(const simulation::TerrainHeightField& given) {
    simulation::TerrainHeightField field = simulation::with_heights(given);
    pieces.push_back({.shape = "heights",
                      .position = field.position,
                      .size = {field.size_x, field.size_y, 0.0},
                      .columns = field.columns,
                      .rows = field.rows,
                      .heights = std::move(field.heights)});
  }
};

}  // namespace

std::vector<logging::LogTerrain> log_terrain(const simulation::TerrainOptions& terrain) {
  Writer writer;
  if (terrain.elements.empty()) writer(simulation::TerrainLevel{});
  for (const simulation::TerrainElement& element : terrain.elements) std::visit(writer, element);
  return writer.pieces;
}

}  // namespace surefoot::closed_loop
