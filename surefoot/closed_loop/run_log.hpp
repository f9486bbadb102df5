#pragma once

#include "surefoot/config/scenario.hpp"
#include "surefoot/control/controller.hpp"
#include "surefoot/logging/log_header.hpp"
#include "surefoot/model/robot_model.hpp"
#include "surefoot/simulation/plant.hpp"

namespace surefoot::closed_loop {

/// What nothing comes of in the scenario, and what model and plant changed in the robot; each line
/// once.
[[nodiscard]] std::vector<std::string> run_notes(const config::Scenario& scenario,
                                                 const control::Controller& controller,
                                                 const simulation::Plant& plant);

/// The command that makes this run again, for a shell in the source tree.
[[nodiscard]] std::string run_again(const config::Scenario& scenario);

/// Names rows out of a table, by level and id.
[[nodiscard]] logging::RowNamer row_namer(std::vector<std::vector<std::string>> names);

/// What the log of a run says before its first tick.
[[nodiscard]] logging::LogHeader log_header(const config::Scenario& scenario,
                                            const control::Controller& controller,
                                            const simulation::Plant& plant,
                                            const model::RobotModel& model);

}  // namespace surefoot::closed_loop
