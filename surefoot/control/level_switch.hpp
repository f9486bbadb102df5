#pragma once

#include <string>
#include <vector>

namespace surefoot {
struct Group;
}  // namespace surefoot

namespace surefoot::control {

/// Levels of the stack to add and to remove, by name. The torques fade from the old to the new
/// optimum (see `SoftLevels`) over the duration. Times in s.
struct LevelSwitch {
  double time = 0.0;
  std::vector<std::string> add{}, remove{};  ///< adding a present level has no effect
  double duration = 0.5;
};

/// Their names, units, ranges and help.
[[nodiscard]] Group fields(LevelSwitch& o);

}  // namespace surefoot::control
