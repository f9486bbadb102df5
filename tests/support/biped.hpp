#pragma once

#include "surefoot/model/description.hpp"

namespace surefoot::test {

/// robots/g1.yaml: two legs of six joints with flat feet, a waist and two arms.
[[nodiscard]] model::RobotDescription biped();

}  // namespace surefoot::test
