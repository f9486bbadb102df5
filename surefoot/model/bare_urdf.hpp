#pragma once

#include "surefoot/model/urdf.hpp"

#include <string>

namespace surefoot::model {

/// The text of a URDF with only its joints and its links' inertias, as they are written, so that
/// another program reads the same numbers. A placeholder inertia of the root is left out. Empty if
/// the URDF was made from an MJCF, or has joints that are held.
[[nodiscard]] std::string bare_urdf(const Urdf& urdf);

}  // namespace surefoot::model
