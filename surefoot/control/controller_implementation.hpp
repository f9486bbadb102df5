#pragma once

#include "surefoot/control/active_stack.hpp"
#include "surefoot/control/calibration.hpp"
#include "surefoot/control/controller.hpp"
#include "surefoot/control/footing.hpp"
#include "surefoot/control/safety.hpp"
#include "surefoot/control/state_estimation.hpp"
#include "surefoot/estimation/first_readings.hpp"
#include "surefoot/gaits/parts/arm_reference.hpp"
#include "surefoot/gaits/parts/frame_reference.hpp"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace surefoot::control {

/// What the controller owns, and the stages of its tick in controller.cpp.
struct Controller::Implementation {
  /// Everything derived from the readings so far, except in `Safety` and the stack; a restart
  /// resets it to `at_start`.
  struct Memory {
    estimation::ReadingGuard guard;
    StateEstimation estimation;
    Calibration calibration;
    Footing footing;
    gaits::ArmReference arm;
    gaits::FrameReferences frames;
    LastTick last;
  };

  Implementation(const model::RobotDescription& robot, const ControllerOptions& options,
                 std::unique_ptr<estimation::StateEstimator> state_estimator,
                 std::unique_ptr<gaits::MotionPlanner> own_planner);

  const JointCommand& step(const SensorReading& reading, const UserCommand& user) noexcept;
  /// Those of the stack.
  void follow_frames();
  void begin_tick(const SensorReading& reading, const UserCommand& user) noexcept;
  const estimation::ReadingGuard& sense() noexcept;
  void guard_reading(SensorReading reading) noexcept;
  void restart() noexcept;
  void restart_standing() noexcept;
  [[nodiscard]] bool estimate(const estimation::ReadingGuard& seen) noexcept;
  [[nodiscard]] bool is_on_its_feet() noexcept;
  const model::Dynamics& calibrate(const estimation::ReadingGuard& seen) noexcept;
  [[nodiscard]] bool plan_motion(const model::Dynamics& dynamics) noexcept;
  void blame(const PartFault& found) noexcept;
  void describe(const model::Dynamics& dynamics, const solver::Solution& solution) noexcept;
  const JointCommand& command(const solver::Solution& solution) noexcept;
  const JointCommand& command_without_state() noexcept;
  const JointCommand& command_without_plan() noexcept;
  const JointCommand& command_off_its_feet() noexcept;
  const JointCommand& finish(const solver::Solution* solution,
                             const HierarchyOutcome& outcome) noexcept;
  void keep_posture() noexcept;
  [[nodiscard]] RobotMode mode() const;
  [[nodiscard]] LastTick remember(const HierarchyOutcome& outcome) const noexcept;
  void ended(Stage stage) const noexcept {
    if (observer != nullptr) observer->stage_ends(stage);
  }

  model::RobotModel model;
  std::unique_ptr<estimation::StateEstimator> estimator;
  bool has_own_planner, checks_plan;
  std::unique_ptr<gaits::MotionPlanner> planner;
  Memory memory;
  Memory at_start;
  estimation::FirstReadings first_readings;
  ActiveStack stack;
  Safety safety;
  std::vector<std::string> own_parts;
  std::vector<std::string> notes;
  TickRecord record;
  std::array<double, kMaxLevels> level_times{};  // [s]
  bool explains_levels = false;
  bool has_solved = false;      // the last tick
  bool has_begun_anew = false;  // at this tick
  PartFault fault;              // the latest
  StageObserver* observer = nullptr;
};

}  // namespace surefoot::control
