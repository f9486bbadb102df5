#pragma once

#include "surefoot/config/scenario.hpp"

#include <string>

namespace surefoot::config {

/// Which numbers the scenario's robot file leaves out, and what is taken for them; empty: none.
[[nodiscard]] std::string robot_guesses(const Scenario& scenario);

}  // namespace surefoot::config
