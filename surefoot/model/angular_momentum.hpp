#pragma once

#include "surefoot/math/types.hpp"
#include "surefoot/model/dynamics.hpp"

namespace surefoot::model {

/// Angular momentum of the robot about its centre of mass, in W [N·m·s]: the base's rotational rows
/// of M u, moved from B's origin to the COM,
///
///     L = R_WB (M u)_4..6 − (c − p_WB) × m ċ
[[nodiscard]] inline Vec3 angular_momentum(const Dynamics& dynamics) noexcept {
  const Vec3 about_base =
      dynamics.base_rotation.R * product(dynamics.M.middleRows<3>(3), dynamics.u);
  const Vec3 lever = dynamics.com.p - dynamics.base.p;
  return about_base - lever.cross(dynamics.mass * dynamics.com.v);
}

}  // namespace surefoot::model
