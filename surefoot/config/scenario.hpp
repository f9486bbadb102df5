#pragma once

#include "surefoot/config/randomise.hpp"
#include "surefoot/control/controller.hpp"
#include "surefoot/estimation/estimation.hpp"
#include "surefoot/estimation/leg_inertial_estimator.hpp"
#include "surefoot/evaluation/criteria.hpp"
#include "surefoot/model/description.hpp"
#include "surefoot/signals/user_command.hpp"
#include "surefoot/simulation/plant_options.hpp"

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace surefoot::config {

/// The operator's command from a time on.
struct TimedCommand {
  double time = 0.0;  ///< [s]
  UserCommand user;
  std::string gait{};   ///< by name, which sets that of `user`
  std::string frame{};  ///< by name, which sets that of `user.reach`
};

/// Commands that the seed draws one after the other, each uniformly from these ranges. Before them
/// the scenario's own hold.
struct RandomCommands {
  double from = std::numeric_limits<double>::quiet_NaN();  ///< NaN: none [s]
  double period = 2.0;                                     ///< from command to command [s]
  Vec2 velocity_min{-0.5, -0.3}, velocity_max{0.5, 0.3};   ///< forward and to the left [m/s]
  double yaw_rate = 1.0;                                   ///< largest [rad/s]
  bool gaits = false;                                      ///< in any of the scenario's gaits
};

/// The goal of a run, which ends the run early.
struct Goal {
  /// All four feet stand on the ground beyond this x in S [m]; NaN: no goal.
  double feet_beyond_x = std::numeric_limits<double>::quiet_NaN();
  /// Distance that the base must walk after that [m].
  double walk_on = 0.0;
};

/// A figure of the paper to print next to a metric.
struct PaperFigure {
  std::string metric;
  std::string text;  ///< as printed, with unit
};

/// The exact text of a file that a scenario was read from.
struct SourceFile {
  /// "scenario.yaml", "base1.yaml", "randomise1.yaml", "gait.yaml", "robot.yaml", "stack.yaml"
  /// or "stack_base1.yaml".
  std::string name;
  std::string text;
};

/// A complete experiment: everything that determines a run.
struct Scenario {
  std::string name;
  std::string description;
  std::string file;                      ///< it was read from
  std::string requested;                 ///< name or path in the request
  std::vector<std::string> assignments;  ///< "path.to.key=value", as requested
  std::uint64_t seed = 0;
  double duration = 20.0;  ///< longest [s]
  /// The criteria need this much of a run that nothing ends; NaN: any run is judged [s].
  double judged_after = std::numeric_limits<double>::quiet_NaN();
  estimation::Estimation estimation = estimation::Estimation::sensors;
  estimation::LegInertialOptions estimator;  ///< of `estimation: sensors`
  model::RobotDescription robot;
  control::ControllerOptions controller;
  simulation::PlantOptions plant;
  std::vector<TimedCommand> commands;  ///< by time, the first at 0; with the random ones
  RandomCommands random_commands;
  Goal goal;
  std::vector<RandomDraw> drawn;                ///< from the seed
  std::vector<evaluation::Criterion> criteria;  ///< that the metrics must meet
  double success_rate = 1.0;  ///< share of the runs that must succeed, of one or many
  std::vector<PaperFigure> paper;
  std::vector<SourceFile> sources;
  std::uint64_t sources_hash = 0;  ///< of `sources` and the URDF
  std::vector<std::string> notes;  ///< see scenario_notes()
  std::string options_json;        ///< the whole scenario with assignments and draws

  /// The operator's command at a time.
  [[nodiscard]] const UserCommand& user(double time) const;
};

}  // namespace surefoot::config
