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

/// What the operator asks for from a time on.
struct TimedCommand {
  double time = 0.0;  ///< [s]
  UserCommand user;
};

/// When a run has done what it was for, and ends early.
struct Goal {
  /// All four feet stand on the ground beyond this x in W [m]; NaN: no such goal …
  double feet_beyond_x = std::numeric_limits<double>::quiet_NaN();
  /// … and the base has then gone on by this [m].
  double walk_on = 0.0;
};

/// A figure to print beside a metric.
struct PaperFigure {
  std::string metric;
  std::string text;  ///< as printed, with unit
};

/// A file that a scenario was read from, word by word.
struct SourceFile {
  /// "scenario.yaml", "base1.yaml", "randomise1.yaml", "robot.yaml", "stack.yaml" or
  /// "stack_base1.yaml".
  std::string name;
  std::string text;
};

/// An experiment, complete: everything that a run is made from.
struct Scenario {
  std::string name;
  std::string description;
  std::string file;                      ///< that it was read from
  std::string requested;                 ///< the name or path that it was asked for by
  std::vector<std::string> assignments;  ///< "path.to.key=value", as they were asked for
  std::uint64_t seed = 0;
  double duration = 20.0;  ///< longest [s]
  estimation::Estimation estimation = estimation::Estimation::sensors;
  estimation::LegInertialOptions estimator;  ///< of `estimation: sensors`
  model::RobotDescription robot;
  control::ControllerOptions controller;
  simulation::PlantOptions plant;
  std::vector<TimedCommand> commands;  ///< by time, the first at 0
  Goal goal;
  std::vector<RandomDraw> drawn;                ///< what the seed chose
  std::vector<evaluation::Criterion> criteria;  ///< that the metrics must meet
  double success_rate = 1.0;  ///< share of the runs that must succeed, of one or many
  std::vector<PaperFigure> paper;
  std::vector<SourceFile> sources;
  std::uint64_t sources_hash = 0;  ///< of all these files and the URDF
  std::vector<std::string> notes;  ///< what is worth telling of it, though nothing is wrong
  std::string options_json;  ///< the whole scenario as it was read, assignments and draws included

  /// The operator's command at a time.
  [[nodiscard]] const UserCommand& user(double time) const;
};

}  // namespace surefoot::config
