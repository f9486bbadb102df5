// Estimators that are written in Python.

#include "python/bindings.hpp"
#include "python/numbers.hpp"
#include "python/own_parts.hpp"
#include "surefoot/estimation/leg_inertial_estimator.hpp"

#include <memory>

namespace surefoot::python {
namespace {

/// `Estimator` in Python.
struct BoundEstimator : BoundPart<estimation::StateEstimator> {
  [[nodiscard]] estimation::StateEstimator& asked() const {
    if (library) return *library;
    throw Error("Estimator() estimates nothing by itself: write update(), or give it a scenario");
  }
};

class PythonEstimator final : public estimation::StateEstimator {
 public:
  explicit PythonEstimator(const SharedObject& object) : object_(object) {}

  const RobotState& update(const SensorReading& reading, const TickContext& context) override {
    in_python([&] {
      const nb::object result = (*object_).attr("update")(reading, context);
      state_ = result_of<RobotState>(*object_, "update", "RobotState", result);
    });
    return state_;
  }
  void restart() override {
    in_python([&] { (*object_).attr("restart")(); });
  }

 private:
  SharedObject object_;
  RobotState state_;
};

}  // namespace

void bind_estimator(nb::module_& module) {
  using Self = BoundEstimator;
  nb::class_<Self>(module, "Estimator",
                   "Estimates the state from sensor readings. Derive your own and write update(); "
                   "what it raises "
                   "makes the\ncontroller act as without a state: it holds, then sits down.",
                   nb::type_slots(kNoVectorcall))
      .def(nb::init<>())
      .def(
          "__init__",
          [](Self* self, const config::Scenario& scenario) {
            new (self) Self{{[robot = scenario.robot, options = scenario.estimator,
                              period = scenario.controller.period] {
                               return std::make_unique<estimation::LegInertialEstimator>(
                                   robot, options, period);
                             },
                             scenario.robot.name}};
          },
          nb::arg("scenario"), "With the library's, which super().update() then asks.")
      .def(
          "update",
          [](Self& self, const SensorReading& reading, const TickContext& context) {
            return self.asked().update(reading, context);
          },
          nb::arg("reading"), nb::arg("context"),
          "A tick: the state now, in a world W of its own. Numbers that are not known are NaN; the "
          "controller\nestimates foot_force, external forces and slips itself, over what is there.")
      .def(
          "restart",
          [](Self& self) {
            if (self.library) self.library->restart();
          },
          "Forgets all readings so far: called when a controller is made with it, and where the "
          "robot is set down elsewhere.");
}

std::unique_ptr<estimation::StateEstimator> own_estimator(const SharedObject& object,
                                                          const model::RobotDescription& robot) {
  begin_anew<BoundEstimator>(object, "reading, context", robot);
  return std::make_unique<PythonEstimator>(object);
}

}  // namespace surefoot::python
