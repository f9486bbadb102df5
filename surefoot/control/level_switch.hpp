#pragma once

#include <string>
#include <vector>

namespace surefoot {
struct Group;
}  // namespace surefoot

namespace surefoot::control {

/// Levels of the stack that come and go, by name. The torques pass from those without to those with
/// them, in equal shares of the whole change (see `SoftLevels`), over the duration.
struct LevelSwitch {
  double time = 0.0;
  std::vector<std::string> add{}, remove{};  ///< those to be added that are there stay
  double duration = 0.5;
};

/// Their names, units, ranges and help.
[[nodiscard]] Group fields(LevelSwitch& o);

}  // namespace surefoot::control
