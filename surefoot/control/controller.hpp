#pragma once

#include "surefoot/control/level_switch.hpp"
#include "surefoot/control/safety_options.hpp"
#include "surefoot/control/solver_options.hpp"
#include "surefoot/control/stack_options.hpp"
#include "surefoot/estimation/contact_force_estimator.hpp"
#include "surefoot/estimation/external_force.hpp"
#include "surefoot/estimation/link_mass_estimator.hpp"
#include "surefoot/estimation/reading_guard_options.hpp"
#include "surefoot/estimation/sensor_consistency_options.hpp"
#include "surefoot/estimation/slip_detector.hpp"
#include "surefoot/estimation/state_estimator.hpp"
#include "surefoot/gaits/motion_planner.hpp"
#include "surefoot/gaits/planner_options.hpp"
#include "surefoot/model/description.hpp"
#include "surefoot/signals/tick_record.hpp"
#include "surefoot/solver/hierarchy.hpp"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace surefoot {
struct Group;
}  // namespace surefoot

namespace surefoot::model {
struct Dynamics;
}  // namespace surefoot::model

namespace surefoot::control {

/// Stages of a tick, in order.
enum class Stage : int { estimate = 0, model = 1, plan = 2, stack = 3, solve = 4, command = 5 };

/// Notified at the end of each stage of a tick. The runtime measures time with it, as the
/// controller has no clock.
class StageObserver {
 public:
  StageObserver() = default;
  StageObserver(const StageObserver&) = delete;
  StageObserver& operator=(const StageObserver&) = delete;
  virtual ~StageObserver() = default;
  virtual void tick_begins() noexcept = 0;
  virtual void stage_ends(Stage stage) noexcept = 0;
};

struct ControllerOptions {
  double period = 0.0025;  ///< of the control loop [s]
  gaits::PlannerOptions planner;
  std::vector<gaits::NamedGait> gaits;     ///< that the user may change to
  int first_gait = UserCommand::kOwnGait;  ///< of a command without one: `planner`'s, or of these
  StackOptions stack;
  std::vector<LevelSwitch> level_switches;  ///< sorted by time; must not overlap
  SolverOptions solver;
  estimation::ReadingGuardOptions guard;
  estimation::SensorConsistencyOptions consistency;
  estimation::ContactForceOptions contact_force;
  estimation::LinkMassOptions link_masses;
  estimation::SlipOptions slip;
  estimation::ExternalForceOptions external_force;
  SafetyOptions safety;
};

/// Their names, units, ranges and help.
[[nodiscard]] Group fields(ControllerOptions& o);

/// The whole-body controller: one call a tick turns readings into joint torques. Parts of your own
/// go in at construction: estimator, planner, and tasks in `options.stack.own_tasks`.
class Controller {
 public:
  /// Without a planner it makes the library's, of the options. Throws Error on invalid options.
  /// Allocates here only.
  Controller(const model::RobotDescription& robot, const ControllerOptions& options,
             std::unique_ptr<estimation::StateEstimator> estimator,
             std::unique_ptr<gaits::MotionPlanner> planner = nullptr);
  ~Controller();

  /// One tick: estimate, model, plan, stack, solve, command. Always returns finite torques within
  /// the limits [N·m]; never throws, allocates, locks or prints.
  const JointCommand& step(const SensorReading& reading, const UserCommand& user) noexcept;

  /// Between two ticks: starts to add or remove levels, like one of `level_switches` that is due.
  /// Returns false without effect during another switch. Throws Error on a switch that the stack
  /// can't make; allocates in that case only. The record of its first tick reports it.
  [[nodiscard]] bool switch_levels(const LevelSwitch& change);

  /// Between two ticks: replaces the stack by one with the same levels, in any order and with any
  /// parameters. Estimator, plan and safety continue; the torques fade from the old stack's to the
  /// new one's over `duration` [s] (see `StackFade`). Names are those of the new stack at once; the
  /// record is that of the last tick, of the old one. Returns false without effect during another
  /// change or level switch. Throws Error on an invalid stack or duration.
  /// Allocates.
  [[nodiscard]] bool set_stack(const StackOptions& stack, double duration = 0.3);
  /// Between two ticks: sets the assumed friction coefficient of all feet, like
  /// `planner.force.friction`. Throws Error unless it is above 0.
  void set_friction(double friction);

  /// Everything of the last tick.
  [[nodiscard]] const TickRecord& record() const;
  /// Solve time of each level in the last tick [s], by the clock of the options; 0 without a clock,
  /// and for levels that were not solved separately. No torque depends on it.
  [[nodiscard]] const std::array<double, kMaxLevels>& level_times() const;
  /// The solver's rows of the last tick that was solved.
  [[nodiscard]] const solver::Hierarchy& hierarchy() const;
  /// The model of the last tick, as used by its hierarchy; null if nothing was solved, because the
  /// state was refused or a sensor was lost.
  [[nodiscard]] const model::Dynamics* dynamics() const;
  /// Names of the levels, highest priority first.
  [[nodiscard]] std::vector<std::string> level_names() const;
  /// Unit of each level's residual, or units, as "m/s² and rad/s²"; empty for weighted rows.
  [[nodiscard]] std::vector<std::string> level_units() const;
  /// Name of the row with this id in a level, for logs and tables.
  [[nodiscard]] std::string row_name(int level, int id) const;
  /// A copy of all row names, by level and id.
  [[nodiscard]] std::vector<std::vector<std::string>> row_names() const;
  /// What a part of your own did wrong last, naming it: "task "my_task" threw: ...", or that a
  /// reading is of another robot; empty if nothing. If it goes on, the controller sits down with
  /// `StopCause::own_part`.
  [[nodiscard]] std::string fault() const;
  /// The user's own among its parts: "estimator", "planner", "gait my_gait", "task my_task".
  [[nodiscard]] std::vector<std::string> own_parts() const;
  /// Messages for the user at start: what the model ignores of the URDF, what the stack lacks.
  [[nodiscard]] std::vector<std::string> notes() const;
  /// From the next tick on, records which rows block each level, at a cost of some microseconds a
  /// tick. Off by default. No torque depends on it.
  void explain_levels(bool wanted);
  /// May be null. Must outlive the controller.
  void set_stage_observer(StageObserver* observer);
  /// Completed footsteps since the start.
  [[nodiscard]] int steps_taken() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace surefoot::control
