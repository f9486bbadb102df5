#pragma once

#include "surefoot/config/scenario.hpp"
#include "surefoot/config/section.hpp"

#include <vector>

namespace surefoot {

/// Reads what the operator asks for, and from when on; first of all, to stand.
void read_user(Section& top, std::vector<TimedCommand>& commands);

}  // namespace surefoot
