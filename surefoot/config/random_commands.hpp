#pragma once

#include "surefoot/config/scenario.hpp"

namespace surefoot::config {

/// Draws the scenario's random commands from its seed, to its end, and puts them after its others.
void add_random_commands(Scenario& scenario);

}  // namespace surefoot::config
