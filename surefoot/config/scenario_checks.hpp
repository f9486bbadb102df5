#pragma once

#include "surefoot/config/config_tree.hpp"
#include "surefoot/config/scenario.hpp"
#include "surefoot/config/section.hpp"
#include "surefoot/model/robot_model.hpp"

#include <string>
#include <vector>

/// What a scenario asks for against what its robot has and can. Errors have the file and line of
/// the key.
namespace surefoot::config {

/// A stack that the robot can't have is refused at the line that names it.
void check_stack(const Section& top, const Scenario& scenario);
/// Only arms that are there can reach, and frames that the stack follows. Finds these by name.
void find_reaches(const ConfigNode& tree, Scenario& scenario);
/// Pushes must act on links of the robot's URDF.
void check_pushes(const ConfigNode& tree, const Scenario& scenario);
/// The stack's bounds must be within the robot's reach. The error has the line of the number in the
/// scenario, or else of its stack.
void check_reach(const ConfigNode& tree, const model::RobotModel& model,
                 const control::StackOptions& stack);
/// Of the stance, which the legs must reach.
[[nodiscard]] JointVector read_posture(const ConfigNode& tree, const model::RobotModel& model,
                                       const gaits::StanceOptions& stance);
/// A faster turn than legs of this size can make would let the robot fall.
void check_calibration(const ConfigNode& tree, const Scenario& scenario);
/// What a robot with flat feet can't do. Its legs have no names in a scenario, and its plan is for
/// two.
void fit_to_standing(const ConfigNode& tree, Scenario& scenario);
/// Fills the joints that the scenario does not give with the stance.
void complete_posture(const ConfigNode& tree, const model::RobotModel& model, Scenario& scenario);
/// The torque limits must suffice to stand; else the masses may have a wrong unit. Limits that
/// look like placeholders are noted.
void check_strength(const ConfigNode& tree, model::RobotModel& model, const JointVector& stance,
                    std::vector<std::string>& notes);

}  // namespace surefoot::config
