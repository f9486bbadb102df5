#pragma once

#include "surefoot/config/section.hpp"

namespace surefoot::config {

/// Reads what a map says of these options, and holds it against their rules; call `finish()`
/// afterwards. `is_there`: the map is written, so that what it requires must be in it.
void read(Section& section, const Group& group, bool is_there = true);

}  // namespace surefoot::config
