#pragma once

#include "surefoot/model/inertia.hpp"

namespace surefoot::model {

/// Is it a mass at one point, without an extent? Up to 1 g counts as a placeholder.
[[nodiscard]] inline bool is_point(const Inertia& inertia) {
  return inertia.mass > 1e-3 && inertia.about_com.isZero(0.0);
}

}  // namespace surefoot::model
