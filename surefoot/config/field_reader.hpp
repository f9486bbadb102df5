#pragma once

#include "surefoot/config/section.hpp"

namespace surefoot::config {

/// Reads these options from a map and checks their rules; call `finish()` afterwards. `is_there`:
/// the map exists, so that its required keys must be in it.
void read(Section& section, const Group& group, bool is_there = true);

}  // namespace surefoot::config
