#pragma once

#include "surefoot/config/scenario.hpp"

#include <string>

namespace surefoot::config {

/// Which numbers the scenario's robot file leaves out, and what is taken for them; empty: none.
[[nodiscard]] std::string robot_guesses(const Scenario& scenario);

/// Begins the note on what a robot file calls guessed.
inline constexpr const char* kGuessed = "guessed for ";

/// That note on the scenario's robot; empty: none.
[[nodiscard]] std::string guessed_note(const Scenario& scenario);

}  // namespace surefoot::config
