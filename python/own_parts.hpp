#pragma once

#include "python/in_python.hpp"
#include "python/interpreter.hpp"
#include "python/robot.hpp"
#include "surefoot/config/scenario.hpp"
#include "surefoot/estimation/state_estimator.hpp"
#include "surefoot/gaits/motion_planner.hpp"
#include "surefoot/gaits/own_gaits.hpp"
#include "surefoot/tasks/task_definition.hpp"

#include <nanobind/nanobind.h>

#include <functional>
#include <memory>
#include <string>
#include <utility>

namespace surefoot::python {

namespace nb = nanobind;

/// A Python object that threads without the interpreter's lock may copy and drop.
class SharedObject {
 public:
  explicit SharedObject(nb::object object)
      : object_(new nb::object(std::move(object)), [](nb::object* last) {
          const Interpreter::Locked python;
          delete last;
        }) {}
  /// With the lock.
  [[nodiscard]] const nb::object& operator*() const { return *object_; }

 private:
  std::shared_ptr<nb::object> object_;
};

/// A base class in Python that can ask the library's part, which is made anew with each controller.
template <typename Part>
struct BoundPart {
  std::function<std::unique_ptr<Part>()> make;
  std::string robot{};  ///< that it is made for, by name
  std::unique_ptr<Part> library = make ? make() : nullptr;
};

/// Throws Error if the object has no update() of its own, and no library's to ask, or one that
/// takes other arguments. `takes`: what is valid.
void check_update(nb::handle object, nb::handle base, bool asks_library, const char* takes);

/// Before a controller of the robot takes it: what it remembers of another run is gone.
template <typename Bound>
void begin_anew(const SharedObject& object, const char* takes,
                const model::RobotDescription& robot) {
  const Interpreter::Locked python;
  if (nb::inst_check(*object) && !nb::inst_ready(*object))
    throw Error(text_of((*object).type().attr("__name__")) +
                ".__init__ must call super().__init__() first");
  Bound* base = nullptr;
  (void)nb::try_cast<Bound*>(*object, base);
  check_update(*object, nb::type<Bound>(), base != nullptr && base->make, takes);
  if (base != nullptr && base->make && base->robot != robot.name)
    throw Error(text_of((*object).type().attr("__name__")) + " is of the robot " + base->robot +
                ", and the controller of " + robot.name +
                "; both of the same scenario would be valid");
  (*object).attr("restart")();
  if (base != nullptr && base->make) base->library = base->make();
}

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
/// A stack from its text, with all that it needs for a robot. Throws Error if it is none.
[[nodiscard]] control::StackOptions stack_for(const model::RobotDescription& robot,
                                              const std::string& text, const std::string& name,
                                              const tasks::OwnTasks& own);
/// Of a log's run: those given, and registered ones of other names.
[[nodiscard]] tasks::OwnTasks own_tasks_of_run(const nb::object& given);

}  // namespace surefoot::python
