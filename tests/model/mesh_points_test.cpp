// Vertices of mesh files.
#include "surefoot/model/mesh_points.hpp"

#include "tests/logging/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>

namespace surefoot::model {
namespace {

std::string bytes_of(const auto& values) {
  return {reinterpret_cast<const char*>(values.data()), sizeof(values)};
}

TEST(MeshPoints, of_a_binary_stl_are_the_corners_of_its_triangles) {
  const test::TemporaryFolder folder;
  const std::array<float, 12> triangle{0, 0, 1, 1, 2, 3, 4, 5, 6, 7, 8, 9};  // normal, corners
  const std::string stl = std::string(80, ' ') + bytes_of(std::array<std::uint32_t, 1>{1}) +
                          bytes_of(triangle) + std::string(2, '\0');
  test::write_file(folder / "foot.stl", stl);
  const std::vector<Vec3> points = mesh_points(folder / "foot.stl");
  ASSERT_EQ(points.size(), 3U);
  EXPECT_EQ(points[0], Vec3(1, 2, 3));
  EXPECT_EQ(points[2], Vec3(7, 8, 9));
  test::write_file(folder / "cut.stl", stl.substr(0, 100));
  EXPECT_TRUE(mesh_points(folder / "cut.stl").empty());
}

TEST(MeshPoints, of_an_obj_are_its_vertices) {
  const test::TemporaryFolder folder;
  test::write_file(folder / "foot.obj", "# foot\nv 1 2 3\nvn 0 0 1\nv 4 5 6\nf 1 2 1\n");
  const std::vector<Vec3> points = mesh_points(folder / "foot.obj");
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points[1], Vec3(4, 5, 6));
}

TEST(MeshPoints, of_other_and_missing_files_are_none) {
  EXPECT_TRUE(mesh_points("foot.dae").empty());
  EXPECT_TRUE(mesh_points("missing.stl").empty());
}

}  // namespace
}  // namespace surefoot::model
