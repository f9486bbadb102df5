#pragma once

#include "python/numbers.hpp"
#include "surefoot/signals/joint_command.hpp"

#include <string>
#include <vector>

namespace surefoot::python {

using JointNumbers = std::vector<double>;

inline JointCommand joint_command(const JointNumbers& torque) {
  if (torque.size() > kMaxJoints)
    throw Error("torque has " + std::to_string(torque.size()) + " numbers; a robot has at most " +
                std::to_string(kMaxJoints) + " joints");
  JointCommand command;
  command.torque.resize(static_cast<Eigen::Index>(torque.size()));
  assign(command.torque, torque, "torque", true);
  return command;
}

}  // namespace surefoot::python
