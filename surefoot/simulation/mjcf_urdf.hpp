#pragma once

#include <string>

namespace surefoot::simulation {

/// The robot of an MJCF as a URDF, which is what all parts of the program read. Bodies are links,
/// and so are named sites and named spheres, without shapes. Links and joints tell their `line` in
/// the MJCF; <note> tells what was left out. `folder`: put before the files of meshes, such as
/// `package://NAME/…` of the MJCF's folder; may be empty. Throws FileError as `read_mjcf` does.
[[nodiscard]] std::string urdf_of_mjcf(const std::string& path, const std::string& folder);

}  // namespace surefoot::simulation
