#pragma once

#include <string>
#include <vector>

namespace surefoot {

/// Levels of the stack that come and go, by name. The torques pass from those without to those with
/// them, in equal shares of the whole change (see `SoftLevels`), over the duration.
struct LevelSwitch {
  double time = 0.0;                  ///< when it begins [s]
  std::vector<std::string> add{};     ///< levels that come; those that are there stay
  std::vector<std::string> remove{};  ///< levels that go
  double duration = 0.5;              ///< [s]; 0 is at once
};

}  // namespace surefoot
