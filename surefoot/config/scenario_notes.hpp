#pragma once

#include "surefoot/config/config_tree.hpp"
#include "surefoot/config/scenario.hpp"

#include <string>
#include <vector>

namespace surefoot::config {

/// What is worth telling of a scenario that is valid: what it says, but nothing comes of. Pushes
/// and faults that begin after the end; of the assignments those to ranges of keys that are
/// assigned themselves, and those to parts of an actuator that its model does not have.
[[nodiscard]] std::vector<std::string> scenario_notes(const ConfigNode& tree,
                                                      const Scenario& scenario);

}  // namespace surefoot::config
