#pragma once

#include "surefoot/base/fields.hpp"
#include "surefoot/config/scenario.hpp"

#include <functional>
#include <string>

namespace surefoot::config {

/// Keys of an entry of `user:`.
[[nodiscard]] Group fields(TimedCommand& o);

/// All keys of a scenario file.
[[nodiscard]] Group scenario_fields(Scenario& scenario);

/// Calls `use` with the option of a scenario at a dotted path, with any name for a named entry, as
/// in "disturbances.pushes.kick.time". Its value is meaningless. False: no such option.
bool visit_scenario_option(const std::string& path, const std::function<void(const Field&)>& use);

}  // namespace surefoot::config
