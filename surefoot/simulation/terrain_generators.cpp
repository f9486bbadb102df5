#include "surefoot/simulation/terrain_generators.hpp"

#include "surefoot/simulation/random.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace surefoot::simulation {

namespace {

constexpr double kDepthBelowLowestTop = 0.2;
constexpr int kWaves = 16;
constexpr double kPointsPerWavelength = 12.0;
constexpr int kMaxGeneratedPoints = 1000;

struct Wave {
  Vec2 number;  ///< wave number [rad/m]
  double phase;
};

std::array<Wave, kWaves> random_waves(double wavelength, std::uint64_t seed) {
  Random random(seed);
  std::array<Wave, kWaves> waves;
  for (Wave& wave : waves) {
    const double direction = 2.0 * kPi * random.uniform();
    const double length = wavelength * (0.8 + 0.4 * random.uniform());
    wave.number = 2.0 * kPi / length * Vec2(std::cos(direction), std::sin(direction));
    wave.phase = 2.0 * kPi * random.uniform();
  }
  return waves;
}

double height(const std::array<Wave, kWaves>& waves, const Vec2& position) {
  double sum = 0.0;
  for (const Wave& wave : waves) sum += std::sin(wave.number.dot(position) + wave.phase);
  return sum;
}

int generated_points(double size, double wavelength) {
  const double points = std::ceil(size / wavelength * kPointsPerWavelength) + 1.0;
  return static_cast<int>(std::clamp(points, 2.0, static_cast<double>(kMaxGeneratedPoints)));
}

int cells(double size, double cell) {
  return std::max(1, static_cast<int>(std::floor(size / cell + 1e-9)));
}

}  // namespace

std::vector<TerrainBox> random_boxes(const TerrainRandomBoxes& field) {
  Random random(field.seed);
  const int columns = cells(field.size_x, field.cell);
  const int rows = cells(field.size_y, field.cell);
  std::vector<TerrainBox> boxes;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const double top = field.max_height * random.uniform();
      const double thickness = top + kDepthBelowLowestTop;
      TerrainBox box;
      box.position =
          field.position + Vec3((column - 0.5 * (columns - 1)) * field.cell,
                                (row - 0.5 * (rows - 1)) * field.cell, top - 0.5 * thickness);
      box.size = Vec3(field.cell, field.cell, thickness);
      box.friction = field.friction;
      boxes.push_back(box);
    }
  }
  return boxes;
}

TerrainHeightField with_heights(TerrainHeightField field) {
  if (!field.heights.empty()) return field;
  if (field.columns == 0) {
    field.columns = generated_points(field.size_x, field.wavelength);
    field.rows = generated_points(field.size_y, field.wavelength);
  }
  const std::array<Wave, kWaves> waves = random_waves(field.wavelength, field.seed);
  double largest = 0.0;
  for (int row = 0; row < field.rows; ++row) {
    for (int column = 0; column < field.columns; ++column) {
      const Vec2 position(field.size_x * column / (field.columns - 1),
                          field.size_y * row / (field.rows - 1));
      field.heights.push_back(height(waves, position));
      largest = std::max(largest, std::abs(field.heights.back()));
    }
  }
  for (double& value : field.heights) value *= field.amplitude / std::max(largest, 1e-12);
  return field;
}

}  // namespace surefoot::simulation
