#pragma once

#include "python/changes.hpp"
#include "python/lent.hpp"
#include "surefoot/config/scenario.hpp"
#include "surefoot/simulation/plant.hpp"

#include <memory>
#include <string>

namespace surefoot::python {

/// `Plant` in Python: one of its own, or that of a run.
class BoundPlant : public Lent<simulation::Plant> {
 public:
  explicit BoundPlant(const config::Scenario& scenario)
      : Lent(std::make_unique<simulation::Plant>(scenario.robot, scenario.plant), "plant", false),
        robot_(scenario.robot.name),
        base_(scenario.robot.base_link) {}
  BoundPlant(const config::Scenario& scenario, simulation::Plant& of_run)
      : Lent(of_run, "plant", false),
        robot_(scenario.robot.name),
        base_(scenario.robot.base_link) {}

  /// Throws Error unless a controller is of the same robot.
  void check_controller_of(const std::string& robot) const {
    if (robot == robot_) return;
    throw Error("plant is of the robot " + robot_ + ", and the controller of " + robot +
                "; both of the same scenario would be valid");
  }
  [[nodiscard]] const std::string& base() const { return base_; }
  Changes changes;

 private:
  std::string robot_;  // its name
  std::string base_;   // its link
};

}  // namespace surefoot::python
