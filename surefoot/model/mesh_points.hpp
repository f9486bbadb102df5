#pragma once

#include "surefoot/math/types.hpp"

#include <filesystem>
#include <vector>

namespace surefoot::model {

/// The vertices of a mesh, as often as its file names them, in the file's unit. Empty if the file
/// is no binary .stl or .obj, or can't be read.
[[nodiscard]] std::vector<Vec3> mesh_points(const std::filesystem::path& file);

}  // namespace surefoot::model
