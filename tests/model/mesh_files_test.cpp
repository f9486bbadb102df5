#include "surefoot/model/mesh_files.hpp"

#include "surefoot/base/error.hpp"
#include "tests/logging/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace surefoot::model {
namespace {

namespace fs = std::filesystem;

std::string urdf_with(const std::vector<std::string>& names) {
  std::string text = "<robot name=\"r\"><link name=\"a\">";
  for (const std::string& name : names) {
    text += "<visual><geometry><mesh filename=\"" + name + "\"/></geometry></visual>";
  }
  return text + "</link></robot>";
}

TEST(MeshFiles, each_mesh_is_found_once_below_the_packages) {
  const test::TemporaryFolder folder;
  fs::create_directories(fs::path(folder / "robot/meshes"));
  std::ofstream(folder / "robot/meshes/base.dae") << "mesh";
  const std::vector<MeshFile> meshes =
      mesh_files(urdf_with({"package://robot/meshes/base.dae", "package://robot/meshes/gone.stl",
                            "package://robot/meshes/base.dae"}),
                 {.packages = {folder / "."}, .urdf = {}});
  ASSERT_EQ(meshes.size(), 2u);
  EXPECT_EQ(meshes[0].uri, "package://robot/meshes/base.dae");
  EXPECT_TRUE(fs::equivalent(meshes[0].path, folder / "robot/meshes/base.dae"));
  EXPECT_TRUE(meshes[1].path.empty());
}

TEST(MeshFiles, a_urdf_from_elsewhere_reaches_no_file_but_meshes_below_the_packages) {
  const test::TemporaryFolder folder;
  fs::create_directories(fs::path(folder / "packages/robot"));
  std::ofstream(folder / "outside.stl") << "secret";
  std::ofstream(folder / "packages/robot/notes.txt") << "secret";
  const std::string absolute = fs::absolute(folder / "outside.stl").string();
  for (const std::string& name :
       {std::string("package://../outside.stl"), std::string("package://robot/../../outside.stl"),
        "package://" + absolute, "file://" + absolute, absolute,
        std::string("package://robot/notes.txt"), std::string("package://"),
        std::string("outside.stl")}) {
    const std::vector<MeshFile> meshes =
        mesh_files(urdf_with({name}), {.packages = {folder / "packages"}, .urdf = {}});
    ASSERT_EQ(meshes.size(), 1u) << name;
    EXPECT_TRUE(meshes[0].path.empty()) << name;
  }
}

TEST(MeshFiles, of_a_urdf_that_lies_here_relative_paths_begin_at_its_folder) {
  const test::TemporaryFolder folder;
  fs::create_directories(fs::path(folder / "robot/urdf"));
  std::ofstream(folder / "robot/leg.stl") << "mesh";
  const MeshFolders folders{.packages = {}, .urdf = fs::path(folder / "robot/urdf")};
  for (const char* name : {"../leg.stl", "package://robot/leg.stl"}) {
    const std::vector<MeshFile> meshes = mesh_files(urdf_with({name}), folders);
    EXPECT_TRUE(fs::equivalent(meshes.at(0).path, folder / "robot/leg.stl")) << name;
  }
}

TEST(MeshFiles, a_package_may_lie_beside_the_urdfs_own) {
  const test::TemporaryFolder folder;
  fs::create_directories(fs::path(folder / "src/robot/urdf"));
  fs::create_directories(fs::path(folder / "src/shapes"));
  std::ofstream(folder / "src/shapes/leg.stl") << "mesh";
  const MeshFolders folders{.packages = {}, .urdf = fs::path(folder / "src/robot/urdf")};
  EXPECT_TRUE(fs::equivalent(find_mesh("package://shapes/leg.stl", folders),
                             folder / "src/shapes/leg.stl"));
  EXPECT_NE(missing_text("package://none/leg.stl", folders).find("in a folder \"none\" in "),
            std::string::npos);
}

TEST(MeshFiles, a_folder_of_packages_may_be_the_package) {
  const test::TemporaryFolder folder;
  fs::create_directories(fs::path(folder / "robot"));
  std::ofstream(folder / "robot/leg.stl") << "mesh";
  EXPECT_FALSE(
      find_mesh("package://robot/leg.stl", {.packages = {folder / "robot"}, .urdf = {}}).empty());
}

TEST(MeshFiles, what_is_no_xml_is_told) {
  EXPECT_THROW((void)mesh_files("no robot", {}), FileError);
  EXPECT_THROW((void)mesh_files("", {}), FileError);
}

}  // namespace
}  // namespace surefoot::model
