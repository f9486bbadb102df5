#pragma once

#include "surefoot/config/scenario.hpp"
#include "surefoot/control/controller.hpp"
#include "surefoot/signals/plan_event.hpp"
#include "surefoot/simulation/plant.hpp"

#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace surefoot::test {

/// A scenario of scenarios/ with what a test changes in it, "path.to.key=value".
[[nodiscard]] config::Scenario scenario(const std::string& name,
                                        const std::vector<std::string>& changes,
                                        std::uint64_t seed = 0);

/// Plant and controller against each other, bare: nothing judges or records.
class Loop {
 public:
  explicit Loop(const config::Scenario& scenario);

  /// From now on the controller is given what this makes of a reading.
  void change_readings(std::function<void(SensorReading&)> change) { change_ = std::move(change); }
  /// One tick.
  void tick();
  /// Until the time, or until `stop` says so.
  void run_until(double time, const std::function<bool()>& stop = [] { return false; });

  /// Between two ticks.
  [[nodiscard]] control::Controller& controller() { return controller_; }
  [[nodiscard]] const simulation::GroundTruth& truth() const { return plant_.truth(); }
  [[nodiscard]] const TickRecord& record() const { return controller_.record(); }
  [[nodiscard]] const solver::Hierarchy& hierarchy() const { return controller_.hierarchy(); }
  [[nodiscard]] int steps_taken() const { return controller_.steps_taken(); }
  /// Calls to malloc and its kin in the controller's ticks so far, and in which tick the last was.
  [[nodiscard]] std::size_t allocations() const { return allocations_; }
  [[nodiscard]] double last_allocation() const { return last_allocation_; }
  [[nodiscard]] int count(PlanEvent event) const;

 private:
  config::Scenario scenario_;
  simulation::Plant plant_;
  control::Controller controller_;
  std::function<void(SensorReading&)> change_ = [](SensorReading&) {};
  std::vector<PlanEvent> events_;
  std::size_t allocations_ = 0;
  double last_allocation_ = 0.0;  // [s]
};

}  // namespace surefoot::test
