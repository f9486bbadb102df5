#pragma once

#include "surefoot/base/fields.hpp"
#include "surefoot/config/scenario.hpp"

#include <functional>
#include <string>

namespace surefoot::config {

/// Of an entry of `user:`.
[[nodiscard]] Group fields(TimedCommand& o);

/// All keys of a scenario file.
[[nodiscard]] Group scenario_fields(Scenario& scenario);

/// Calls `use` with the option of a scenario at a dotted path, with any name for an entry that has
/// one of its own: "disturbances.pushes.kick.time". Its value is that of no scenario. False: there
/// is none.
bool visit_scenario_option(const std::string& path, const std::function<void(const Field&)>& use);

}  // namespace surefoot::config
