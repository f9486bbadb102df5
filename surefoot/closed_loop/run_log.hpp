#pragma once

#include "surefoot/config/scenario.hpp"
#include "surefoot/control/controller.hpp"
#include "surefoot/logging/log_header.hpp"
#include "surefoot/model/robot_model.hpp"
#include "surefoot/simulation/plant.hpp"

namespace surefoot::closed_loop {

/// Notes on a run: keys of the scenario without effect, and what model and plant changed in the
/// robot. Each line once. `plant`: null if the loop has none.
[[nodiscard]] std::vector<std::string> run_notes(const config::Scenario& scenario,
                                                 const control::Controller& controller,
                                                 const simulation::Plant* plant);

/// Shell command, in the source tree, that repeats this run.
[[nodiscard]] std::string run_again(const config::Scenario& scenario);

/// Names rows by a table of level and id.
[[nodiscard]] logging::RowNamer row_namer(std::vector<std::vector<std::string>> names);

/// Header of a run's log. `plant`: null if the loop has none; then nothing in it is of a
/// simulation.
[[nodiscard]] logging::LogHeader log_header(const config::Scenario& scenario,
                                            const control::Controller& controller,
                                            const simulation::Plant* plant,
                                            const model::RobotModel& model);

}  // namespace surefoot::closed_loop
