#pragma once

#include "python/robot.hpp"
#include "surefoot/model/dynamics.hpp"

#include <memory>

namespace surefoot::python {

/// `Dynamics` in Python: a robot at one state.
struct NamedDynamics {
  std::shared_ptr<Robot> robot;
  model::Dynamics values;
};

}  // namespace surefoot::python
