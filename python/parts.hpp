#pragma once

#include "python/robot.hpp"
#include "surefoot/config/scenario.hpp"
#include "surefoot/estimation/state_estimator.hpp"
#include "surefoot/gaits/motion_planner.hpp"
#include "surefoot/gaits/own_gaits.hpp"
#include "surefoot/tasks/task_definition.hpp"

#include <nanobind/nanobind.h>

#include <memory>
#include <utility>

namespace surefoot::python {

namespace nb = nanobind;

/// A Python object that threads without the interpreter's lock may copy and drop.
class SharedObject {
 public:
  explicit SharedObject(nb::object object)
      : object_(new nb::object(std::move(object)), [](nb::object* last) {
          const nb::gil_scoped_acquire python;
          delete last;
        }) {}
  /// With the lock.
  [[nodiscard]] const nb::object& operator*() const { return *object_; }

 private:
  std::shared_ptr<nb::object> object_;
};

// The user's own parts, for the controller. What Python raises in them they throw as Error, in one
// line.
[[nodiscard]] std::unique_ptr<estimation::StateEstimator> own_estimator(
    const SharedObject& object, const model::RobotDescription& robot);
[[nodiscard]] std::unique_ptr<gaits::MotionPlanner> own_planner(
    const SharedObject& object, const model::RobotDescription& robot);
/// Of names and what makes a `Gait` each, called for each controller; `robot` is set before.
[[nodiscard]] gaits::OwnGaits own_gaits(const nb::dict& makers,
                                        std::shared_ptr<std::shared_ptr<Robot>> robot);
/// Of a list of `OwnTask`s.
[[nodiscard]] tasks::OwnTasks own_tasks(const nb::list& list);

}  // namespace surefoot::python
