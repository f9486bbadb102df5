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

/// Is told when a stage of the tick ends; the runtime measures time with it, the controller has no
/// clock.
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
  StackOptions stack;
  std::vector<LevelSwitch> level_switches;  ///< of the stack, by time; one ends before the next
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

/// The whole-body controller: one call a tick turns readings into joint torques.
class Controller {
 public:
  /// Throws Error on options that make no sense. Allocates here only.
  Controller(const model::RobotDescription& robot, const ControllerOptions& options,
             std::unique_ptr<estimation::StateEstimator> estimator);
  ~Controller();

  /// One tick: estimate, model, plan, stack, solve, command. Always returns finite torques inside
  /// the limits; never throws, allocates, locks or prints.
  const JointCommand& step(const SensorReading& reading, const UserCommand& user) noexcept;

  /// Between two ticks: begins to put levels into the stack or to take them out, as one of
  /// `level_switches` whose time has come. False, and nothing happens, while another switch is
  /// going on. Throws Error on a switch that the stack can't make; allocates in that case only.
  /// The record of the tick at which it begins has it.
  [[nodiscard]] bool switch_levels(const LevelSwitch& change);

  /// Between two ticks: puts a stack in the place of the present one, whose levels it has, in any
  /// order and with any parameters. Estimator, plan and safety go on; the torques pass from one
  /// stack's to the other's over `duration` [s] (see `StackFade`). False, and nothing happens,
  /// while another change or a switch of levels is going on. Throws Error on a stack or duration
  /// that makes no sense. Allocates.
  [[nodiscard]] bool set_stack(const StackOptions& stack, double duration = 0.3);
  /// Between two ticks: the friction coefficient that every foot is believed to find from now on,
  /// as `planner.force.friction`. Throws Error unless it is above 0.
  void set_friction(double friction);

  /// Everything of the last tick.
  [[nodiscard]] const TickRecord& record() const;
  /// What solving each level of the last tick took [s], by the clock of the options; 0 without one,
  /// and of levels that were not solved by themselves. No torque depends on it.
  [[nodiscard]] const std::array<double, kMaxLevels>& level_times() const;
  /// The rows of the last tick that was believed, as the solver saw them.
  [[nodiscard]] const solver::Hierarchy& hierarchy() const;
  /// The model of the last tick, as its hierarchy had it; null where the tick's state was refused,
  /// or a sensor lost, so that nothing was planned and solved.
  [[nodiscard]] const model::Dynamics* dynamics() const;
  /// Names of the levels, highest priority first.
  [[nodiscard]] std::vector<std::string> level_names() const;
  /// Unit of each level's residual, or units, as "m/s² and rad/s²"; empty where rows have weights.
  [[nodiscard]] std::vector<std::string> level_units() const;
  /// Name of the row with this id in a level, for logs and tables.
  [[nodiscard]] std::string row_name(int level, int id) const;
  /// The names of all rows, by level and id: what `row_name` says, as a copy of its own.
  [[nodiscard]] std::vector<std::vector<std::string>> row_names() const;
  /// Lines worth telling at start (what the model dropped, …).
  [[nodiscard]] std::vector<std::string> notes() const;
  /// Whether the record says from the next tick on what holds each level back, which takes some
  /// microseconds a tick; not without this call. No torque depends on it.
  void explain_levels(bool wanted);
  /// May be null. Must outlive the controller.
  void set_stage_observer(StageObserver* observer);
  /// Swings that ended on the ground, since the start.
  [[nodiscard]] int steps_taken() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace surefoot::control
