#pragma once

#include "surefoot/base/fields.hpp"
#include "surefoot/config/scenario.hpp"

#include <optional>
#include <string>

namespace surefoot {

/// Of an entry of `user:`.
[[nodiscard]] Group fields(TimedCommand& o);

/// All keys of a scenario file.
[[nodiscard]] Group scenario_fields(Scenario& scenario);

/// The option of a scenario at a dotted path, with any name for an entry that has one of its own:
/// "disturbances.pushes.kick.time". Its value is that of no scenario.
[[nodiscard]] std::optional<Field> scenario_option(const std::string& path);

}  // namespace surefoot
