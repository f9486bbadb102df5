#pragma once

#include "surefoot/model/description.hpp"

namespace surefoot::test {

/// ANYmal B as robots/anymal_b.yaml describes it, without reading that file.
[[nodiscard]] model::RobotDescription anymal_b();
/// The same with a Kinova arm of six joints.
[[nodiscard]] model::RobotDescription anymal_b_with_arm();

}  // namespace surefoot::test
