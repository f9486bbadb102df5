#include "surefoot/control/controller_memory.hpp"

#include "surefoot/base/error.hpp"

#include <cmath>
#include <string>

namespace surefoot {
namespace {

double checked_period(double period) {
  if (period > 0.0 && std::isfinite(period)) return period;
  throw Error("period is " + std::to_string(period) + " s; valid is a time > 0, such as 0.0025");
}

}  // namespace

ControllerMemory::ControllerMemory(const RobotDescription& robot, const ControllerOptions& options,
                                   const RobotModel& model)
    : guard(options.guard, robot, checked_period(options.period)),
      rest_check(options.period),
      contact_force(options.contact_force, options.period),
      kinematics(robot, options.period),
      link_masses(options.link_masses, options.period),
      com_calibration(options.period, model.base_mass()),
      slip(options.slip, options.period),
      external_force(options.external_force),
      consistency(options.consistency, options.period),
      lift(options.period),
      footing(options.planner.stance, options.period),
      planner(options.planner, model.mass() * kGravity, options.period) {}

}  // namespace surefoot
