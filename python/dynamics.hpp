#pragma once

#include "python/robot.hpp"
#include "surefoot/model/dynamics.hpp"

#include <memory>
#include <string>

namespace surefoot::python {

/// `Dynamics` in Python: a robot at one state.
struct NamedDynamics {
  std::shared_ptr<Robot> robot;
  model::Dynamics values;
  std::string world = "W";  ///< "W", the controller's; "S", the simulator's; empty: not known
};

/// What moves with the robot, and the world that its numbers are in; empty: not known, or B.
template <typename Kinematics>
struct InWorld {
  Kinematics values;
  std::string world;
};
using Point = InWorld<model::PointKinematics>;
using Rotation = InWorld<model::RotationKinematics>;

}  // namespace surefoot::python
