#pragma once

#include "surefoot/base/fields.hpp"
#include "surefoot/config/scenario.hpp"

#include <functional>
#include <string>

namespace surefoot::config {

/// Keys of an entry of `user:`.
[[nodiscard]] Group fields(TimedCommand& o);

/// All keys of a scenario file for a robot with this many legs; kMaxLegs: of every robot.
[[nodiscard]] Group scenario_fields(Scenario& scenario, int num_legs = kNumLegs);

/// Calls `use` with the option of a scenario at a dotted path, with any name for a named entry, as
/// in "disturbances.pushes.kick.time". Its value is meaningless. False: no such option.
bool visit_scenario_option(const std::string& path, const std::function<void(const Field&)>& use,
                           int num_legs = kNumLegs);

}  // namespace surefoot::config
