#pragma once

#include "surefoot/config/scenario_file.hpp"
#include "surefoot/logging/log_header.hpp"
#include "surefoot/logging/scratch_folder.hpp"

#include <string>

namespace surefoot::replay {

/// The scenario as a log has it: what was set, its stack and its robot. The header has the
/// attachments `resolved_stack.yaml`, `robot.yaml` and `robot.urdf`; the URDF is written into the
/// folder and read again when a controller is made. Throws Error if this program can't make sense
/// of them.
[[nodiscard]] config::Scenario logged_scenario(const logging::LogHeader& header,
                                               const logging::ScratchFolder& folder);

/// The same with another stack, by name or file as `--set stack=` has it, and without the log's
/// switches of levels. What the log's scenario sets of tasks must be in that one, too.
[[nodiscard]] config::Scenario logged_scenario(const logging::LogHeader& header,
                                               const logging::ScratchFolder& folder,
                                               const std::string& stack);

}  // namespace surefoot::replay
