#pragma once

#include "surefoot/estimation/invariant_filter.hpp"

namespace surefoot::test {

/// Normalised estimation error squared of tilt (2) and velocity (3), e' P⁻¹ e with P as the
/// filter's covariance has it: χ² with 5 degrees of freedom where the filter knows how wrong it is.
[[nodiscard]] double nees(const estimation::InvariantFilter& filter, const Mat3& true_R_WB,
                          const Vec3& true_v_WB);

}  // namespace surefoot::test
