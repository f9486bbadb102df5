#pragma once

#include "surefoot/base/error.hpp"
#include "surefoot/control/controller.hpp"
#include "surefoot/gaits/undisturbed.hpp"
#include "surefoot/signals/tick_record.hpp"

#include <algorithm>

namespace surefoot::replay {

/// Gives a state that others set, whatever the readings.
class PlaybackEstimator final : public estimation::StateEstimator {
 public:
  explicit PlaybackEstimator(const RobotState& state) : state_(state) {}
  const RobotState& update(const SensorReading&, const TickContext&) noexcept override {
    return state_;
  }
  void restart() noexcept override {}
  bool is_own() const noexcept override { return false; }

 private:
  const RobotState& state_;
};

/// Gives the plans of a log, whatever the state, and answers the controller as the library's
/// planner did that made them.
class PlaybackPlanner final : public gaits::MotionPlanner {
 public:
  /// `now`: the log's tick.
  explicit PlaybackPlanner(const TickRecord& now) : now_(now) {}
  const MotionPlan& update(const UserCommand&, const RobotState&, const model::Dynamics&,
                           const HierarchyOutcome&) override {
    const bool was_solved = now_.model.p_WCom.allFinite();
    if (!was_solved) throw Error("it gave no plan here in the run");
    return given_ = now_.plan;
  }
  void restart() noexcept override { given_ = {}; }
  void set_friction(double) noexcept override {}  // the plan has it
  bool restarts() const noexcept override {
    return std::ranges::any_of(
        given_.events, [](const GaitEvent& event) { return event.kind == PlanEvent::calibration; });
  }
  bool is_undisturbed(const RobotState& state) const noexcept override {
    return gaits::is_undisturbed(given_, state);
  }

 private:
  const TickRecord& now_;
  MotionPlan given_;
};

}  // namespace surefoot::replay
