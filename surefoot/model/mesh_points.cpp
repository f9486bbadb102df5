#include "surefoot/model/mesh_points.hpp"

#include <array>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>

namespace surefoot::model {
namespace {

/// 80 bytes, the number of triangles, then 50 bytes each: normal, three vertices, an attribute.
std::vector<Vec3> points_of_stl(const std::string& bytes) {
  constexpr std::size_t kHead = 84, kTriangle = 50, kNormal = 12, kVertex = 12;
  std::vector<Vec3> points;
  if (bytes.size() < kHead) return points;
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + kHead - sizeof count, sizeof count);
  if (bytes.size() != kHead + kTriangle * std::size_t{count}) return points;
  for (std::size_t triangle = kHead; triangle < bytes.size(); triangle += kTriangle) {
    for (std::size_t vertex = 0; vertex < 3; ++vertex) {
      std::array<float, 3> p{};
      std::memcpy(p.data(), bytes.data() + triangle + kNormal + kVertex * vertex, kVertex);
      points.emplace_back(double{p[0]}, double{p[1]}, double{p[2]});
    }
  }
  return points;
}

std::vector<Vec3> points_of_obj(const std::string& text) {
  std::vector<Vec3> points;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string tag;
    Vec3 p;
    if (words >> tag && tag == "v" && words >> p.x() >> p.y() >> p.z()) points.push_back(p);
  }
  return points;
}

}  // namespace

std::vector<Vec3> mesh_points(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string content{std::istreambuf_iterator<char>(stream), {}};
  const std::string extension = file.extension().string();
  if (extension == ".stl" || extension == ".STL") return points_of_stl(content);
  return extension == ".obj" ? points_of_obj(content) : std::vector<Vec3>();
}

}  // namespace surefoot::model
