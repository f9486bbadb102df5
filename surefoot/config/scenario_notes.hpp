#pragma once

#include "surefoot/config/config_tree.hpp"
#include "surefoot/config/scenario.hpp"

#include <string>
#include <vector>

namespace surefoot::config {

/// Notes on parts of a valid scenario that have no effect: pushes, lifts and faults that begin
/// after the end; assigned ranges of keys that are assigned too; assigned options that the actuator
/// model does not have.
[[nodiscard]] std::vector<std::string> scenario_notes(const ConfigNode& tree,
                                                      const Scenario& scenario);

}  // namespace surefoot::config
