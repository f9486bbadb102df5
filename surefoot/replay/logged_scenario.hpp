#pragma once

#include "surefoot/config/scenario_file.hpp"
#include "surefoot/logging/log_header.hpp"
#include "surefoot/logging/scratch_folder.hpp"

#include <string>

namespace surefoot::replay {

/// The scenario of a log: its settings, stack and robot. The header must have the attachments
/// `resolved_stack.yaml`, `robot.yaml` and `robot.urdf`. The URDF is written into the folder, where
/// a controller reads it. Throws Error if this program can't read them.
[[nodiscard]] config::Scenario logged_scenario(const logging::LogHeader& header,
                                               const logging::ScratchFolder& folder,
                                               const tasks::OwnTasks& own = {});

/// The same with another stack, a name or file as in `--set stack=`, without the log's switches of
/// levels. It must have all tasks whose parameters the log's scenario sets.
[[nodiscard]] config::Scenario logged_scenario(const logging::LogHeader& header,
                                               const logging::ScratchFolder& folder,
                                               const std::string& stack,
                                               const tasks::OwnTasks& own = {});

}  // namespace surefoot::replay
