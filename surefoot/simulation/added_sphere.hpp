#pragma once

#include <string_view>

namespace surefoot::simulation {

/// Begins the plant's note on a foot whose sphere is not in the URDF.
inline constexpr std::string_view kAddedSphere = "a massless foot sphere was added to ";

}  // namespace surefoot::simulation
