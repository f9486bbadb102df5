#pragma once

#include "surefoot/config/config_tree.hpp"
#include "surefoot/control/level_switch.hpp"
#include "surefoot/control/stack_options.hpp"

#include <vector>

namespace surefoot {

/// Reads `stack_switches:`, the levels of the stack that come and go in a scenario:
///
///     stack_switches:
///       - {time: 0, remove: [manipulability], duration: 0}          # there from later on
///       - {time: 5, remove: [torso_height], add: [manipulability]}  # duration: 0.5 s if not given
///
/// Throws Error, naming file, line and key, on levels that the stack does not have, those that keep
/// the physics, and switches that begin before the one above has ended.
[[nodiscard]] std::vector<LevelSwitch> read_level_switches(const ConfigNode& list,
                                                           const StackOptions& stack);

}  // namespace surefoot
